#ifndef snug_accuracy_accuracy_parameters_h
#define snug_accuracy_accuracy_parameters_h

#include <snug/base/values.h>

#include <optional>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::accuracy {
enum class Estimate
{
  none,
  energy,
  responses
};
inline Names names(Estimate)
{
  return {{"none"},
          {"energy", "the error of the displacement in the energy norm, by local problems in the "
                     "cells"},
          {"responses", "besides that, the errors of the objective and of all responses, by one "
                        "more linear solve for those that are no energies"}};
}

/// Entries of `subsection Accuracy`.
struct AccuracyParameters
{
  Estimate estimate = Estimate::energy;
  /// response -> what its error may be, see read_target(); empty: the mesh as given
  TextPairs    targets;
  unsigned int maximum_levels   = 12; ///< of a cell above its coarse cell
  double       maximum_unknowns = 2e6;
  double       marking_share    = 0.7; ///< of the error, refined at once
  double       contact_faces    = 8.;  ///< across a contact, before estimates are trusted
  /// states with targets on a finer mesh; none: where it is cheap
  std::optional<bool> verify = {};

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;
};
} // namespace snug::accuracy

#endif
