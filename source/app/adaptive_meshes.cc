#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/targets.h>
#include <snug/app/adaptive_meshes.h>
#include <snug/app/build_model.h>
#include <snug/base/gather.h>
#include <snug/contact/joined_pairs.h>
#include <snug/contact/matching.h>
#include <snug/geometry/body_sources.h>
#include <snug/mesh/refined_cells.h>

#include <algorithm>
#include <cmath>

namespace snug::app {
namespace {
/// Maximum number of passes, about the largest difference of levels between faces in contact at
/// first. Where the cell edges of two bodies do not coincide, each pass moves a change of size on
/// by a face on both bodies, without a limit to the end of the side.
constexpr unsigned int most_passes = 8;

/// Return the part of formulas that the first mesh may miss. Where formulas jump, this error
/// decreases irregularly from mesh to mesh; therefore it is made small compared with the targets at
/// once.
double missed_data(const scene::Scene &scene)
{
  const double least = 0.002;
  double       part  = 0.05;
  for (const auto &of_response : scene.accuracy.targets)
    {
      const auto target = accuracy::read_target(of_response.second);
      part              = std::min(part, target.relative ? 0.25 * target.value : 0.01);
    }
  return std::max(part, least);
}

/// Return the centres of cells of the body of a CAD file, in the coordinates of the file. Rank 0
/// has the cells.
template <int dim>
std::vector<dealii::Point<3>> places_in_file(const MPI_Comm                      communicator,
                                             const geometry::BodyMeshParameters &parameters,
                                             const geometry::CoarseCells<dim>   &coarse,
                                             const std::vector<dealii::CellId>  &cells)
{
  return made_on_first_rank(communicator, [&]() {
    const auto                    in_file = geometry::make_imported<dim>(parameters);
    std::vector<dealii::Point<3>> places;
    for (const auto &cell : cells)
      {
        const auto x = in_file->position(coarse.point(cell, geometry::unit_centre<dim>()));
        places.emplace_back(x[0], x[1], dim == 3 ? x[dim - 1] : 0.);
      }
    return places;
  });
}
} // namespace

template <int dim>
typename AdaptiveMeshes<dim>::Mesh AdaptiveMeshes<dim>::first(Refinement &refinement)
{
  const bool is_of_scene = refinement.empty();
  if (is_of_scene && first_refinement)
    refinement = *first_refinement;
  else
    resolve_data(refinement);
  auto mesh = make(refinement);
  if (is_of_scene)
    first_refinement = refinement;
  return mesh;
}

/// Return the forest of the scene with a refinement. The forest of the mesh before is refined
/// further if no body is meshed anew and the refinement has the divided cells of this forest.
/// Collective.
template <int dim>
const mesh::Forest<dim> &AdaptiveMeshes<dim>::forest_with(const Refinement &refinement)
{
  if (refinement.remesh(the_scene, context))
    forest.reset();
  if (!forest)
    {
      forest = build_forest<dim>(the_scene, context.communicator());
      forest_cells.clear();
    }
  const auto cells = refinement.cells<dim>(forest->places());
  if (!std::includes(cells.begin(), cells.end(), forest_cells.begin(), forest_cells.end()))
    forest = build_forest<dim>(the_scene, context.communicator());
  forest->refine(cells);
  forest_cells = cells;
  return *forest;
}

/// CAD files are meshed only once for the matching of faces, because Gmsh does not attain the
/// element sizes exactly.
template <int dim>
typename AdaptiveMeshes<dim>::Mesh AdaptiveMeshes<dim>::make(Refinement &refinement)
{
  begin();
  const RunContext::Timer timer(context, "setup");
  for (unsigned int pass = 0; pass < most_passes; ++pass)
    {
      const auto                  given = refinement;
      const auto                  mesh  = build_mesh(the_scene, forest_with(refinement), false);
      const auto                  pairs = build_pairs(the_scene, *mesh);
      const mesh::Surface<dim>    surface(*mesh, contact::boundaries_of(pairs));
      const faces::FaceShape<dim> shape(mesh->degree());
      for (const auto &joined :
           contact::join_pairs(surface, shape, pairs, surface.reference_positions()))
        add_cells(*mesh, given,
                  mesh::gather_cells(
                    *mesh, surface.cells_of(contact::coarse_faces(surface, shape, joined.pair,
                                                                  surface.reference_positions()))),
                  refinement, pass == 0);
      if (refinement == given)
        break;
    }
  return build_mesh(the_scene, forest_with(refinement));
}

/// Refine the first mesh until it resolves the formulas and the surfaces of the scene, and warn of
/// what remains unresolved. States and estimates cannot depend on details without Gauss points and
/// nodes. Collective.
template <int dim>
void AdaptiveMeshes<dim>::resolve_data(Refinement &refinement)
{
  const RunContext::Timer timer(context, "setup");
  while (true)
    {
      const auto mesh  = build_mesh(the_scene, forest_with(refinement), false);
      auto       next  = refinement;
      const auto found = with_file_context(the_scene, [&]() {
        return accuracy::unresolved_data(*mesh, build_model(the_scene, *mesh),
                                         missed_data(the_scene));
      });
      add_cells(*mesh, refinement, found.cells, next);
      if (next != refinement && is_affordable(*mesh))
        {
          refinement = std::move(next);
          continue;
        }
      context.warn("unresolved data", found.lines);
      return;
    }
}

template <int dim>
void AdaptiveMeshes<dim>::add_cells(const mesh::BodyMesh<dim>         &mesh,
                                    const Refinement                  &of_mesh,
                                    const std::vector<dealii::CellId> &marked,
                                    Refinement                        &to,
                                    const bool                         remesh_cad) const
{
  const auto                                         &coarse = mesh.coarse_cells();
  std::map<unsigned int, std::vector<dealii::CellId>> of_files;
  for (const auto &cell : marked)
    {
      const unsigned int body = coarse.body(cell);
      if (the_scene.bodies[body].mesh.source == geometry::Source::cad)
        of_files[body].push_back(cell);
      else if (mesh::level(cell) < the_scene.accuracy.maximum_levels)
        to.divide(body, coarse.in_body(cell));
    }
  for (const auto &[body, cells] : of_files)
    if (const auto n = of_mesh.n_halvings(body);
        remesh_cad && n < the_scene.accuracy.maximum_levels)
      to.halve(body, n,
               places_in_file<dim>(context.communicator(), the_scene.bodies[body].mesh, coarse,
                                   cells));
}

template <int dim>
Refinement AdaptiveMeshes<dim>::everywhere(const mesh::BodyMesh<dim> &mesh,
                                           const Refinement          &of_mesh) const
{
  Refinement result = of_mesh;
  add_cells(mesh, of_mesh, mesh::all_cells(mesh), result, false);
  for (unsigned int b = 0; b < the_scene.bodies.size(); ++b)
    if (const auto n = of_mesh.n_halvings(b);
        the_scene.bodies[b].mesh.source == geometry::Source::cad &&
        n < the_scene.accuracy.maximum_levels)
      result.halve(b, n, {});
  return result;
}

template class AdaptiveMeshes<2>;
template class AdaptiveMeshes<3>;
} // namespace snug::app
