#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>
#include <snug/mesh/refined_cells.h>

#include <algorithm>
#include <iterator>

namespace snug::app {
template <int dim>
void Adaptation<dim>::add(const std::vector<dealii::CellId> &marked, RefinedCells &cells) const
{
  for (const auto &cell : marked)
    if (mesh::level(cell) < scene.accuracy.maximum_levels)
      mesh::refine(cell, cells);
}

template <int dim>
bool Adaptation<dim>::reads_pressure() const
{
  return std::any_of(demands.begin(), demands.end(),
                     [](const auto &demand) { return demand.reads_pressure; });
}

/// Cells of contacts of too few faces, if a response reads their pressure, of those all but closed,
/// and of gaps that have more than these. @return whether there are any. Collective.
template <int dim>
bool Adaptation<dim>::add_doubtful(RefinedCells &cells)
{
  unresolved.clear();
  const auto &solver   = *solved->problem->solver;
  bool        doubtful = false;
  for (const auto &state : solved->states)
    {
      const auto faces =
        accuracy::underresolved_contact(solver, state,
                                        reads_pressure() ? scene.accuracy.contact_faces : 0.);
      doubtful = doubtful || !faces.empty();
      add(mesh::gather_cells(solver.mesh(), solver.surface().cells_of(faces)), cells);
      auto       found  = accuracy::unresolved_gaps(solver, state, rough_part());
      const auto before = cells.size();
      add(found.cells, cells);
      doubtful = doubtful || cells.size() > before;
      std::move(found.lines.begin(), found.lines.end(), std::back_inserter(unresolved));
    }
  return doubtful;
}

/// Cells of the demands that are not met. Collective.
template <int dim>
void Adaptation<dim>::add_marked(RefinedCells &cells) const
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
        add(marked, cells);
      }
}

/// Add the cells that the estimates mark, although a contact is too narrow for the sum of these
/// estimates. Otherwise a contact that stays narrow, as on a slender body in bending, would stop
/// the refinement. Collective.
template <int dim>
void Adaptation<dim>::add_marked_beside(RefinedCells &cells)
{
  const auto measured = solved->measured;
  try
    {
      estimate(*solved);
      add_marked(cells);
    }
  catch (const SolveError &)
    {
      // no estimate: the contact alone is refined
    }
  solved->errors.clear();
  solved->measured = measured;
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template void Adaptation<dim>::add(const std::vector<dealii::CellId> &, RefinedCells &) const; \
  template bool Adaptation<dim>::reads_pressure() const;                                         \
  template bool Adaptation<dim>::add_doubtful(RefinedCells &);                                   \
  template void Adaptation<dim>::add_marked(RefinedCells &) const;                               \
  template void Adaptation<dim>::add_marked_beside(RefinedCells &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
