#ifndef snug_base_disjoint_sets_h
#define snug_base_disjoint_sets_h

#include <algorithm>
#include <numeric>
#include <vector>

namespace snug {
/// Disjoint sets of the numbers 0 to n - 1 that are joined step by step. The smallest number of a
/// set represents the set, in whatever order the sets are joined.
class DisjointSets
{
public:
  explicit DisjointSets(const unsigned int n) : parent(n)
  {
    std::iota(parent.begin(), parent.end(), 0u);
  }

  /// Return the number that represents the set of @p i.
  unsigned int find(unsigned int i) const
  {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  }

  void join(const unsigned int i, const unsigned int j)
  {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent[high]           = low;
  }

private:
  mutable std::vector<unsigned int> parent; ///< find() shortens the paths to representatives
};
} // namespace snug

#endif
