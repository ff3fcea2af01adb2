#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/qp/multi_vector.h>


#include <petscsys.h>

#include <petscblaslapack.h>

#include <cmath>

namespace snug::qp {
MultiVector::MultiVector(unsigned int n_rows, unsigned int n_columns)
  : rows(n_rows), columns(n_columns), values(std::size_t(n_rows) * n_columns, 0.)
{}

void MultiVector::add(double factor, const MultiVector &x)
{
  SNUG_ASSERT(rows == x.rows && columns == x.columns, "the sizes of the summands differ");
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += factor * x.values[i];
}

void MultiVector::add_product(double factor, const MultiVector &x, const MultiVector &C)
{
  SNUG_ASSERT(rows == x.rows && x.columns == C.rows && columns == C.columns,
              "the sizes of the factors do not fit");
  const PetscBLASInt m = rows, n = columns, k = x.columns, stride = 1;
  const double       one = 1.;
  if (m == 0 || n == 0 || k == 0)
    return;
  // Use dgemv for one column, because dgemm is slower.
  if (n == 1)
    BLASgemv_("N", &m, &k, &factor, x.column(0), &m, C.column(0), &stride, &one, column(0),
              &stride);
  else
    BLASgemm_("N", "N", &m, &n, &k, &factor, x.column(0), &m, C.column(0), &k, &one, column(0), &m);
}

/// Columns are contiguous, so appending columns does not move the others within the array.
void MultiVector::append(const MultiVector &x)
{
  SNUG_ASSERT_EQUAL(rows, x.rows);
  values.insert(values.end(), x.values.begin(), x.values.end());
  columns += x.columns;
}

void MultiVector::reserve(unsigned int n)
{
  values.reserve(std::size_t(n) * rows);
}

MultiVector MultiVector::columns_from(unsigned int first, unsigned int n) const
{
  SNUG_ASSERT_BELOW(first + n, columns + 1);
  MultiVector part(rows, n);
  part.values.assign(column(first), column(first) + std::size_t(n) * rows);
  return part;
}

/// The order of the summation depends on the number of ranks, and with it the last digits. For a
/// given number of ranks they are reproducible and equal on all ranks, so that decisions agree.
MultiVector inner_products(const MultiVector &X, const MultiVector &Y, MPI_Comm comm)
{
  MultiVector products(X.n_columns(), Y.n_columns());
  SNUG_ASSERT_EQUAL(X.n_rows(), Y.n_rows());
  const PetscBLASInt m = X.n_columns(), n = Y.n_columns(), k = X.n_rows();
  const PetscBLASInt stride = 1;
  const double       one = 1., zero = 0.;
  if (k > 0 && m > 0 && n == 1)
    BLASgemv_("T", &k, &m, &one, X.column(0), &k, Y.column(0), &stride, &zero, products.column(0),
              &stride);
  else if (k > 0 && m > 0 && n > 0)
    BLASgemm_("T", "N", &m, &n, &k, &one, X.column(0), &k, Y.column(0), &k, &zero,
              products.column(0), &m);
  MPI_Allreduce(MPI_IN_PLACE, products.column(0), m * n, MPI_DOUBLE, MPI_SUM, comm);
  return products;
}

MultiVector transpose_times(const MultiVector &X, const MultiVector &Y)
{
  return inner_products(X, Y, MPI_COMM_SELF);
}

std::vector<double> norms(const MultiVector &X, MPI_Comm comm)
{
  std::vector<double> squares(X.n_columns(), 0.);
  for (unsigned int j = 0; j < X.n_columns(); ++j)
    for (unsigned int i = 0; i < X.n_rows(); ++i)
      squares[j] += X(i, j) * X(i, j);
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), narrow<int>(squares.size()), MPI_DOUBLE, MPI_SUM,
                comm);
  for (double &square : squares)
    square = std::sqrt(square);
  return squares;
}

MultiVector times(const MultiVector &x, const MultiVector &C)
{
  MultiVector product(x.n_rows(), C.n_columns());
  product.add_product(1., x, C);
  return product;
}

MultiVector rows_of(const MultiVector &x, const std::vector<unsigned int> &numbers)
{
  MultiVector result(narrow<unsigned int>(numbers.size()), x.n_columns());
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < numbers.size(); ++i)
      result(i, k) = x(numbers[i], k);
  return result;
}
} // namespace snug::qp
