#ifndef snug_feti_csr_matrix_h
#define snug_feti_csr_matrix_h

#include <snug/qp/multi_vector.h>

#include <petscsystypes.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace snug::feti {
/// Positions of the entries of a sparse matrix, row by row with ascending columns.
struct CsrPattern
{
  unsigned int          n_rows    = 0;
  unsigned int          n_columns = 0;
  std::vector<PetscInt> row_start{0}; ///< n_rows + 1 numbers
  std::vector<PetscInt> columns;

  /// Return the position of (i, j) in columns. The entry must exist.
  std::size_t position(PetscInt i, PetscInt j) const;
};

/**
 * A sparse matrix in compressed rows. The arrays are those of PETSc's sequential AIJ format. Copies
 * share the pattern, which is never changed.
 */
class CsrMatrix
{
public:
  /// Create a matrix without rows.
  CsrMatrix() : CsrMatrix(std::make_shared<CsrPattern>()) {}

  /// Create a matrix with the given pattern and zero values.
  explicit CsrMatrix(std::shared_ptr<const CsrPattern> pattern);

  /// Create a matrix with @p values in the order of the pattern's columns.
  CsrMatrix(std::shared_ptr<const CsrPattern> pattern, std::vector<double> values);

  /// Return a matrix with zero values whose row i has the columns @p columns_of_rows[i], ascending.
  static CsrMatrix from_rows(const std::vector<std::vector<PetscInt>> &columns_of_rows,
                             unsigned int                              n_columns);

  const std::shared_ptr<const CsrPattern> &pattern() const { return places; }

  unsigned int                 n_rows() const { return places->n_rows; }
  unsigned int                 n_columns() const { return places->n_columns; }
  const std::vector<PetscInt> &row_start() const { return places->row_start; }
  const std::vector<PetscInt> &columns() const { return places->columns; }

  /// Return the position of (i, j) in values. The entry must exist.
  std::size_t position(PetscInt i, PetscInt j) const { return places->position(i, j); }

  /// Return the diagonal entry of row @p i. The function searches the row, so it is meant for
  /// scales and set-up, not for inner loops.
  double diagonal(PetscInt i) const { return values[position(i, i)]; }

  double mean_diagonal() const;

  /// Add factor * A x to y, for every column.
  void multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;

  /// Add factor * A' x to y, for every column.
  void transpose_multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;

  /// Add A x to y for a symmetric A of which only the lower triangle is stored. Every row must end
  /// with its diagonal entry. This halves the memory to read, which determines the computing time.
  void add_symmetric_product(const qp::MultiVector &x, qp::MultiVector &y) const;

  std::vector<double> values;

private:
  std::shared_ptr<const CsrPattern> places;
};

/// Two hashes with different initial values. Different contents never have equal pairs in practice.
using Fingerprint = std::array<std::uint64_t, 2>;

Fingerprint fingerprint(const CsrPattern &pattern);
Fingerprint fingerprint(const std::vector<double> &values); ///< hash of the bits of the values

/// This class keeps one copy of each pattern, for many subdomains that differ only in their values.
class SharedPatterns
{
public:
  /// Return the stored pattern that equals @p pattern. The first of equal patterns is stored.
  std::shared_ptr<const CsrPattern> of(const std::shared_ptr<const CsrPattern> &pattern);

  /// Return @p A with the shared copy of its pattern.
  CsrMatrix of(CsrMatrix A) { return {of(A.pattern()), std::move(A.values)}; }

private:
  std::map<Fingerprint, std::shared_ptr<const CsrPattern>> known;
};
} // namespace snug::feti

#endif
