#ifndef snug_qp_krylov_columns_h
#define snug_qp_krylov_columns_h

#include <snug/qp/multi_vector.h>

#include <limits>

namespace snug::qp {
/// Result of a Krylov method for several right-hand sides, one column each.
struct KrylovResult
{
  unsigned int        iterations = 0;
  std::vector<double> residual_norms; ///< of the projected residuals
  /// True if every column is within its tolerance or zero up to rounding. False if the iterations
  /// ran out or the residual stalled.
  bool converged = false;
  /// True if the residual exceeds its tolerance, but is rounding error and has stalled. converged
  /// is then true as well.
  bool at_rounding = false;
};

/// This class decides which columns of a block still need directions, and when the iteration ends.
class KrylovColumns
{
public:
  explicit KrylovColumns(MPI_Comm the_comm) : comm(the_comm) {}

  /**
   * Compare the projected residuals @p r with the absolute @p tolerances. @p residual is the
   * residual before the projection, whose rounding error bounds the accuracy. Update the norms and
   * flags of @p result.
   * @return whether the iteration ends. Collective.
   */
  bool ends(const MultiVector         &r,
            const MultiVector         &residual,
            const std::vector<double> &tolerances,
            unsigned int               max_iterations,
            KrylovResult              &result);

  /// Return some of the remaining columns of @p r, relative to their tolerances, whose span is near
  /// all the others. Collective.
  MultiVector leading_part(const MultiVector &r) const;

private:
  bool stagnates(double worst, bool is_rounding);

  MPI_Comm                  comm;
  std::vector<double>       first, goals;
  std::vector<unsigned int> remaining;
  double                    best   = std::numeric_limits<double>::infinity();
  unsigned int              waited = 0; ///< iterations since the minimum of the worst column
};
} // namespace snug::qp

#endif
