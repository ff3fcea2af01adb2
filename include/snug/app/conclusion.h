#ifndef snug_app_conclusion_h
#define snug_app_conclusion_h

#include <snug/app/search.h>

#include <limits>
#include <vector>

namespace snug::app {
/// This struct holds results of a search that are known before the search is reported.
struct PriorResults
{
  bool is_paired = false; ///< contact was searched at the last design
  /// objective of the first design and its error; NaN: as the search found it, without an error
  double initial = std::numeric_limits<double>::quiet_NaN(), initial_error = initial;
  std::vector<MeshError> errors; ///< of the last design; empty: they are estimated
};

/**
 * Draw and summarize the design that a search has found: its analysis, the gain of the objective
 * with the estimated error, and the values after a new contact search, with warnings. All
 * states of @p search become invalid. Collective. @throws SolveError if the design has no state.
 */
template <int dim>
void report_result(Search<dim>                            &search,
                   const optimization::OptimizationResult &result,
                   const PriorResults                     &prior = {});
} // namespace snug::app

#endif
