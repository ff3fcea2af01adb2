#ifndef snug_feti_team_h
#define snug_feti_team_h

#include <mpi.h>

#include <utility>
#include <vector>

namespace snug::feti {
/**
 * Ranks that factorize in common a matrix that all ranks have: each holds an equal range of its
 * rows. They are spread evenly over all ranks, as over the nodes of a cluster.
 */
class Team
{
public:
  /// Collective on @p all; at most as many members as it has ranks.
  Team(MPI_Comm all, unsigned int n_members);
  ~Team();
  Team(const Team &)            = delete;
  Team &operator=(const Team &) = delete;

  MPI_Comm all() const { return everyone; }
  bool     has_this_rank() const { return members != MPI_COMM_NULL; }
  /// Null on other ranks.
  MPI_Comm     communicator() const { return members; }
  unsigned int size() const { return n_members; }

  /// The first of the rows of this rank and the one after the last, of @p n; none for others.
  std::pair<unsigned int, unsigned int> range(unsigned int n) const;

  /// Of the members' ranges of x (n) all of it on all ranks. Collective on all().
  void share(std::vector<double> &x) const;

private:
  /// The end of the rows of the first @p i members.
  unsigned int end(unsigned int n, unsigned int i) const;
  /// Members among the ranks before @p rank.
  unsigned int members_before(unsigned int rank) const;

  MPI_Comm     everyone, members = MPI_COMM_NULL;
  unsigned int n_ranks, n_members, my_rank;
};
} // namespace snug::feti

#endif
