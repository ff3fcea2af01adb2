#ifndef snug_app_result_table_h
#define snug_app_result_table_h

#include <snug/app/search.h>

namespace snug::app {
/**
 * Print the objective, the constraints with their limits, and all other values of an optimization
 * in its first and its last design as a table, with the places of the largest values, and then the
 * forces of the last design. A constraint is active if its value is at its limit.
 * @param[in] first,last Evaluations of the first and of the last design.
 * @param[in] states Those of the last design. Collective.
 */
template <int dim>
void print_result_table(const Search<dim>                        &search,
                        const optimization::Evaluation           &first,
                        const optimization::Evaluation           &last,
                        const typename ShapeProblem<dim>::States &states);
} // namespace snug::app

#endif
