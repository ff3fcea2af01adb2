#include <snug/base/narrow.h>
#include <snug/feti/coarse_space.h>
#include <snug/feti/dense.h>

#include <algorithm>

namespace snug::feti {
namespace {
/// Below this, relative to the largest, an eigenvalue of the rigid
/// modes of the bodies is a motion the rows do not see.
const double kernel_cut = 1e-10;

/// A X; CsrMatrix itself only adds to a result.
qp::MultiVector multiply_columns(const CsrMatrix &A, const qp::MultiVector &X)
{
  qp::MultiVector Y(A.n_rows, X.n_columns());
  A.multiply_add(1., X, Y);
  return Y;
}

/// Orthonormal N = Z y over the kernel of Z' A Z.
qp::MultiVector kernel_of(const CsrMatrix &A, const qp::MultiVector &Z)
{
  // G_M G_M' is assembled from the rows of M only. A motion without strain and without relative
  // motion at the gluing moves each body rigidly, so its kernel lies in the span of Z and the dense
  // problem has at most 6 unknowns per body, however many subdomains there are.
  qp::MultiVector vectors = dense::transpose_product(Z, multiply_columns(A, Z));
  const auto      values  = dense::eigen(vectors);
  unsigned int    n_null  = 0;
  double          trace   = 0.;
  for (unsigned int i = 0; i < A.n_rows; ++i)
    trace += A.diagonal(i);
  while (n_null < values.size() && values[n_null] <= kernel_cut * trace / A.n_rows)
    ++n_null;
  return dense::product(Z, vectors.columns_from(0, n_null));
}
} // namespace

/// The matrix is replicated: every rank factorizes it, and solving needs no communication.
CoarseProblem::CoarseProblem(const CoarseSpace &space, const qp::RowSet &free)
  : A(space.factors().take(space.pattern()))
{
  CsrMatrix &matrix = A->matrix;
  const auto values = space.gram_values(free);
  std::copy(values.begin(), values.end(), matrix.values.begin());
  N = kernel_of(matrix, space.body_modes());
  // The same way out as fixing nodes for K: A N = rho N_f, so A^-1 is a generalized inverse, and
  // only the unknowns of one subdomain per body become coupled.
  if (N.n_columns() > 0)
    {
      const auto        &f   = space.representatives();
      const unsigned int r   = N.n_columns();
      const auto         n_f = narrow<unsigned int>(f.size());
      qp::MultiVector    N_f(n_f, r), N_f_transposed(r, n_f);
      // Of the size of G_M G_M', as rho of K_rho is of that of K.
      double rho = 0.;
      for (unsigned int i = 0; i < matrix.n_rows; ++i)
        rho += matrix.diagonal(i) / matrix.n_rows;
      for (unsigned int i = 0; i < f.size(); ++i)
        for (unsigned int j = 0; j < r; ++j)
          N_f(i, j) = N_f_transposed(j, i) = N(f[i], j);
      const auto Q = dense::transpose_product(N_f_transposed,
                                              dense::solve_spd(dense::transpose_product(N_f, N_f),
                                                               N_f_transposed));
      for (unsigned int i = 0; i < f.size(); ++i)
        for (unsigned int j = 0; j < f.size(); ++j)
          matrix.values[matrix.position(f[i], f[j])] += rho * Q(i, j);
    }
  // The item may be one that an earlier face left behind: its values are another set's until here.
  A->factor.factorize("the coarse problem G G'");
}

qp::MultiVector CoarseProblem::solve(const qp::MultiVector &c) const
{
  qp::MultiVector alpha(c.n_rows(), c.n_columns());
  A->factor.solve(c, alpha);
  // Solutions differ by the kernel N; without it they are those of the pseudo-inverse if c is in
  // the range of G_M G_M'. Other c, of loads that M cannot hold, lose a combination of N_f: the
  // result is then only good to find out that they are not balanced.
  alpha.add(-1., kernel_part(alpha));
  return alpha;
}

qp::MultiVector CoarseProblem::kernel_part(const qp::MultiVector &c) const
{
  return dense::product(N, dense::transpose_product(N, c));
}
} // namespace snug::feti
