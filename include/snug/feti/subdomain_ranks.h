#ifndef snug_feti_subdomain_ranks_h
#define snug_feti_subdomain_ranks_h

#include <mpi.h>

#include <vector>

namespace snug::feti {
/// This class finds the rank of a subdomain from the first subdomains of all ranks.
class SubdomainRanks
{
public:
  /// Gather @p first, the global id of the first subdomain of this rank. Collective.
  SubdomainRanks(unsigned int first, MPI_Comm comm);

  /// Return the rank that holds @p subdomain (global id).
  unsigned int operator()(unsigned int subdomain) const;

private:
  std::vector<unsigned int> first_of_rank;
};
} // namespace snug::feti

#endif
