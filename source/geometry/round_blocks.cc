#include <snug/geometry/block_geometry.h>
#include <snug/geometry/body_sources.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/round_body.h>

#include <deal.II/base/exceptions.h>

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

/// Boundary of the faces in the planes x_d = 0: @p first + d.
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

/// Blocks between the origin and the unit sphere where all coordinates
/// are positive. The inner block ends at the distances @p reach from the
/// origin along an axis, a diagonal of two and one of three axes.
///
/// A square or cube would reach 1 : 1.41 : 1.73, a ball 1 : 1 : 1. In between, the
/// corner of the inner block is obtuse, as those of the outer blocks beside it need room as well.
template <int dim>
void add_solid_blocks(BlockMesh<dim> &mesh, const std::array<double, 3> &reach)
{
  const unsigned int n = 1u << dim;
  // vertex v of the inner block has the coordinates in its bits; outer
  // ones follow
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
      // coordinates that are 0 stay exactly 0, as mirror() and set_cut_planes() need
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
      // the face x_d = 1 of the inner block, pushed outwards
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

/// Scale from the unit sphere; there is one region.
template <int dim>
void finish(BlockMesh<dim> &mesh, double radius)
{
  for (auto &vertex : mesh.vertices)
    vertex *= radius;
  mesh.regions.assign(mesh.blocks.size(), 0);
  mesh.region_names = {"body"};
}

BlockMesh<2> disc_mesh(const BodyMeshParameters &parameters, unsigned int n_cells)
{
  require_positive("Radius", parameters.radius);
  const unsigned int parts = n_of_part(parameters, 4);
  BlockMesh<2>       mesh;
  // the cut at x = 0, then that at y = 0, as set_cut_planes() numbers them
  mesh.boundary_names = {"outer", "left", "bottom"};
  mesh.surfaces[0]    = std::make_shared<dealii::SphericalManifold<2>>();
  mesh.cells.fill(n_cells);
  add_solid_blocks(mesh, {{0.5, 0.6, 0.}});
  set_cut_planes(mesh, 1);
  finish(mesh, parameters.radius);
  // a quarter is mirrored to x < 0, the half to y < 0
  if (parts <= 2)
    mirror(mesh, 0, "left");
  if (parts == 1)
    mirror(mesh, 1, "bottom");
  remove_unused_boundaries(mesh);
  AssertThrow(order_consistently(mesh), dealii::ExcInternalError());
  return mesh;
}

/// The disc of @p flat between z = 0 and z = @p length.
BlockMesh<3> extruded(const BlockMesh<2> &flat, double length, unsigned int n_cells)
{
  BlockMesh<3>       mesh;
  const unsigned int n = flat.vertices.size();
  for (const double z : {0., length})
    for (const auto &vertex : flat.vertices)
      mesh.vertices.emplace_back(vertex[0], vertex[1], z);
  mesh.boundary_names = flat.boundary_names;
  // in 3D, bottom is the side z = 0
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
    // ascending, as keys are: upper vertices have larger numbers
    mesh.boundaries[{edge.first[0], edge.first[1], edge.first[0] + n, edge.first[1] + n}] =
      edge.second;
  // outer is boundary 0, as every part of a disc has it; the axis is z
  mesh.surfaces[0] = std::make_shared<dealii::CylindricalManifold<3>>(2);
  mesh.cells       = {{flat.cells[0], flat.cells[1], n_cells}};
  finish(mesh, 1.);
  return mesh;
}

/// Full bodies are mirrored three times, halves at x and y = 0, quarters at x = 0.
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
  AssertThrow(order_consistently(mesh), dealii::ExcInternalError());
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
  // the outer blocks of a solid with an inner sphere
  const double ratio = parameters.inner_radius / parameters.radius;
  add_solid_blocks(mesh, {{ratio, ratio, ratio}});
  // without the inner block; numbers of the others change, and so do their boundaries
  mesh.boundaries.clear();
  mesh.blocks.erase(mesh.blocks.begin());
  for (unsigned int d = 0; d < 3; ++d)
    {
      // axes of the block: two along the sphere, then outwards
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
  // the axis across must stay the last, since it has its own number of cells
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
