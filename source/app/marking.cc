#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>
#include <snug/geometry/body_sources.h>
#include <snug/mesh/refined_cells.h>

#include <algorithm>
#include <iterator>

namespace snug::app {
namespace {
/// Return the centres of cells of the body of a CAD file, in the coordinates of the file.
template <int dim>
std::vector<dealii::Point<3>> places_in_file(const geometry::BodyMeshParameters &parameters,
                                             const geometry::CoarseCells<dim>   &coarse,
                                             const std::vector<dealii::CellId>  &cells)
{
  const auto                    in_file = geometry::make_imported<dim>(parameters);
  std::vector<dealii::Point<3>> places;
  for (const auto &cell : cells)
    {
      const auto x = in_file->position(coarse.point(cell, geometry::unit_centre<dim>()));
      places.emplace_back(x[0], x[1], dim == 3 ? x[dim - 1] : 0.);
    }
  return places;
}
} // namespace

/// Add the cells @p marked of the mesh that was made last, which has the refinement @p of_mesh.
/// Elements of CAD files are halved at the centres of these cells.
template <int dim>
void Adaptation<dim>::add_cells(const mesh::BodyMesh<dim>         &mesh,
                                const Refinement                  &of_mesh,
                                const std::vector<dealii::CellId> &marked,
                                Refinement                        &to,
                                const bool                         mesh_files_anew) const
{
  const auto                                         &coarse = mesh.coarse_cells();
  std::map<unsigned int, std::vector<dealii::CellId>> of_files;
  for (const auto &cell : marked)
    {
      const unsigned int body = coarse.body(cell);
      if (scene.bodies[body].mesh.source == geometry::Source::cad)
        of_files[body].push_back(cell);
      else if (mesh::level(cell) < scene.accuracy.maximum_levels)
        to.divide(body, coarse.in_body(cell));
    }
  for (const auto &[body, cells] : of_files)
    if (const auto n = of_mesh.n_halvings(body);
        mesh_files_anew && n < scene.accuracy.maximum_levels)
      to.halve(body, n, places_in_file<dim>(scene.bodies[body].mesh, coarse, cells));
}

/// Return the refinement with all cells of the last mesh divided and all elements halved, as far as
/// the maximum level allows. Collective.
template <int dim>
Refinement Adaptation<dim>::refined_everywhere() const
{
  Refinement  result = last_refinement;
  const auto &mesh   = *solved->problem->mesh;
  add_cells(mesh, last_refinement, mesh::all_cells(mesh), result, false);
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    if (const auto n = last_refinement.n_halvings(b);
        scene.bodies[b].mesh.source == geometry::Source::cad && n < scene.accuracy.maximum_levels)
      result.halve(b, n, {});
  return result;
}

template <int dim>
bool Adaptation<dim>::reads_pressure() const
{
  return std::any_of(demands.begin(), demands.end(),
                     [](const auto &demand) { return demand.reads_pressure; });
}

/// Add the cells of contacts with too few faces, if a target reads pressures, of almost closed gaps
/// of pairs without a force, and of gaps whose roughness the faces do not resolve. Return whether
/// there are any. Collective.
template <int dim>
bool Adaptation<dim>::add_underresolved(Refinement &to)
{
  unresolved_gaps.clear();
  const auto &solver           = *solved->problem->solver;
  bool        is_underresolved = false;
  for (const auto &state : solved->states)
    {
      const auto faces =
        accuracy::underresolved_contact(solver, state,
                                        reads_pressure() ? scene.accuracy.contact_faces : 0.);
      is_underresolved = is_underresolved || !faces.empty();
      add_cells(solver.mesh(), last_refinement,
                mesh::gather_cells(solver.mesh(), solver.surface().cells_of(faces)), to);
      auto       found  = accuracy::unresolved_gaps(solver, state, allowed_roughness());
      const auto before = to;
      add_cells(solver.mesh(), last_refinement, found.cells, to);
      is_underresolved = is_underresolved || to != before;
      std::move(found.lines.begin(), found.lines.end(), std::back_inserter(unresolved_gaps));
    }
  return is_underresolved;
}

/// Add the cells that the estimates mark for the demands that are not met. Collective.
template <int dim>
void Adaptation<dim>::add_marked(Refinement &to) const
{
  const auto &mesh = *solved->problem->mesh;
  const auto  ids  = mesh::all_cells(mesh);
  for (unsigned int d = 0; d < demands.size(); ++d)
    if (!is_met(d))
      {
        const auto &demand = demands[d];
        const auto &indicators =
          solved->errors[demand.load_case].responses[demand.place].second.indicators;
        const auto                 &estimate = solved->measured[d];
        std::vector<dealii::CellId> marked;
        const auto                  flags =
          accuracy::mark(mesh::gather_values(mesh, ids, indicators), estimate.error,
                         demand.allowed(estimate), {scene.degree, scene.accuracy.marking_share});
        for (unsigned int cell = 0; cell < ids.size(); ++cell)
          if (flags[cell])
            marked.push_back(ids[cell]);
        add_cells(mesh, last_refinement, marked, to);
      }
}

/// Add the cells that the estimates mark, although a contact is too narrow for the sum of these
/// estimates. Otherwise a contact that stays narrow, as on a slender body in bending, would stop
/// the refinement. Collective.
template <int dim>
void Adaptation<dim>::add_marked_despite_narrow_contact(Refinement &to)
{
  const auto measured = solved->measured;
  try
    {
      estimate(*solved);
      add_marked(to);
    }
  catch (const SolveError &)
    {
      // no estimate: the contact alone is refined
    }
  solved->errors.clear();
  solved->measured = measured;
}

#define SNUG_INSTANTIATE(dim)                                                                       \
  template void       Adaptation<dim>::add_cells(const mesh::BodyMesh<dim> &, const Refinement &,   \
                                                 const std::vector<dealii::CellId> &, Refinement &, \
                                                 bool) const;                                       \
  template bool       Adaptation<dim>::reads_pressure() const;                                      \
  template bool       Adaptation<dim>::add_underresolved(Refinement &);                             \
  template void       Adaptation<dim>::add_marked(Refinement &) const;                              \
  template void       Adaptation<dim>::add_marked_despite_narrow_contact(Refinement &);             \
  template Refinement Adaptation<dim>::refined_everywhere() const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
