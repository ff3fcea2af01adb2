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
/// Places of a sparse matrix, row by row with ascending columns.
struct CsrPattern
{
  unsigned int          n_rows    = 0;
  unsigned int          n_columns = 0;
  std::vector<PetscInt> row_start{0}; ///< n_rows + 1
  std::vector<PetscInt> columns;
};

/**
 * Compressed rows; the arrays are those PETSc's sequential AIJ format takes.
 * Copies share the pattern, which is never changed.
 */
class CsrMatrix
{
public:
  /// Without rows.
  CsrMatrix() : CsrMatrix(std::make_shared<CsrPattern>()) {}

  /// All values zero.
  explicit CsrMatrix(std::shared_ptr<const CsrPattern> pattern);

  /// @p values in the order of the pattern's columns.
  CsrMatrix(std::shared_ptr<const CsrPattern> pattern, std::vector<double> values);

  /// Empty pattern of the given rows; values are zero.
  static CsrMatrix from_rows(const std::vector<std::vector<PetscInt>> &columns_of_rows,
                             unsigned int                              n_columns);

  const std::shared_ptr<const CsrPattern> &pattern() const { return places; }

  unsigned int                 n_rows() const { return places->n_rows; }
  unsigned int                 n_columns() const { return places->n_columns; }
  const std::vector<PetscInt> &row_start() const { return places->row_start; }
  const std::vector<PetscInt> &columns() const { return places->columns; }

  /// Position of (i, j) in values; the entry must exist.
  std::size_t position(PetscInt i, PetscInt j) const;

  /// By search: for scales and set-up, not for inner loops.
  double diagonal(PetscInt i) const { return values[position(i, i)]; }

  double mean_diagonal() const;

  /// y += factor * A x, for every column.
  void multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;

  /// y += factor * A' x.
  void transpose_multiply_add(double factor, const qp::MultiVector &x, qp::MultiVector &y) const;

  /// y += A x of a symmetric A whose rows, none empty, are here up to the diagonal: half the memory
  /// to read, which is what takes time.
  void add_symmetric_product(const qp::MultiVector &x, qp::MultiVector &y) const;

  std::vector<double> values;

private:
  std::shared_ptr<const CsrPattern> places;
};

/// Two hashes with different beginnings: equal ones of unlike content do not happen.
using Fingerprint = std::array<std::uint64_t, 2>;

Fingerprint fingerprint(const CsrPattern &pattern);
Fingerprint fingerprint(const std::vector<double> &values); ///< of their bits

/// One copy of each pattern, for the many subdomains that are equal but for their values.
class SharedPatterns
{
public:
  /// One equal to @p pattern: itself if it is the first.
  std::shared_ptr<const CsrPattern> of(const std::shared_ptr<const CsrPattern> &pattern);

  /// @p A with the pattern that equal ones share.
  CsrMatrix of(CsrMatrix A) { return {of(A.pattern()), std::move(A.values)}; }

private:
  std::map<Fingerprint, std::shared_ptr<const CsrPattern>> known;
};
} // namespace snug::feti

#endif
