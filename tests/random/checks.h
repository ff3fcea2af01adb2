#ifndef snug_tests_random_checks_h
#define snug_tests_random_checks_h

#include <string>

namespace snug::test {
/// Outcome of a problem.
struct Outcome
{
  enum Kind
  {
    solved,    ///< and nothing is free to move
    neutral,   ///< solved, with bodies that are free to move
    refused,   ///< no equilibrium
    undecided, ///< too near to tell, or nothing to compare with
    invalid,   ///< the input was refused
    wrong
  };
  Kind          kind = invalid;
  std::string   message;
  double        force_error        = 0.; ///< relative to the largest force
  double        displacement_error = 0.; ///< relative to the largest displacement or gap
  unsigned long f_mults            = 0;
};

/// Solve the scene of @p text with Snug on all ranks and compare with the
/// dense oracle. Collective, and equal on all ranks.
Outcome check_scene(const std::string &name, const std::string &text);
} // namespace snug::test

#endif
