#include <snug/feti/factor_pool.h>

#include <algorithm>

namespace snug::feti {
std::shared_ptr<FactorPool::Item> FactorPool::take(const CsrMatrix &matrix) const
{
  std::unique_ptr<Item> item;
  if (spare->empty())
    item = std::make_unique<Item>(matrix);
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
