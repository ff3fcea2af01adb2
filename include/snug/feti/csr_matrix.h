#ifndef snug_feti_csr_matrix_h
#define snug_feti_csr_matrix_h

#include <snug/qp/multi_vector.h>

#include <petscsystypes.h>

#include <vector>

namespace snug::feti {
/**
 * Compressed rows with ascending columns; the arrays PETSc's sequential
 * AIJ format takes without a copy.
 */
struct CsrMatrix
{
  unsigned int          n_rows    = 0;
  unsigned int          n_columns = 0;
  std::vector<PetscInt> row_start; ///< n_rows + 1
  std::vector<PetscInt> columns;
  std::vector<double>   values;

  /// Empty pattern of the given rows; values are zero.
  static CsrMatrix from_rows(const std::vector<std::vector<PetscInt>> &columns_of_rows,
                             unsigned int                              n_columns);

  /// Position of (i, j) in values; the entry must exist.
  std::size_t position(PetscInt i, PetscInt j) const;

  /// By search: for scales and set-up, not for inner loops.
  double diagonal(PetscInt i) const { return values[position(i, i)]; }

  double mean_diagonal() const;

  /// y += factor * A x, for every column.
  void multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;

  /// y += factor * A' x.
  void transpose_multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;
};
} // namespace snug::feti

#endif
