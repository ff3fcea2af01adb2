#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/feti/subdomain_ranks.h>

#include <algorithm>

namespace snug::feti {
SubdomainRanks::SubdomainRanks(const unsigned int first, MPI_Comm comm)
  : first_of_rank(all_gather(comm, first))
{}

unsigned int SubdomainRanks::operator()(const unsigned int subdomain) const
{
  // A rank without subdomains has the same first id as the next rank. The last rank with this id
  // therefore holds the subdomain.
  return narrow<unsigned int>(
    std::upper_bound(first_of_rank.begin(), first_of_rank.end(), subdomain) -
    first_of_rank.begin() - 1);
}
} // namespace snug::feti
