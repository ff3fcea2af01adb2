#include <snug/base/narrow.h>
#include <snug/feti/coarse_group.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>

namespace snug::feti {
CoarseGroup::CoarseGroup(MPI_Comm all, const unsigned int the_members)
  : everyone(all)
  , n_ranks(dealii::Utilities::MPI::n_mpi_processes(all))
  , n_members(std::min(the_members, n_ranks))
  , my_rank(dealii::Utilities::MPI::this_mpi_process(all))
{
  const bool is_member = members_before(my_rank + 1) > members_before(my_rank);
  MPI_Comm_split(all, is_member ? 0 : MPI_UNDEFINED, narrow<int>(my_rank), &members);
}

CoarseGroup::~CoarseGroup()
{
  if (members != MPI_COMM_NULL)
    MPI_Comm_free(&members);
}

/// Member i is rank floor(i n_ranks / n_members).
unsigned int CoarseGroup::members_before(const unsigned int rank) const
{
  return narrow<unsigned int>((std::uint64_t(rank) * n_members + n_ranks - 1) / n_ranks);
}

unsigned int CoarseGroup::end(const unsigned int n, const unsigned int i) const
{
  return narrow<unsigned int>(std::uint64_t(n) * i / n_members);
}

std::pair<unsigned int, unsigned int> CoarseGroup::range(const unsigned int n) const
{
  return {end(n, members_before(my_rank)), end(n, members_before(my_rank + 1))};
}

void CoarseGroup::allgather(std::vector<double> &x) const
{
  std::vector<int>   counts, first;
  const unsigned int n = narrow<unsigned int>(x.size());
  for (unsigned int rank = 0; rank < n_ranks; ++rank)
    {
      first.push_back(narrow<int>(end(n, members_before(rank))));
      counts.push_back(narrow<int>(end(n, members_before(rank + 1))) - first.back());
    }
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, x.data(), counts.data(), first.data(),
                 MPI_DOUBLE, everyone);
}
} // namespace snug::feti
