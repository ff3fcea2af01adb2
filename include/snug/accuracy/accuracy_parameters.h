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
  return {
    {"none"},
    {"energy",
     "error of the displacement in the energy norm, by local problems in the cells; of several "
     "load cases that with the largest strain energy"},
    {"responses", "also the errors of the objective and of all responses in all load cases, by "
                  "one more linear solve for responses that are no energies"}};
}

/// Entries of `subsection Accuracy`.
struct AccuracyParameters
{
  Estimate estimate = Estimate::energy;
  /// response -> maximum error, see read_target(); empty: the mesh is used as given
  TextPairs    targets;
  unsigned int maximum_levels   = 12; ///< maximum level of a cell above its coarse cell
  double       maximum_unknowns = 2e6;
  double       marking_share    = 0.7; ///< maximum share of the error in the cells refined at once
  double       contact_faces    = 8.;  ///< minimum number across a contact with trusted estimates
  /// whether states with targets are solved on a finer mesh too; no value: if the finer mesh is
  /// cheap
  std::optional<bool> verify = {};

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;
};
} // namespace snug::accuracy

#endif
