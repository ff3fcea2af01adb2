#ifndef snug_qp_cycle_detector_h
#define snug_qp_cycle_detector_h

#include <snug/qp/set_rules.h>

#include <cstdint>
#include <limits>
#include <map>

namespace snug::qp {
/// This class records the visited active sets and the KKT residuals, and decides how carefully the
/// active set method must proceed.
class CycleDetector
{
public:
  enum InnerAccuracy
  {
    none,
    exact,  ///< solve the inner problems more exactly
    single, ///< and change one row per step
    give_up
  };

  explicit CycleDetector(const SetRules &rules);

  /// Record a visit of the set with fingerprint @p set, coming from a set with @p kkt_residual.
  /// @p shrinks tells that the previous set contains all rows of this one.
  InnerAccuracy enter(std::uint64_t set, double kkt_residual, bool shrinks);

  /// Return the reason for giving up, for the log.
  const std::string &reason() const;

private:
  SetRules                              rules;
  std::map<std::uint64_t, unsigned int> visits;
  InnerAccuracy                         inner_accuracy = none;
  unsigned int                          single_steps   = 0;
  double                                least_residual = std::numeric_limits<double>::max();
  unsigned int idle_steps = 0; ///< steps with entering rows since the last fall by a tenth
  std::string  why;

  void count_visits(std::uint64_t set);
  void watch_residual(double kkt_residual, bool shrinks);
};
} // namespace snug::qp

#endif
