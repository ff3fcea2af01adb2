#ifndef snug_optimization_limit_h
#define snug_optimization_limit_h

#include <string>

namespace snug::optimization {
/// Constraint of a response: an upper, a lower or a required value.
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

/// The limit of "<= 120", "= initial", ">= 0.9 initial"; without a sign,
/// equal. @throws std::invalid_argument for anything else.
Limit read_limit(const std::string &text);
} // namespace snug::optimization

#endif
