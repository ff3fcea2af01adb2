#ifndef snug_feti_factor_pool_h
#define snug_feti_factor_pool_h

#include <snug/base/run_context.h>
#include <snug/feti/sparse_factor.h>

#include <deque>
#include <memory>
#include <optional>

namespace snug::feti {
/**
 * Factorizations of one use, of which many live at a time, as those of the subdomains of a design
 * and of faces that come and go with the active set. Equal matrices share one, also later; what
 * nobody uses any more serves other matrices of its pattern with its symbolic factorization, the
 * one that has waited longest first.
 */
class FactorPool
{
public:
  /// By CHOLMOD with orders of its own unless said otherwise: most matrices are small, whatever
  /// the package of the stiffness. Counts factorizations in @p work; it and @p orderings must
  /// outlive this object. With a @p team see SparseFactor.
  explicit FactorPool(FactorOf                    of,
                      Factorization               package   = Factorization::CHOLMOD,
                      FillOrderings              *orderings = nullptr,
                      Work                       *work      = nullptr,
                      std::shared_ptr<const Team> team      = nullptr);

  /// The factorization of @p A, which returns when the pointer and its copies are gone; that may be
  /// after the end of the pool.
  /// @throws SolveError see SparseFactor::factorize()
  std::shared_ptr<const SparseFactor> factorize(const CsrMatrix &A, const std::string &what) const;

private:
  /// Of a pattern and its values.
  using Key = std::pair<Fingerprint, Fingerprint>;

  /// Nobody's, with what it is of, if its factorization did not fail.
  struct Spare
  {
    std::optional<Fingerprint>    values;
    std::unique_ptr<SparseFactor> factor;
  };

  struct Items
  {
    std::map<Fingerprint, std::deque<Spare>>         spare; ///< of each pattern
    std::map<Key, std::weak_ptr<const SparseFactor>> used;
  };

  FactorOf                    of;
  Factorization               package;
  FillOrderings              *orderings;
  Work                       *work;
  std::shared_ptr<const Team> team;
  std::shared_ptr<Items>      items = std::make_shared<Items>();
};
} // namespace snug::feti

#endif
