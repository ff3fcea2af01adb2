#ifndef snug_qp_cycle_detector_h
#define snug_qp_cycle_detector_h

#include <snug/qp/active_set.h>

#include <cstdint>
#include <map>

namespace snug
{
  namespace qp
  {
    /// Counts the visits of active sets and says how careful to be.
    class CycleDetector
    {
    public:
      enum Care
      {
        none,
        exact,  ///< solve the inner problems more exactly
        single, ///< and change one row per step
        give_up
      };

      explicit CycleDetector(const ActiveSetOptions &options);

      /// The set with this fingerprint is entered once more.
      Care
      enter(std::uint64_t set);

    private:
      ActiveSetOptions                      options;
      std::map<std::uint64_t, unsigned int> visits;
      Care                                  care         = none;
      unsigned int                          single_steps = 0;
    };
  } // namespace qp
} // namespace snug

#endif
