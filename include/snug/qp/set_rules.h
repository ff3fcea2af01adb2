#ifndef snug_qp_set_rules_h
#define snug_qp_set_rules_h

#include <limits>
#include <string>

namespace snug::qp {
/// Accuracy of inner solves of a set iteration, and limits for repeated sets and stalled residuals.
/// The defaults are those without friction.
struct SetRules
{
  std::string method = "active set"; ///< in messages
  /// Tolerance of inner solves, as a part of the KKT residual. Rough solutions show which rows
  /// leave as well as exact solutions do, and the directions found on the way are kept. Measured on
  /// contact problems: 0.7 takes up to a third fewer F-mults than 0.1.
  double forcing = 0.7;
  /// Factor of #forcing where the sets have not changed.
  double settled = 1.;
  /// The same after #many_repairs changes of sets that left a loaded motion free.
  double       exact_forcing = 0.7;
  unsigned int many_repairs  = std::numeric_limits<unsigned int>::max();
  /// Number of visits of one set after which the inner problems are solved more exactly. After one
  /// more visit, only one row changes per step.
  unsigned int visits = 3;
  /// Number of steps that change one row each, before another method takes over.
  unsigned int single_steps = 50;
  /// Number of steps with entering rows and without a KKT residual a tenth below all previous ones,
  /// after which another method takes over. Contact problems that are solved take 5 to 30 steps in
  /// all.
  unsigned int patience = 30;
  /// Number of consecutive solves on the same sets that may fail to halve the KKT residual, or to
  /// converge.
  unsigned int allowed_stalls = 3;
  /// Part of the maximum number of F-mults after which cycles are left to another method.
  double in_cycles = 0.25;
  /// True if the limits of friction forces are those of the last step, and do not follow the normal
  /// forces of the step.
  bool is_lagging = false;
};
} // namespace snug::qp

#endif
