#include <snug/feti/factor_pool.h>

#include <algorithm>

namespace snug::feti {
FactorPool::FactorPool(const MatrixKind                   the_use,
                       const Factorization                the_package,
                       FillOrderings                     *the_orderings,
                       Work                              *the_work,
                       std::shared_ptr<const CoarseGroup> the_group)
  : of(the_use)
  , package(the_package)
  , orderings(the_orderings)
  , work(the_work)
  , group(std::move(the_group))
{}

/// The deleter of the returned pointer puts the factor back. It holds the items by a shared pointer
/// of its own, so that a face may outlive the pool.
std::shared_ptr<const SparseFactor>
FactorPool::factorize(const CsrMatrix &A, const std::string &what, const double singular_size) const
{
  const Key key(fingerprint(*A.pattern()), fingerprint(A.values));
  if (const auto found = items->used.find(key); found != items->used.end())
    if (auto equal = found->second.lock())
      return equal;
  auto      &spare    = items->spare[key.first];
  const auto of_equal = std::find_if(spare.begin(), spare.end(), [&key](const Spare &item) {
    return item.values == key.second;
  });
  const bool is_known = of_equal != spare.end();
  std::unique_ptr<SparseFactor> factor;
  if (spare.empty())
    {
      factor = std::make_unique<SparseFactor>(A, of, package, orderings, group);
      if (work != nullptr)
        ++work->symbolic_factorizations;
    }
  else
    {
      const auto chosen = is_known ? of_equal : spare.begin();
      factor            = std::move(chosen->factor);
      spare.erase(chosen);
    }
  // A factor that is not among the used factors when it is put back has failed.
  const auto put_back = [home = items, key](const SparseFactor *used) {
    const bool is_whole = home->used.erase(key) > 0;
    home->spare[key.first].push_back(
      {is_whole ? std::optional(key.second) : std::nullopt,
       std::unique_ptr<SparseFactor>(const_cast<SparseFactor *>(used))});
  };
  SparseFactor                             &fresh = *factor;
  const std::shared_ptr<const SparseFactor> result(factor.release(), put_back);
  if (!is_known)
    {
      fresh.factorize(A, what, singular_size);
      if (work != nullptr)
        ++work->numeric_factorizations;
    }
  items->used[key] = result;
  return result;
}
} // namespace snug::feti
