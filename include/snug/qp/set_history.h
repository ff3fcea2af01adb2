#ifndef snug_qp_set_history_h
#define snug_qp_set_history_h

#include <snug/qp/active_set.h>

#include <cstdint>
#include <limits>
#include <map>

namespace snug::qp {
/// The active sets met so far and the KKT residuals they were left with;
/// says how careful to be.
class SetHistory
{
public:
  enum Care
  {
    none,
    exact,  ///< solve the inner problems more exactly
    single, ///< and change one row per step
    give_up
  };

  explicit SetHistory(const ActiveSetOptions &options);

  /// The set with this fingerprint is entered once more, coming from one
  /// with @p kkt_residual; @p shrinks: which has all its rows.
  Care enter(std::uint64_t set, double kkt_residual, bool shrinks);

  /// What the sets do, for the log, when it is time to give up.
  const std::string &reason() const;

private:
  ActiveSetOptions                      options;
  std::map<std::uint64_t, unsigned int> visits;
  Care                                  care           = none;
  unsigned int                          single_steps   = 0;
  double                                least_residual = std::numeric_limits<double>::max();
  unsigned int idle_steps = 0; ///< with rows that enter, since it fell by a tenth
  std::string  why;

  void count_visits(std::uint64_t set);
  void watch_residual(double kkt_residual, bool shrinks);
};
} // namespace snug::qp

#endif
