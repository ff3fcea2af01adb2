#ifndef snug_optimization_optimization_parameters_h
#define snug_optimization_optimization_parameters_h

#include <snug/base/values.h>
#include <snug/optimization/combination.h>

#include <string>
#include <utility>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::optimization {
/// The algorithms of the search: TrustRegion and MmaSearch.
enum class Algorithm
{
  SQP,
  MMA
};
inline Names names(Algorithm)
{
  return {{"SQP", "sequential quadratic programming in a trust region, for all constraints",
           "SLSQP"},
          {"MMA", "method of moving asymptotes (Svanberg, NLopt), for inequality constraints"}};
}

/// This struct holds the entries of `subsection Optimization`.
struct OptimizationParameters
{
  Algorithm   algorithm = Algorithm::SQP;
  std::string objective = "potential energy"; ///< name of a response
  Combination combine;                        ///< of the objective in the load cases
  /// response, or "load case.response", and its limit, see read_limit()
  std::vector<std::pair<std::string, std::string>> constraints;
  unsigned int                                     maximum_evaluations = 200;
  unsigned int                                     starts              = 1; ///< searches
  unsigned int draw_every           = 0;    ///< iterations; 0: the first and last design
  double       objective_tolerance  = 1e-8; ///< relative, of the objective
  double       design_tolerance     = 1e-7; ///< relative to bound widths
  double       gradient_tolerance   = 1e-6; ///< of the projected gradient
  double       constraint_tolerance = 1e-8; ///< relative to the target

  void declare(Entries &entries);
  /// Check that the constraints have limits that can be read and that the algorithm supports.
  /// @throws InputError.
  void check(const SectionCheck &section) const;
};
} // namespace snug::optimization

#endif
