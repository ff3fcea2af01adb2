#include <snug/advice/cost.h>
#include <snug/app/build_model.h>
#include <snug/app/mesh_summary.h>
#include <snug/elasticity/element.h>
#include <snug/faces/tributary.h>
#include <snug/geometry/imported_mesh.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>

namespace snug::app {
namespace {
template <int dim>
using Box = typename MeshSummary<dim>::Box;

/// Return the bounding box of the @p points of all ranks. Collective.
template <int dim>
Box<dim> box_of(const std::vector<dealii::Tensor<1, dim>> &points, MPI_Comm communicator)
{
  std::vector<double> ends(2 * dim, -std::numeric_limits<double>::max());
  for (const auto &x : points)
    for (unsigned int d = 0; d < dim; ++d)
      {
        ends[d]       = std::max(ends[d], x[d]);
        ends[dim + d] = std::max(ends[dim + d], -x[d]);
      }
  dealii::Utilities::MPI::max(ends, communicator, ends);
  Box<dim> box;
  for (unsigned int d = 0; d < dim; ++d)
    {
      box.upper[d] = ends[d] + 0.; // no -0
      box.lower[d] = 0. - ends[dim + d];
    }
  return box;
}

template <int dim>
Box<dim> box_of_body(const mesh::BodyMesh<dim> &mesh, unsigned int body)
{
  std::vector<dealii::Tensor<1, dim>> points;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.body_of_node(node) == body)
      points.push_back(mesh.reference_positions()[node]);
  return box_of<dim>(points, mesh.communicator());
}

template <int dim>
Box<dim> box_of_side(const mesh::BodyMesh<dim> &mesh, const contact::Side &side)
{
  std::vector<dealii::Tensor<1, dim>> points;
  for (const auto &face : mesh.boundary_faces())
    if (contact::is_on(face, side))
      for (const unsigned int node : face.nodes)
        points.push_back(mesh.reference_positions()[node]);
  return box_of<dim>(points, mesh.communicator());
}

template <int dim>
double area_of(const mesh::BodyMesh<dim> &mesh, const mesh::Surface<dim> &surface)
{
  std::vector<unsigned int> faces;
  for (unsigned int f = 0; f < surface.faces().size(); ++f)
    faces.push_back(f);
  const faces::FaceShape<dim> shape(mesh.degree());
  const auto                  positions = surface.gather(mesh.reference_positions());
  const auto                  areas =
    faces::tributary_areas<dim>({surface, faces, shape}, faces::PointField<dim, double>(positions));
  double sum = 0.;
  for (unsigned int node = 0; node < areas.size(); ++node)
    if (surface.masters(node).empty())
      sum += areas[node];
  return sum;
}

template <int dim>
std::vector<typename MeshSummary<dim>::Region> regions_of_body(const mesh::BodyMesh<dim> &mesh,
                                                               unsigned int               body)
{
  const auto                     names = mesh.geometry(body).region_names();
  std::vector<double>            n_cells(names.size()), volume = n_cells;
  const elasticity::Element<dim> element(mesh.degree(), mesh.idealization());
  for (const auto &cell : mesh.cells())
    if (cell.body == body)
      {
        std::vector<dealii::Tensor<1, dim>> X;
        for (const unsigned int node : cell.nodes)
          X.push_back(mesh.reference_positions()[node]);
        n_cells[cell.region] += 1.;
        volume[cell.region] += element.volume(X);
      }
  dealii::Utilities::MPI::sum(n_cells, mesh.communicator(), n_cells);
  dealii::Utilities::MPI::sum(volume, mesh.communicator(), volume);
  std::vector<typename MeshSummary<dim>::Region> regions;
  for (unsigned int r = 0; r < names.size(); ++r)
    regions.push_back({names[r], static_cast<unsigned long>(n_cells[r]), volume[r]});
  return regions;
}

template <int dim>
typename MeshSummary<dim>::Body inventory_of_body(const mesh::BodyMesh<dim> &mesh,
                                                  unsigned int               body)
{
  typename MeshSummary<dim>::Body entry;
  for (const auto &cell : mesh.cells())
    entry.n_cells += cell.body == body;
  entry.n_cells     = dealii::Utilities::MPI::sum(entry.n_cells, mesh.communicator());
  entry.regions     = regions_of_body(mesh, body);
  entry.box         = box_of_body(mesh, body);
  const auto &names = mesh.geometry(body).boundary_names();
  for (unsigned int b = 0; b < names.size(); ++b)
    {
      const mesh::Surface<dim> surface(mesh, {{body, b}});
      entry.boundaries.push_back(
        {names[b], area_of(mesh, surface), box_of_side<dim>(mesh, {body, b})});
    }
  return entry;
}

/// Return the extents of a box as text. Numbers that are round-off, relative to the @p size of the
/// body, are shown as 0.
template <int dim>
std::string extents(const Box<dim> &box, double size)
{
  const double       least = 1e-9 * size;
  std::ostringstream text;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const auto shown = [&](const double x) { return std::abs(x) < least ? 0. : x; };
      text << (d == 0 ? "" : ", ") << "xyz"[d] << ' ' << shown(box.lower[d]);
      if (box.upper[d] - box.lower[d] > least)
        text << " to " << shown(box.upper[d]);
    }
  return text.str();
}

/// Return the distance between two boxes, which is zero if they overlap.
template <int dim>
double distance(const Box<dim> &a, const Box<dim> &b)
{
  dealii::Tensor<1, dim> gap;
  for (unsigned int d = 0; d < dim; ++d)
    gap[d] = std::max({0., a.lower[d] - b.upper[d], b.lower[d] - a.upper[d]});
  return gap.norm();
}
} // namespace

template <int dim>
MeshSummary<dim> summarize_mesh(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  MeshSummary<dim> summary;
  for (unsigned int body = 0; body < scene.bodies.size(); ++body)
    {
      summary.bodies.push_back(inventory_of_body(mesh, body));
      summary.bodies.back().name = scene.bodies[body].name;
    }
  return summary;
}

template <int dim>
void print(const MeshSummary<dim> &summary, std::ostream &out)
{
  for (const auto &body : summary.bodies)
    {
      const double size = body.box.lower.distance(body.box.upper);
      out << "body " << body.name << ": " << counted(body.n_cells, "cell") << ", "
          << extents<dim>(body.box, size) << '\n';
      if (body.regions.size() > 1)
        for (const auto &region : body.regions)
          {
            out << "  region " << region.name << ": ";
            if (region.n_cells == 0)
              out << "all its cells belong to other regions\n";
            else
              out << counted(region.n_cells, "cell") << ", volume " << region.volume << '\n';
          }
      std::size_t width = 0;
      for (const auto &boundary : body.boundaries)
        width = std::max(width, boundary.name.size());
      for (const auto &boundary : body.boundaries)
        out << "  " << std::left << std::setw(width) << boundary.name << "  area " << std::setw(10)
            << boundary.area << "  " << extents<dim>(boundary.box, size) << '\n';
    }
}

template <int dim>
void check_distances(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  const double too_far = 10.;
  for (const auto &pair : scene.contact.pairs)
    {
      if (scene::split_face(pair.master).second.empty())
        continue; // an obstacle
      double   size = 0.;
      Box<dim> boxes[2];
      for (const unsigned int side : {0, 1})
        {
          const auto faces = find_side(scene, mesh, side == 0 ? pair.slave : pair.master);
          const auto body  = box_of_body(mesh, faces.body());
          boxes[side]      = box_of_side(mesh, faces);
          size             = std::max(size, body.lower.distance(body.upper));
        }
      const double gap = distance<dim>(boxes[0], boxes[1]);
      if (gap <= too_far * size)
        continue;
      std::ostringstream text;
      text << "have a distance of " << gap << ", but the size of the larger body is only " << size
           << "; check the units of the meshes, 'Scale' and 'Shift'";
      throw InputError(scene.file + ": entry 'Contact/Pairs': '" + pair.slave + "' and '" +
                       pair.master + "' " + text.str());
    }
}

template <int dim>
std::vector<std::string> unrefined(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  // Bodies share no vertices, so the refinement of one body does not refine another one.
  std::vector<double> n_cells(scene.bodies.size(), 0.);
  for (const auto &cell : mesh.cells())
    n_cells[cell.body] += 1.;
  dealii::Utilities::MPI::sum(n_cells, mesh.communicator(), n_cells);
  std::vector<std::string> lines;
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    {
      const auto  &body = scene.bodies[b];
      const double even =
        mesh.geometry(b).n_coarse_cells() * std::pow(2., double(dim) * body.mesh.refinements);
      if (!body.mesh.refine_where.empty() && body.mesh.local_refinements > 0 && n_cells[b] == even)
        lines.push_back("'Refine where' of body " + body.name +
                        " is positive at the centre of none of its " + to_text(n_cells[b]) +
                        " cells: no cell is refined; 'Refinements' can make cells smaller first");
    }
  return lines;
}

template <int dim>
void print_estimate(RunContext                &context,
                    const scene::Scene        &scene,
                    const mesh::BodyMesh<dim> &mesh,
                    const unsigned int         n_ranks,
                    const bool                 stages)
{
  const auto counts = advice::count(scene, mesh);
  throw_collectively(context.communicator(), [&]() {
    if (context.rank() == 0)
      with_file_context(scene, [&]() {
        print(advice::estimate_cost(scene, counts, n_ranks, advice::machine_speed()), stages,
              context.out(stages ? Verbosity::quiet : Verbosity::normal));
      });
  });
}

void print_faces(const scene::Scene &scene, std::ostream &out)
{
  for (const auto &body : scene.bodies)
    if (body.mesh.imported && !body.mesh.imported->faces.empty())
      {
        out << "body " << body.name << ", " << body.mesh.file << ":\n";
        for (const auto &line : body.mesh.imported->faces)
          out << "  " << line << '\n';
      }
}

std::vector<std::string> import_warnings(const scene::Scene &scene)
{
  std::vector<std::string> lines;
  for (const auto &body : scene.bodies)
    if (body.mesh.imported)
      for (const auto &warning : body.mesh.imported->warnings)
        lines.push_back("body " + body.name + ", " + body.mesh.file + ": " + warning);
  return lines;
}

void print_import_notes(const scene::Scene &scene, std::ostream &out)
{
  for (const auto &body : scene.bodies)
    if (body.mesh.imported)
      for (const auto &note : body.mesh.imported->notes)
        out << "body " << body.name << ", " << body.mesh.file << ": " << note << '\n';
}

template MeshSummary<2>           summarize_mesh(const scene::Scene &, const mesh::BodyMesh<2> &);
template void                     print(const MeshSummary<2> &, std::ostream &);
template void                     check_distances(const scene::Scene &, const mesh::BodyMesh<2> &);
template std::vector<std::string> unrefined(const scene::Scene &, const mesh::BodyMesh<2> &);
template void
print_estimate(RunContext &, const scene::Scene &, const mesh::BodyMesh<2> &, unsigned int, bool);
template MeshSummary<3>           summarize_mesh(const scene::Scene &, const mesh::BodyMesh<3> &);
template void                     print(const MeshSummary<3> &, std::ostream &);
template void                     check_distances(const scene::Scene &, const mesh::BodyMesh<3> &);
template std::vector<std::string> unrefined(const scene::Scene &, const mesh::BodyMesh<3> &);
template void
print_estimate(RunContext &, const scene::Scene &, const mesh::BodyMesh<3> &, unsigned int, bool);
} // namespace snug::app
