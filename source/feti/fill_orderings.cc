#include <snug/base/narrow.h>
#include <snug/feti/fill_orderings.h>

#include <metis.h>

#include <numeric>
#include <stdexcept>

namespace snug::feti {
namespace {
/// Two hashes of the numbers of rows and columns, each a product and a shift per number (Steele,
/// Lea, Flood, OOPSLA 2014).
std::array<std::uint64_t, 2> fingerprint(const CsrMatrix &pattern)
{
  std::array<std::uint64_t, 2> sums = {{0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu}};
  const auto                   add  = [&](const std::vector<PetscInt> &numbers) {
    for (const PetscInt number : numbers)
      {
        const auto x = static_cast<std::uint64_t>(number);
        sums[0]      = (sums[0] ^ x) * 0xbf58476d1ce4e5b9u;
        sums[0] ^= sums[0] >> 29;
        sums[1] = (sums[1] ^ x) * 0x94d049bb133111ebu;
        sums[1] ^= sums[1] >> 31;
      }
  };
  add(pattern.row_start);
  add(pattern.columns);
  return sums;
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
