#include <snug/base/blocked_signals.h>
#include <snug/base/narrow.h>
#include <snug/feti/fill_orderings.h>

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace snug::feti {
namespace {
/// Return whether the rows form groups, with every row coupled to all rows of its group and to no
/// other row. Then no order causes fill-in.
bool is_of_full_blocks(const CsrPattern &pattern)
{
  const auto columns = pattern.columns.begin();
  for (unsigned int i = 0; i < pattern.n_rows; ++i)
    {
      const auto first = pattern.columns[pattern.row_start[i]];
      if (!std::equal(columns + pattern.row_start[i], columns + pattern.row_start[i + 1],
                      columns + pattern.row_start[first], columns + pattern.row_start[first + 1]))
        return false;
    }
  return true;
}

std::vector<PetscInt> nested_dissection(const CsrPattern &pattern)
{
  std::vector<PetscInt> result(pattern.n_rows);
  std::iota(result.begin(), result.end(), 0);
  if (is_of_full_blocks(pattern))
    return result;
  std::vector<idx_t> start(1, 0), neighbours;
  for (unsigned int i = 0; i < pattern.n_rows; ++i)
    {
      for (PetscInt p = pattern.row_start[i]; p < pattern.row_start[i + 1]; ++p)
        if (pattern.columns[p] != PetscInt(i))
          neighbours.push_back(pattern.columns[p]);
      start.push_back(narrow<idx_t>(neighbours.size()));
    }
  if (neighbours.empty())
    return result;
  idx_t                n = narrow<idx_t>(pattern.n_rows);
  std::vector<idx_t>   order(n), place(n);
  const BlockedSignals during_call;
  if (METIS_NodeND(&n, start.data(), neighbours.data(), nullptr, nullptr, order.data(),
                   place.data()) != METIS_OK)
    throw std::runtime_error("METIS could not order the unknowns of a subdomain");
  result.assign(order.begin(), order.end());
  return result;
}
} // namespace

const std::vector<PetscInt> &FillOrderings::of(const CsrPattern &pattern)
{
  const auto [place, is_new] = known.try_emplace(fingerprint(pattern));
  if (is_new)
    place->second = nested_dissection(pattern);
  return place->second;
}
} // namespace snug::feti
