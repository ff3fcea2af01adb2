#include <snug/base/assertions.h>
#include <snug/feti/cluster_structure.h>
#include <snug/feti/subdomain_ranks.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>

namespace snug::feti {
ClusterStructure::ClusterStructure(const SubdomainTable &table, MPI_Comm communicator)
  : comm(communicator)
{
  const bool mine = std::any_of(table.joints.begin(), table.joints.end(),
                                [](const auto &joints) { return !joints.empty(); });
  has_joints      = dealii::Utilities::MPI::logical_or(mine, comm);
  if (!has_joints)
    return;
  subdomain_side.n_unknowns.assign(table.joints.size(), 0);
  const SubdomainRanks                              rank_of(table.first, comm);
  std::map<unsigned int, std::vector<unsigned int>> own; // by home
  // by home: subdomain, number of joints, and the other subdomain of each joint
  std::map<unsigned int, std::vector<unsigned int>> out;
  for (unsigned int s = 0; s < table.joints.size(); ++s)
    {
      if (table.joints[s].empty())
        continue;
      const auto n_joints          = narrow<unsigned int>(table.joints[s].size());
      subdomain_side.n_unknowns[s] = n_joints * table.n_modes;
      const unsigned int home = rank_of(table.first_of_cluster(table.cluster_of(table.first + s)));
      auto              &message = out[home];
      own[home].push_back(s);
      message.insert(message.end(), {table.first + s, n_joints});
      for (const auto &joint : table.joints[s])
        message.push_back(joint.other);
    }
  for (auto &[rank, numbers] : own)
    subdomain_side.neighbours.push_back({narrow<int>(rank), std::move(numbers)});
  // Messages are sorted by rank, so that the members are in the order of the subdomains.
  std::vector<std::vector<unsigned int>> others;
  for (const auto &[rank, message] : dealii::Utilities::MPI::some_to_some(comm, out))
    {
      member_side.neighbours.push_back({narrow<int>(rank), {}});
      for (std::size_t i = 0; i < message.size(); i += 2 + message[i + 1])
        {
          member_side.neighbours.back().numbers.push_back(narrow<unsigned int>(of_home.size()));
          of_home.push_back({message[i], {}});
          others.emplace_back(message.begin() + i + 2, message.begin() + i + 2 + message[i + 1]);
        }
    }
  number_unknowns(others, table);
  for (const Member &member : of_home)
    member_side.n_unknowns.push_back(narrow<unsigned int>(member.unknowns.size()));
}

/// Number the unknowns of each cluster joint by joint. The joints are ordered by their subdomains.
void ClusterStructure::number_unknowns(const std::vector<std::vector<unsigned int>> &others,
                                       const SubdomainTable                         &table)
{
  using Pair = std::pair<unsigned int, unsigned int>;
  std::map<unsigned int, Cluster> clusters;
  for (unsigned int i = 0; i < of_home.size(); ++i)
    clusters[table.cluster_of(of_home[i].subdomain)].members.push_back(i);
  for (auto &[number, cluster] : clusters)
    {
      std::map<Pair, unsigned int> first_unknowns; // of the joints
      const auto                   pair = [](unsigned int a, unsigned int b) {
        return Pair(std::min(a, b), std::max(a, b));
      };
      for (const unsigned int i : cluster.members)
        for (const unsigned int other : others[i])
          first_unknowns.emplace(pair(of_home[i].subdomain, other), 0);
      unsigned int n = 0;
      for (auto &[joint, first] : first_unknowns)
        {
          first = n;
          n += table.n_modes;
        }
      std::vector<std::vector<PetscInt>> rows(n);
      for (const unsigned int i : cluster.members)
        {
          auto &unknowns = of_home[i].unknowns;
          for (const unsigned int other : others[i])
            for (unsigned int mode = 0; mode < table.n_modes; ++mode)
              unknowns.push_back(first_unknowns.at(pair(of_home[i].subdomain, other)) + mode);
          for (const unsigned int a : unknowns)
            rows[a].insert(rows[a].end(), unknowns.begin(), unknowns.end());
        }
      for (auto &row : rows)
        {
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
        }
      cluster.pattern = CsrMatrix::from_rows(rows, narrow<unsigned int>(rows.size())).pattern();
      at_home.push_back(std::move(cluster));
    }
}

/// Send the numbers of @p from to the ranks of the neighbours and receive those of @p to, in one
/// message per rank. Both ranks order the subdomains of a message by their ids.
std::vector<ClusterStructure::Numbers>
ClusterStructure::exchange(const Side                                        &from,
                           const std::vector<Numbers>                        &sent,
                           const Side                                        &to,
                           const std::function<unsigned int(unsigned int k)> &size) const
{
  const int                tag = 5821; // differs from the tags of deal.II
  std::vector<Numbers>     out(from.neighbours.size()), in(to.neighbours.size());
  std::vector<MPI_Request> requests;
  for (std::size_t m = 0; m < in.size(); ++m)
    {
      unsigned int n = 0;
      for (const unsigned int i : to.neighbours[m].numbers)
        n += size(to.n_unknowns[i]);
      in[m].resize(n);
      MPI_Irecv(in[m].data(), narrow<int>(n), MPI_DOUBLE, to.neighbours[m].rank, tag, comm,
                &requests.emplace_back());
    }
  for (std::size_t m = 0; m < out.size(); ++m)
    {
      for (const unsigned int i : from.neighbours[m].numbers)
        {
          SNUG_ASSERT_EQUAL(sent[i].size(), size(from.n_unknowns[i]));
          out[m].insert(out[m].end(), sent[i].begin(), sent[i].end());
        }
      MPI_Isend(out[m].data(), narrow<int>(out[m].size()), MPI_DOUBLE, from.neighbours[m].rank, tag,
                comm, &requests.emplace_back());
    }
  MPI_Waitall(narrow<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  std::vector<Numbers> received(to.n_unknowns.size());
  for (std::size_t m = 0; m < in.size(); ++m)
    {
      auto begin = in[m].begin();
      for (const unsigned int i : to.neighbours[m].numbers)
        {
          const auto end = begin + size(to.n_unknowns[i]);
          received[i].assign(begin, end);
          begin = end;
        }
    }
  return received;
}

std::vector<ClusterStructure::Numbers>
ClusterStructure::to_homes(const std::vector<Numbers>                        &of_subdomains,
                           const std::function<unsigned int(unsigned int k)> &size) const
{
  return exchange(subdomain_side, of_subdomains, member_side, size);
}

std::vector<ClusterStructure::Numbers>
ClusterStructure::to_subdomains(const std::vector<Numbers>                        &of_members,
                                const std::function<unsigned int(unsigned int k)> &size) const
{
  return exchange(member_side, of_members, subdomain_side, size);
}
} // namespace snug::feti
