#include <snug/qp/cycle_detector.h>

namespace snug
{
  namespace qp
  {
    CycleDetector::CycleDetector(const ActiveSetOptions &options)
      : options(options)
    {
    }

    CycleDetector::Care
    CycleDetector::enter(std::uint64_t set)
    {
      const unsigned int n = ++visits[set];
      if (care == single &&
          (++single_steps > options.single_steps || n >= options.visits))
        care = give_up;
      else if (care < single && n >= options.visits)
        {
          care = n == options.visits ? exact : single;
          if (care == single)
            visits.clear();
        }
      return care;
    }
  } // namespace qp
} // namespace snug
