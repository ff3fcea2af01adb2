#include <snug/accuracy/accuracy_parameters.h>
#include <snug/base/entries.h>

namespace snug::accuracy {
void AccuracyParameters::declare(Entries &entries)
{
  entries.add("Estimate", estimate,
              "What is estimated of the mesh's error, once per state and of the final design.");
}
} // namespace snug::accuracy
