#include <snug/feti/factor_pool.h>

#include <algorithm>

namespace snug::feti {
/// The deleter of the pointer puts the item back. It holds the list of spare items by a shared
/// pointer of its own, so that a face may outlive the pool.
std::shared_ptr<FactorPool::Item> FactorPool::take(const CsrMatrix &matrix) const
{
  std::unique_ptr<Item> item;
  if (spare->empty())
    item = std::make_unique<Item>(matrix, of);
  else
    {
      item = std::move(spare->back());
      spare->pop_back();
      // keeps the array that the factorization refers to
      std::copy(matrix.values.begin(), matrix.values.end(), item->matrix.values.begin());
    }
  return std::shared_ptr<Item>(item.release(),
                               [home = spare](Item *used) { home->emplace_back(used); });
}
} // namespace snug::feti
