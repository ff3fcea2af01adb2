#include <snug/feti/dense.h>

#include <petscsys.h>

#include <petscblaslapack.h>

#include <stdexcept>

namespace snug::feti {
namespace dense {
qp::MultiVector transpose_product(const qp::MultiVector &A, const qp::MultiVector &B)
{
  return qp::inner_products(A, B, MPI_COMM_SELF);
}

qp::MultiVector product(const qp::MultiVector &A, const qp::MultiVector &B)
{
  qp::MultiVector C(A.n_rows(), B.n_columns());
  C.add_product(1., A, B);
  return C;
}

// LAPACK works on the columns where they are; dealii::LAPACKFullMatrix would
// copy them in and out, and has no eigenvectors of all of a symmetric matrix.
qp::MultiVector solve_spd(qp::MultiVector A, qp::MultiVector B)
{
  const PetscBLASInt n = A.n_rows(), k = B.n_columns();
  PetscBLASInt       info = 0;
  if (n == 0 || k == 0)
    return B;
  LAPACKpotrf_("L", &n, A.column(0), &n, &info);
  if (info != 0)
    throw std::runtime_error("a small matrix is not positive definite");
  LAPACKpotrs_("L", &n, &k, A.column(0), &n, B.column(0), &n, &info);
  return B;
}

std::vector<double> eigen(qp::MultiVector &A)
{
  const PetscBLASInt  n = A.n_rows(), n_work = 34 * n + 1;
  std::vector<double> values(n), work(n_work);
  PetscBLASInt        info = 0;
  if (n > 0)
    LAPACKsyev_("V", "L", &n, A.column(0), &n, values.data(), work.data(), &n_work, &info);
  if (info != 0)
    throw std::runtime_error("a small eigenvalue problem failed");
  return values;
}
} // namespace dense
} // namespace snug::feti
