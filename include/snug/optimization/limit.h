#ifndef snug_optimization_limit_h
#define snug_optimization_limit_h

#include <string>

namespace snug::optimization {
/// This struct describes the limit of a response: an upper, a lower or a required value.
struct Limit
{
  enum class Side
  {
    at_most,
    equal,
    at_least
  };

  Side   side       = Side::equal;
  double value      = 1.;
  bool   of_initial = true; ///< value is a factor of the first design's
};

/// Return the limit of "<= 120", "= initial" or ">= 0.9 initial". A text without a sign is a
/// required value. @throws std::logic_error, such as std::invalid_argument, for other texts.
Limit read_limit(const std::string &text);

/// Return the name of a constraint of @p name with a limit, such as "volume = initial".
std::string constraint_text(const std::string &name, const std::string &limit);
} // namespace snug::optimization

#endif
