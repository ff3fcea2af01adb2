#include <snug/contact/pair_geometry.h>
#include <snug/elasticity/element.h>
#include <snug/faces/tributary.h>
#include <snug/geometry/extents.h>
#include <snug/io/mesh_summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace snug::io {
namespace {
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
      entry.boundaries.push_back({names[b],
                                  area_of<dim>(mesh.degree(), surface, {body, b},
                                               surface.gather(mesh.reference_positions())),
                                  box_of_side<dim>(mesh, {body, b})});
    }
  return entry;
}

} // namespace

template <int dim>
double area_of(const unsigned int                        degree,
               const mesh::Surface<dim>                 &surface,
               const contact::Side                      &side,
               const typename mesh::Surface<dim>::Field &positions)
{
  const auto                  faces = contact::faces_of(surface, side);
  const faces::FaceShape<dim> shape(degree);
  const auto                  areas =
    faces::tributary_areas<dim>({surface, faces, shape}, faces::PointField<dim, double>(positions));
  double sum = 0.;
  for (unsigned int node = 0; node < areas.size(); ++node)
    if (surface.masters(node).empty())
      sum += areas[node];
  return sum;
}

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
Json bodies_part(const MeshSummary<dim> &summary)
{
  const auto corner = [](const dealii::Point<dim> &x) {
    return std::vector<double>(x.begin_raw(), x.end_raw());
  };
  const auto corners = [&](const BoundingBox<dim> &box) {
    return Json{corner(box.lower), corner(box.upper)};
  };
  Json part = Json::array();
  for (const auto &body : summary.bodies)
    {
      Json regions = Json::array(), boundaries = Json::array();
      for (const auto &region : body.regions)
        regions.push_back(
          {{"name", region.name}, {"cells", region.n_cells}, {"volume", region.volume}});
      for (const auto &boundary : body.boundaries)
        boundaries.push_back(
          {{"name", boundary.name}, {"area", boundary.area}, {"box", corners(boundary.box)}});
      part.push_back({{"name", body.name},
                      {"cells", body.n_cells},
                      {"box", corners(body.box)},
                      {"regions", regions},
                      {"boundaries", boundaries}});
    }
  return part;
}

template <int dim>
void print(const MeshSummary<dim> &summary, std::ostream &out)
{
  for (const auto &body : summary.bodies)
    {
      const double size = body.box.diagonal();
      out << "body " << body.name << ": " << counted(body.n_cells, "cell") << ", "
          << geometry::extents(body.box.lower, body.box.upper, size) << '\n';
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
            << boundary.area << "  "
            << geometry::extents(boundary.box.lower, boundary.box.upper, size) << '\n';
    }
}

#define SNUG_INSTANTIATE(dim)                                                                        \
  template double           area_of(unsigned int, const mesh::Surface<dim> &, const contact::Side &, \
                                    const mesh::Surface<dim>::Field &);                              \
  template MeshSummary<dim> summarize_mesh(const scene::Scene &, const mesh::BodyMesh<dim> &);       \
  template Json             bodies_part(const MeshSummary<dim> &);                                   \
  template void             print(const MeshSummary<dim> &, std::ostream &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
