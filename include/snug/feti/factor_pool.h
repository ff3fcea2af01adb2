#ifndef snug_feti_factor_pool_h
#define snug_feti_factor_pool_h

#include <snug/base/run_context.h>
#include <snug/feti/sparse_factor.h>

#include <deque>
#include <memory>
#include <optional>

namespace snug::feti {
/**
 * This class holds the factorizations of one use, of which many exist at a time: those of the
 * subdomains of a design, or those of the faces that change with the active set. Equal matrices
 * share one factorization, also if the second matrix is requested later. An unused factorization is
 * recycled for another matrix of its pattern, which then needs no symbolic factorization. The
 * factorization that has been unused for the longest time is recycled first.
 */
class FactorPool
{
public:
  /// Create an empty pool. The default is CHOLMOD with its own orderings, whatever the package of
  /// the stiffness, because most matrices are small. Factorizations are counted in @p work. Both
  /// @p work and @p orderings must outlive this object. See SparseFactor for @p group.
  explicit FactorPool(MatrixKind                         of,
                      Factorization                      package   = Factorization::CHOLMOD,
                      FillOrderings                     *orderings = nullptr,
                      Work                              *work      = nullptr,
                      std::shared_ptr<const CoarseGroup> group     = nullptr);

  /// Return the factorization of @p A. It goes back to the pool when the pointer and its copies are
  /// destroyed. The pointer may outlive the pool.
  /// @throws SolveError see SparseFactor::factorize(), also for @p singular_size
  std::shared_ptr<const SparseFactor>
  factorize(const CsrMatrix &A, const std::string &what, double singular_size = 1e11) const;

private:
  /// Fingerprints of a pattern and of the values.
  using Key = std::pair<Fingerprint, Fingerprint>;

  /// An unused factor, with the fingerprint of the values that it factorizes. The fingerprint is
  /// empty if the factorization failed.
  struct Spare
  {
    std::optional<Fingerprint>    values;
    std::unique_ptr<SparseFactor> factor;
  };

  struct Items
  {
    std::map<Fingerprint, std::deque<Spare>>         spare; ///< unused factors of each pattern
    std::map<Key, std::weak_ptr<const SparseFactor>> used;
  };

  MatrixKind                         of;
  Factorization                      package;
  FillOrderings                     *orderings;
  Work                              *work;
  std::shared_ptr<const CoarseGroup> group;
  std::shared_ptr<Items>             items = std::make_shared<Items>();
};
} // namespace snug::feti

#endif
