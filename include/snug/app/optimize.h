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
} // namespace snug::app

#endif
