#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>
#include <snug/geometry/body_sources.h>
#include <snug/mesh/refined_cells.h>

#include <algorithm>
#include <iterator>

namespace snug::app {
template <int dim>
bool Adaptation<dim>::reads_pressure() const
{
  return std::any_of(demands.begin(), demands.end(),
                     [](const auto &demand) { return demand.reads_pressure; });
}

/// Return the part of pressures that the roughness of gaps between nodes may change. The part is
/// smaller for responses that are functions of pressures, because the roughness changes others
/// little. Collective.
template <int dim>
double Adaptation<dim>::allowed_roughness() const
{
  double                              least  = 0.1;
  const auto                         &solver = *solved->problem->solver;
  std::vector<response::PressureRows> none(solver.contact(0).named_pairs().size());
  for (unsigned int d = 0; d < demands.size(); ++d)
    if (solved->responses[demands[d].place]->measured(solver, 0, none))
      least = std::min(least, 0.25 * demands[d].allowed(solved->measured[d]) /
                                std::max(std::abs(solved->measured[d].value),
                                         std::numeric_limits<double>::min()));
  return least;
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
      meshes.add_cells(solver.mesh(), last_refinement,
                       mesh::gather_cells(solver.mesh(), solver.surface().cells_of(faces)), to);
      auto       found  = accuracy::unresolved_gaps(solver, state, allowed_roughness());
      const auto before = to;
      meshes.add_cells(solver.mesh(), last_refinement, found.cells, to);
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
        meshes.add_cells(mesh, last_refinement, marked, to);
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

#define SNUG_INSTANTIATE(dim)                                       \
  template bool   Adaptation<dim>::reads_pressure() const;          \
  template double Adaptation<dim>::allowed_roughness() const;       \
  template bool   Adaptation<dim>::add_underresolved(Refinement &); \
  template void   Adaptation<dim>::add_marked(Refinement &) const;  \
  template void   Adaptation<dim>::add_marked_despite_narrow_contact(Refinement &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
