#include <snug/mesh/tearing.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace snug;

namespace {
/// Boxes of n x n (x n) unit cells with one subdomain per cell; the second box is twice as long.
template <int dim>
mesh::BodyMesh<dim> boxes(MPI_Comm           communicator,
                          const unsigned int n,
                          const unsigned int subdomains,
                          const std::string &method)
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  for (auto &body : bodies)
    {
      body.cells.assign(dim, n);
      body.size.assign(dim, n);
    }
  bodies[1].corner.assign(dim, 2. * n);
  bodies[1].cells[0] = 2 * n;
  bodies[1].size[0]  = 2. * n;
  return mesh::BodyMesh<dim>(communicator, bodies, 1, mesh::Idealization::natural(dim),
                             {subdomains, method, 0, false});
}

/// The cell centres of each cluster of all ranks, times two.
template <int dim>
std::set<std::set<std::array<long, dim>>> clusters_by_place(const mesh::BodyMesh<dim> &mesh,
                                                            const mesh::Tearing       &tearing)
{
  std::vector<std::vector<long>> mine(1);
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    for (const unsigned int cell : tearing.subdomains[s].cells)
      {
        const auto &nodes = mesh.cells()[cell].nodes;
        mine[0].push_back(tearing.clusters.of_subdomain[tearing.first_id + s]);
        for (unsigned int d = 0; d < dim; ++d)
          mine[0].push_back(std::lround(mesh.reference_positions()[nodes.front()][d] +
                                        mesh.reference_positions()[nodes.back()][d]));
      }
  std::map<long, std::set<std::array<long, dim>>> places;
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(mesh.communicator(), mine[0]))
    for (std::size_t i = 0; i < of_rank.size(); i += 1 + dim)
      {
        std::array<long, dim> place;
        std::copy_n(of_rank.begin() + i + 1, dim, place.begin());
        places[of_rank[i]].insert(place);
      }
  std::set<std::set<std::array<long, dim>>> result;
  for (const auto &cluster : places)
    result.insert(cluster.second);
  return result;
}

template <int dim>
void expect_cubes(const unsigned int n, const unsigned int edge, const unsigned int in_cluster)
{
  const auto all     = static_cast<unsigned int>(std::lround(3 * std::pow(n, dim)));
  const auto mesh    = boxes<dim>(MPI_COMM_WORLD, n, all, "grid");
  const auto tearing = mesh::tear(mesh, edge);
  ASSERT_EQ(tearing.n_global, all);
  const auto clusters = clusters_by_place(mesh, tearing);
  EXPECT_EQ(clusters.size(), all / in_cluster);
  for (const auto &cluster : clusters)
    {
      EXPECT_EQ(cluster.size(), in_cluster);
      // centres are two apart
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto ends =
            std::minmax_element(cluster.begin(), cluster.end(),
                                [d](const auto &a, const auto &b) { return a[d] < b[d]; });
          EXPECT_EQ((*ends.second)[d] - (*ends.first)[d], 2 * (edge - 1));
        }
    }
}

TEST(Clusters, OfAGridAreCubes)
{
  expect_cubes<2>(6, 2, 4);
  expect_cubes<2>(6, 3, 9);
  expect_cubes<3>(4, 2, 8);
  expect_cubes<3>(6, 3, 27);
}

TEST(Clusters, DoNotDependOnRanks)
{
  for (const std::string method : {"grid", "METIS"})
    {
      const auto here = boxes<3>(MPI_COMM_SELF, 8, 192, method);
      const auto all  = boxes<3>(MPI_COMM_WORLD, 8, 192, method);
      const auto torn = mesh::tear(here, 2);
      EXPECT_EQ(clusters_by_place(here, torn), clusters_by_place(all, mesh::tear(all, 2)));
      const auto &of = torn.clusters.of_subdomain;
      const auto  n  = *std::max_element(of.begin(), of.end()) + 1;
      EXPECT_GE(n, 10u);
      EXPECT_LT(n, 40u);
    }
}

/// Joints name the same nodes on both sides, and join the subdomains of a cluster in one piece.
TEST(Clusters, AreJoined)
{
  for (const std::string method : {"grid", "METIS"})
    {
      const auto  mesh     = boxes<3>(MPI_COMM_SELF, 6, 120, method);
      const auto  tearing  = mesh::tear(mesh, 3);
      const auto &clusters = tearing.clusters;
      const auto  nodes_of = [&](const unsigned int s, const unsigned int other) {
        std::vector<unsigned int> nodes;
        for (const auto &joint : clusters.joints[s])
          if (joint.other == other)
            for (const unsigned int i : joint.nodes)
              nodes.push_back(tearing.subdomains[s].nodes[i]);
        return nodes;
      };
      std::vector<unsigned int> reached(tearing.n_global);
      for (unsigned int s = 0; s < tearing.n_global; ++s)
        reached[s] = s;
      for (unsigned int sweep = 0; sweep < tearing.n_global; ++sweep)
        for (unsigned int s = 0; s < tearing.n_global; ++s)
          for (const auto &joint : clusters.joints[s])
            {
              EXPECT_EQ(clusters.of_subdomain[s], clusters.of_subdomain[joint.other]);
              if (sweep == 0)
                EXPECT_EQ(nodes_of(s, joint.other), nodes_of(joint.other, s));
              reached[s] = std::min(reached[s], reached[joint.other]);
            }
      for (unsigned int s = 0; s < tearing.n_global; ++s)
        for (unsigned int t = 0; t < s; ++t)
          EXPECT_EQ(clusters.of_subdomain[s] == clusters.of_subdomain[t], reached[s] == reached[t]);
    }
}

TEST(Clusters, BoundTheirNumber)
{
  // 3 x 12^3 subdomains are more than single clusters may be; 2 per edge leave at most 1,000
  const auto mesh    = boxes<3>(MPI_COMM_WORLD, 12, 3 * 12 * 12 * 12, "grid");
  const auto tearing = mesh::tear(mesh);
  ASSERT_GT(tearing.n_global, mesh::most_single_clusters);
  const auto &of = tearing.clusters.of_subdomain;
  EXPECT_EQ(*std::max_element(of.begin(), of.end()) + 1, 3u * 6 * 6 * 6);
  EXPECT_FALSE(tearing.clusters.is_chosen);
  EXPECT_TRUE(mesh::tear(mesh, 1).clusters.of_subdomain.empty());
}
} // namespace
