#ifndef snug_app_conclusion_h
#define snug_app_conclusion_h

#include <snug/app/search.h>

#include <limits>
#include <vector>

namespace snug::app {
/// Values of the first and the last design of a search that the caller has computed already.
struct Known
{
  bool is_paired = false; ///< contact is, at the last design
  /// of the first design; none (NaN): what the search says, and no error
  double initial = std::numeric_limits<double>::quiet_NaN(), initial_error = initial;
  std::vector<MeshError> errors; ///< of the last; empty: they are estimated
};

/**
 * Draw and summarize the design a search has found: its state, what its gain is worth where errors
 * are estimated, and what it is worth with contact paired anew, with warnings. Ends all states.
 * Collective. @throws SolveError if the design has no state.
 */
template <int dim>
void conclude(Search<dim>                            &search,
              const Books<dim>                       &books,
              const optimization::OptimizationResult &result,
              const Known                            &known = {});
} // namespace snug::app

#endif
