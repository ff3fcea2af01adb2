#ifndef snug_base_warning_h
#define snug_base_warning_h

#include <limits>
#include <string>

namespace snug {
/// A result of a check that a user should know of, for the log and for summary.json.
struct Warning
{
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::string code; ///< the check, as in doc/output.md; never renamed
  std::string text; ///< one line
  /// number that is checked, and the bound beyond which the warning is given; none: of no number
  double value = none, bound = none;
};
} // namespace snug

#endif
