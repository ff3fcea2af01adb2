#ifndef snug_app_optimize_h
#define snug_app_optimize_h

#include <snug/app/results.h>

namespace snug::app {
/**
 * Minimize the objective of a scene: one search after the other, with
 * contact paired anew in between where the design has moved slave nodes
 * along the master. Leaves the journal (that of the output directory goes
 * on if @p restart), the history, pictures of the first and the last design
 * and the summary. Collective.
 * @return what is wrong with the result; see optimization::complaint().
 * @throws InputError, SolveError.
 */
template <int dim>
std::string optimize(ShapeProblem<dim> &problem, Results<dim> &results, bool restart);

/**
 * The same to targets of accuracy: a search on a mesh made for its start with errors of 8 times the
 * targets, one from there with 3 times, and then with the targets, until the mesh is also one for
 * the design found. The first design and the last are worth what meshes made for them say.
 * Makes its own output. Collective.
 * @return what is wrong with the result; empty: nothing.
 * @throws InputError, SolveError if the first design has no state.
 */
template <int dim>
std::string optimize_to_targets(RunContext &context, const scene::Scene &scene, bool restart);
} // namespace snug::app

#endif
