#include <snug/base/narrow.h>
#include <snug/feti/fill_orderings.h>
#include <snug/qp/row_set.h>

#include <metis.h>

#include <numeric>
#include <stdexcept>

namespace snug::feti {
namespace {
/// Two hashes of the numbers of rows and columns, from two beginnings.
std::array<std::uint64_t, 2> fingerprint(const CsrMatrix &pattern)
{
  std::array<std::uint64_t, 2> hashes = {{1, 2}};
  for (auto &hash : hashes)
    for (const auto *numbers : {&pattern.row_start, &pattern.columns})
      for (const PetscInt number : *numbers)
        hash = qp::scramble(hash + static_cast<std::uint64_t>(number));
  return hashes;
}

std::vector<PetscInt> nested_dissection(const CsrMatrix &pattern)
{
  std::vector<PetscInt> result(pattern.n_rows);
  std::iota(result.begin(), result.end(), 0);
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
  idx_t              n = narrow<idx_t>(pattern.n_rows);
  std::vector<idx_t> order(n), place(n);
  if (METIS_NodeND(&n, start.data(), neighbours.data(), nullptr, nullptr, order.data(),
                   place.data()) != METIS_OK)
    throw std::runtime_error("METIS could not order the unknowns of a subdomain");
  result.assign(order.begin(), order.end());
  return result;
}
} // namespace

const std::vector<PetscInt> &FillOrderings::of(const CsrMatrix &pattern)
{
  const auto [place, is_new] = known.try_emplace(fingerprint(pattern));
  if (is_new)
    place->second = nested_dissection(pattern);
  return place->second;
}
} // namespace snug::feti
