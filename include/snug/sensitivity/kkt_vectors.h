#ifndef snug_sensitivity_kkt_vectors_h
#define snug_sensitivity_kkt_vectors_h

#include <snug/feti/subdomain_system.h>

namespace snug::sensitivity {
/**
 * Vectors of the optimality system of a state, one per column. A vector has a part per unknown and
 * a part per row of B. Both the derivatives (u', lambda') and the residuals that determine them
 * have this form. If there is no subdomain, the primal part is zero.
 */
struct KktVectors
{
  feti::PrimalVectors primal; ///< per subdomain of this rank
  qp::MultiVector     dual;   ///< owned rows
  /// Owned rows; of derivatives: the given parts of the multipliers, see bound_derivatives(). No
  /// columns: zero
  qp::MultiVector given = qp::MultiVector(0, 0);
};

/// Return x'y, the sum over all three parts, summed over ranks (x columns x y columns). Collective.
qp::MultiVector products(const KktVectors &x, const KktVectors &y, MPI_Comm comm);

/// Add row @p i of @p products to @p values.
void add_row(const qp::MultiVector &products, unsigned int i, std::vector<double> &values);
} // namespace snug::sensitivity

#endif
