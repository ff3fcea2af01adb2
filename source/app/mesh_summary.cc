#include <snug/app/mesh_summary.h>
#include <snug/elasticity/element.h>
#include <snug/faces/tributary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace snug::app {
namespace {
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
typename MeshSummary<dim>::Body summarize_body(const mesh::BodyMesh<dim> &mesh, unsigned int body)
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
std::string extents(const BoundingBox<dim> &box, double size)
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
} // namespace

template <int dim>
MeshSummary<dim> summarize_mesh(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  MeshSummary<dim> summary;
  for (unsigned int body = 0; body < scene.bodies.size(); ++body)
    {
      summary.bodies.push_back(summarize_body(mesh, body));
      summary.bodies.back().name = scene.bodies[body].name;
    }
  return summary;
}

template <int dim>
void print(const MeshSummary<dim> &summary, std::ostream &out)
{
  for (const auto &body : summary.bodies)
    {
      const double size = body.box.diagonal();
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

template MeshSummary<2> summarize_mesh(const scene::Scene &, const mesh::BodyMesh<2> &);
template void           print(const MeshSummary<2> &, std::ostream &);
template MeshSummary<3> summarize_mesh(const scene::Scene &, const mesh::BodyMesh<3> &);
template void           print(const MeshSummary<3> &, std::ostream &);
} // namespace snug::app
