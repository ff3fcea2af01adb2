#ifndef snug_qp_direction_basis_h
#define snug_qp_direction_basis_h

#include <snug/qp/dual_problem.h>

namespace snug::qp {
/// Directions P of a Krylov method and the products F P (n_owned x n each). Directions of Pcpg are
/// conjugate, P' F P = unit I. The unit is a power of two of the size of F: no square root of the
/// units of F is taken, so that scaling F by a power of two changes no digit.
struct DirectionBasis
{
  MultiVector P{0, 0}, FP{0, 0};
  double      unit         = 1.;
  bool        is_conjugate = true; ///< false for directions of ProjectedGcr

  /**
   * Return a basis of the part of the span of conjugate directions that vanishes on @p rows. This
   * costs no F-mult. The basis is empty if at least as many of these rows have nonzeros as there
   * are directions. Collective.
   */
  DirectionBasis off(const RowSet &rows, MPI_Comm comm) const;
};

/// Return an orthonormal basis, n x (n - rank), of the null space of @p A (m x n, n > 0). Singular
/// values up to @p cut count as rounding errors.
MultiVector null_space(const MultiVector &A, double cut);
} // namespace snug::qp

#endif
