#ifndef snug_feti_coarse_group_h
#define snug_feti_coarse_group_h

#include <mpi.h>

#include <utility>
#include <vector>

namespace snug::feti {
/**
 * This class is a group of ranks that factorize a replicated matrix in common. Each member holds an
 * equal range of the rows. The members are spread evenly over all ranks and so over cluster nodes.
 */
class CoarseGroup
{
public:
  /// Create a group of @p n_members ranks of @p all, or of all ranks if there are fewer. Collective
  /// on @p all.
  CoarseGroup(MPI_Comm all, unsigned int n_members);
  ~CoarseGroup();
  CoarseGroup(const CoarseGroup &)            = delete;
  CoarseGroup &operator=(const CoarseGroup &) = delete;

  MPI_Comm all() const { return everyone; }
  bool     has_this_rank() const { return members != MPI_COMM_NULL; }
  /// Return the communicator of the members. It is MPI_COMM_NULL on other ranks.
  MPI_Comm     communicator() const { return members; }
  unsigned int size() const { return n_members; }

  /// Return the first row of this rank, of @p n rows, and the row after its last row. The range is
  /// empty on ranks that are not members.
  std::pair<unsigned int, unsigned int> range(unsigned int n) const;

  /// Gather the members' ranges of x (n) to all of x on all ranks. Collective on all().
  void allgather(std::vector<double> &x) const;

private:
  /// Return the end of the rows of the first @p i members.
  unsigned int end(unsigned int n, unsigned int i) const;
  /// Return the number of members among the ranks before @p rank.
  unsigned int members_before(unsigned int rank) const;

  MPI_Comm     everyone, members = MPI_COMM_NULL;
  unsigned int n_ranks, n_members, my_rank;
};
} // namespace snug::feti

#endif
