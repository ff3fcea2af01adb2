#include <snug/feti/factor_pool.h>

namespace snug::feti {
FactorPool::FactorPool(const FactorOf      the_use,
                       const Factorization the_package,
                       FillOrderings      *the_orderings,
                       Work               *the_work)
  : of(the_use), package(the_package), orderings(the_orderings), work(the_work)
{}

/// The deleter of the pointer puts the factor back. It holds the items by a shared pointer of its
/// own, so that a face may outlive the pool.
std::shared_ptr<const SparseFactor> FactorPool::factorize(const CsrMatrix   &A,
                                                          const std::string &what) const
{
  const Key key(fingerprint(*A.pattern()), fingerprint(A.values));
  if (const auto found = items->used.find(key); found != items->used.end())
    if (auto equal = found->second.lock())
      return equal;
  auto                         &spare = items->spare[key.first];
  std::unique_ptr<SparseFactor> factor;
  if (spare.empty())
    {
      factor = std::make_unique<SparseFactor>(A, of, package, orderings);
      if (work != nullptr)
        ++work->symbolic_factorizations;
    }
  else
    {
      factor = std::move(spare.back());
      spare.pop_back();
    }
  const auto put_back = [home = items, key](const SparseFactor *used) {
    home->used.erase(key);
    home->spare[key.first].emplace_back(const_cast<SparseFactor *>(used));
  };
  SparseFactor                             &fresh = *factor;
  const std::shared_ptr<const SparseFactor> result(factor.release(), put_back);
  fresh.factorize(A, what);
  if (work != nullptr)
    ++work->numeric_factorizations;
  items->used[key] = result;
  return result;
}
} // namespace snug::feti
