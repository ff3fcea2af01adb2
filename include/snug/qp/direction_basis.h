#ifndef snug_qp_direction_basis_h
#define snug_qp_direction_basis_h

#include <snug/qp/dual_problem.h>

namespace snug::qp {
/// Directions P with P' F P = unit I, and F P (n_owned x n each). The unit
/// is a power of two of F's size: nothing takes a square root of F's units,
/// so that scaling F by a power of two changes no digit.
struct DirectionBasis
{
  MultiVector P{0, 0}, FP{0, 0};
  double      unit = 1.;

  /**
   * Such a basis of the directions' span that vanishes on
   * @p rows; without F-mults. Empty if there are as many of these rows
   * with nonzeros as directions. Collective.
   */
  DirectionBasis off(const RowSet &rows, MPI_Comm comm) const;
};

/// Orthonormal basis, n x (n - rank), of what @p A (m x n, n > 0) takes to zero:
/// singular values up to @p cut are rounding.
MultiVector null_space(const MultiVector &A, double cut);
} // namespace snug::qp

#endif
