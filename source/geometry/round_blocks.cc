#include <snug/base/assertions.h>
#include <snug/geometry/block_geometry.h>
#include <snug/geometry/body_sources.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/round_body.h>


#include <deal.II/grid/manifold_lib.h>

#include <algorithm>

namespace snug::geometry {
namespace {
/// Make @p face of block @p block a part of boundary @p boundary.
template <int dim>
void set_boundary(BlockMesh<dim> &mesh,
                  unsigned int    block,
                  unsigned int    face,
                  unsigned int    boundary)
{
  mesh.boundaries[sorted(face_of<dim>(mesh.blocks[block], face))] = boundary;
}

/// Set the boundary of the faces in the planes x_d = 0 to @p first + d.
template <int dim>
void set_cut_planes(BlockMesh<dim> &mesh, unsigned int first)
{
  for (unsigned int b = 0; b < mesh.blocks.size(); ++b)
    for (const unsigned int f : dealii::GeometryInfo<dim>::face_indices())
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto face = face_of<dim>(mesh.blocks[b], f);
          if (std::all_of(face.begin(), face.end(),
                          [&](const unsigned int v) { return mesh.vertices[v][d] == 0.; }))
            set_boundary(mesh, b, f, first + d);
        }
}

/// Add the blocks between the origin and the unit sphere in the part with positive coordinates.
/// The inner block ends at the distances @p reach from the
/// origin along an axis, a diagonal of two axes and a diagonal of three axes.
///
/// A square or cube has the ratios 1 : 1.41 : 1.73, a ball has 1 : 1 : 1. With ratios between these
/// values, the corner of the inner block is obtuse and leaves angles for the corners of the
/// adjacent outer blocks.
template <int dim>
void add_solid_blocks(BlockMesh<dim> &mesh, const std::array<double, 3> &reach)
{
  const unsigned int n = 1u << dim;
  // The bits of vertex v of the inner block are its coordinates. The outer vertices follow the
  // inner vertices.
  mesh.vertices.resize(2 * n - 1);
  for (unsigned int v = 1; v < n; ++v)
    {
      dealii::Point<dim> direction;
      unsigned int       n_axes = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if ((v >> d & 1) == 1)
          {
            direction[d] = 1.;
            ++n_axes;
          }
      // Zero coordinates stay exactly 0, as mirror() and set_cut_planes() require.
      direction /= direction.norm();
      mesh.vertices[v]         = reach[n_axes - 1] * direction;
      mesh.vertices[n - 1 + v] = direction;
    }
  std::vector<unsigned int> inner;
  for (unsigned int v = 0; v < n; ++v)
    inner.push_back(v);
  mesh.blocks.push_back(inner);
  for (unsigned int d = 0; d < dim; ++d)
    {
      // The outer block extends from the face x_d = 1 of the inner block to the sphere.
      std::vector<unsigned int> block(n);
      for (unsigned int v = 0; v < n; ++v)
        {
          const unsigned int base = v | 1u << d;
          block[v]                = (v >> d & 1) == 0 ? base : n - 1 + base;
        }
      mesh.blocks.push_back(block);
    }
  for (unsigned int d = 0; d < dim; ++d)
    set_boundary(mesh, d + 1, 2 * d + 1, 0);
}

/// Scale the mesh of the unit sphere by @p radius, and set the single region.
template <int dim>
void finish(BlockMesh<dim> &mesh, double radius)
{
  for (auto &vertex : mesh.vertices)
    vertex *= radius;
  mesh.regions.assign(mesh.blocks.size(), 0);
  mesh.region_names = {"body"};
}

/// Set the known surface of boundary 0, which is outer in all of these bodies.
template <int dim>
void set_outer(BlockMesh<dim> &mesh, const double radius)
{
  KnownSurface<dim> outer;
  outer.radius = radius;
  set_known(mesh, 0, outer);
}

BlockMesh<2> disc_mesh(const BodyMeshParameters &parameters, unsigned int n_cells)
{
  require_positive("Radius", parameters.radius);
  const unsigned int parts = n_of_part(parameters, 4);
  BlockMesh<2>       mesh;
  // The names are in the order of set_cut_planes(): the cut at x = 0, then the cut at y = 0.
  mesh.boundary_names = {"outer", "left", "bottom"};
  mesh.surfaces[0]    = std::make_shared<dealii::SphericalManifold<2>>();
  mesh.cells.fill(n_cells);
  add_solid_blocks(mesh, {{0.5, 0.6, 0.}});
  set_cut_planes(mesh, 1);
  finish(mesh, parameters.radius);
  // The quarter is mirrored to x < 0, and the resulting half is mirrored to y < 0.
  if (parts <= 2)
    mirror(mesh, 0, "left");
  if (parts == 1)
    mirror(mesh, 1, "bottom");
  remove_unused_boundaries(mesh);
  set_outer(mesh, parameters.radius);
  const bool is_ordered = order_consistently(mesh);
  SNUG_ASSERT(is_ordered, "the blocks cannot be ordered consistently");
  return mesh;
}

/// Return the disc of @p flat, extruded from z = 0 to z = @p length.
BlockMesh<3> extruded(const BlockMesh<2> &flat, double length, unsigned int n_cells)
{
  BlockMesh<3>       mesh;
  const unsigned int n = flat.vertices.size();
  for (const double z : {0., length})
    for (const auto &vertex : flat.vertices)
      mesh.vertices.emplace_back(vertex[0], vertex[1], z);
  mesh.boundary_names = flat.boundary_names;
  // The cut at y = 0 is called front, because bottom is the side z = 0 in 3D.
  std::replace(mesh.boundary_names.begin(), mesh.boundary_names.end(), std::string("bottom"),
               std::string("front"));
  const unsigned int bottom = mesh.boundary_names.size();
  mesh.boundary_names.insert(mesh.boundary_names.end(), {"bottom", "top"});
  for (const auto &quad : flat.blocks)
    {
      mesh.blocks.push_back(quad);
      for (const unsigned int v : quad)
        mesh.blocks.back().push_back(v + n);
      set_boundary(mesh, mesh.blocks.size() - 1, 4, bottom);
      set_boundary(mesh, mesh.blocks.size() - 1, 5, bottom + 1);
    }
  for (const auto &edge : flat.boundaries)
    // The key is ascending as required, because upper vertices have larger numbers.
    mesh.boundaries[{edge.first[0], edge.first[1], edge.first[0] + n, edge.first[1] + n}] =
      edge.second;
  // Boundary 0 is outer, because every part of a disc has this boundary. The axis is z.
  mesh.surfaces[0] = std::make_shared<dealii::CylindricalManifold<3>>(2);
  mesh.cells       = {{flat.cells[0], flat.cells[1], n_cells}};
  finish(mesh, 1.);
  KnownSurface<3> outer;
  outer.kind    = KnownSurface<3>::Kind::cylinder;
  outer.axis[2] = 1.;
  outer.radius  = flat.known_surfaces[0].radius;
  set_known(mesh, 0, outer);
  return mesh;
}

/// Mirror an octant to the wanted part. Full bodies are mirrored three times, halves at x = 0 and
/// y = 0, quarters at x = 0.
void mirror_octant(BlockMesh<3> &mesh, unsigned int parts)
{
  const std::array<std::string, 3> cut = {{"left", "front", "bottom"}};
  for (unsigned int d = 0; d < 3; ++d)
    if (parts <= 4u >> d)
      mirror(mesh, d, cut[d]);
  remove_unused_boundaries(mesh);
}

BlockMesh<3> sphere_mesh(const BodyMeshParameters &parameters)
{
  require_positive("Radius", parameters.radius);
  const unsigned int parts = n_of_part(parameters, 8);
  BlockMesh<3>       mesh;
  mesh.boundary_names = {"outer", "left", "front", "bottom"};
  mesh.surfaces[0]    = std::make_shared<dealii::SphericalManifold<3>>();
  mesh.cells.fill(round_cells(parameters, 1)[0]);
  add_solid_blocks(mesh, {{0.5, 0.57, 0.6}});
  set_cut_planes(mesh, 1);
  finish(mesh, parameters.radius);
  mirror_octant(mesh, parts);
  set_outer(mesh, parameters.radius);
  const bool is_ordered = order_consistently(mesh);
  SNUG_ASSERT(is_ordered, "the blocks cannot be ordered consistently");
  return mesh;
}

BlockMesh<3> shell_mesh(const BodyMeshParameters &parameters)
{
  require_radii(parameters);
  const unsigned int parts = n_of_part(parameters, 8);
  const auto         cells = round_cells(parameters, 2);
  BlockMesh<3>       mesh;
  mesh.boundary_names = {"outer", "inner", "left", "front", "bottom"};
  mesh.inside         = std::make_shared<dealii::SphericalManifold<3>>();
  mesh.surfaces[0] = mesh.surfaces[1] = mesh.inside;
  mesh.cells                          = {{cells[0], cells[0], cells[1]}};
  // The blocks of the shell are the outer blocks of a solid whose inner block is bounded by a
  // sphere.
  const double ratio = parameters.inner_radius / parameters.radius;
  add_solid_blocks(mesh, {{ratio, ratio, ratio}});
  // The inner block is removed, which changes the numbers of the other blocks. The loop sets the
  // boundaries of these blocks with their radial axis as the last axis.
  mesh.boundaries.clear();
  mesh.blocks.erase(mesh.blocks.begin());
  for (unsigned int d = 0; d < 3; ++d)
    {
      // The first two axes of the block are tangential to the sphere, the last axis is radial.
      auto      &block = mesh.blocks[d];
      const auto old   = block;
      for (unsigned int v = 0; v < 8; ++v)
        block[v] = old[(v & 1) << (d + 1) % 3 | (v >> 1 & 1) << (d + 2) % 3 | (v >> 2) << d];
      set_boundary(mesh, d, 5, 0);
      set_boundary(mesh, d, 4, 1);
    }
  set_cut_planes(mesh, 2);
  finish(mesh, parameters.radius);
  mirror_octant(mesh, parts);
  set_outer(mesh, parameters.radius);
  KnownSurface<3> inner;
  inner.radius        = parameters.inner_radius;
  inner.encloses_body = false;
  set_known(mesh, 1, inner);
  // The radial axis must stay the last axis, because it has its own number of cells.
  order_layer_consistently(mesh);
  return mesh;
}

template <int dim>
std::unique_ptr<BodyGeometry<dim>> body(const BlockMesh<dim> &mesh)
{
  return std::make_unique<BlockGeometry<dim>>(std::make_shared<BlockMesh<dim>>(mesh));
}
} // namespace

std::unique_ptr<BodyGeometry<2>> make_disc(const BodyMeshParameters &parameters)
{
  return body(disc_mesh(parameters, round_cells(parameters, 1)[0]));
}

std::unique_ptr<BodyGeometry<3>> make_cylinder(const BodyMeshParameters &parameters)
{
  require_positive("Length", parameters.length);
  const auto cells = round_cells(parameters, 2);
  return body(extruded(disc_mesh(parameters, cells[0]), parameters.length, cells[1]));
}

std::unique_ptr<BodyGeometry<3>> make_sphere(const BodyMeshParameters &parameters)
{
  return body(sphere_mesh(parameters));
}

std::unique_ptr<BodyGeometry<3>> make_shell(const BodyMeshParameters &parameters)
{
  return body(shell_mesh(parameters));
}
} // namespace snug::geometry
