#ifndef snug_accuracy_accuracy_parameters_h
#define snug_accuracy_accuracy_parameters_h

#include <snug/base/values.h>

namespace snug {
class Entries;
}

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

  void declare(Entries &entries);
};
} // namespace snug::accuracy

#endif
