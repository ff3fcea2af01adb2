#include <snug/app/build_loads.h>
#include <snug/app/mesh_checks.h>
#include <snug/base/statements.h>
#include <snug/geometry/extents.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/io/bounding_box.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>

namespace snug::app {
template <int dim>
void check_distances(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  const double too_far = 10.;
  for (const auto &pair : scene.contact.pairs)
    {
      if (scene::split_face(pair.master).second.empty())
        continue; // an obstacle
      double               size = 0.;
      io::BoundingBox<dim> boxes[2];
      for (const unsigned int side : {0, 1})
        {
          const auto faces = find_side(scene, mesh, side == 0 ? pair.slave : pair.master);
          const auto body  = io::box_of_body(mesh, faces.body());
          boxes[side]      = io::box_of_side(mesh, faces);
          size             = std::max(size, body.diagonal());
        }
      const double gap = io::distance(boxes[0], boxes[1]);
      if (gap <= too_far * size)
        continue;
      std::ostringstream text;
      text << "'" << pair.slave << "' (" << geometry::extents(boxes[0].lower, boxes[0].upper, size)
           << ") and '" << pair.master << "' ("
           << geometry::extents(boxes[1].lower, boxes[1].upper, size) << ") have a distance of "
           << gap << ", but the size of the larger body is only " << size
           << "; check the units of the meshes, 'Scale' and 'Shift'";
      throw Origins(scene.file, {})
        .error("Contact/Pairs", pair.slave + ": " + pair.master, text.str());
    }
}

template <int dim>
std::vector<std::string> refinement_warnings(const scene::Scene        &scene,
                                             const mesh::BodyMesh<dim> &mesh)
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

std::vector<std::string> import_warnings(const scene::Scene &scene)
{
  std::vector<std::string> lines;
  for (const auto &body : scene.bodies)
    if (body.mesh.imported)
      for (const auto &warning : body.mesh.imported->warnings)
        lines.push_back("body " + body.name + ", " + body.mesh.file + ": " + warning);
  return lines;
}

void print_cad_faces(const scene::Scene &scene, std::ostream &out)
{
  for (const auto &body : scene.bodies)
    if (body.mesh.imported && !body.mesh.imported->faces.empty())
      {
        out << "body " << body.name << ", " << body.mesh.file << ":\n";
        for (const auto &line : body.mesh.imported->faces)
          out << "  " << line << '\n';
      }
}

#define SNUG_INSTANTIATE(dim)                                                       \
  template void check_distances(const scene::Scene &, const mesh::BodyMesh<dim> &); \
  template std::vector<std::string> refinement_warnings(const scene::Scene &,       \
                                                        const mesh::BodyMesh<dim> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
