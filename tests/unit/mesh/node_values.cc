#include <snug/mesh/node_reach.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

using namespace snug;

namespace {
/// Return a box that is refined for x > 0.5, so that nodes hang.
template <int dim>
std::vector<geometry::BodyMeshParameters> hanging_box()
{
  std::vector<geometry::BodyMeshParameters> bodies(1);
  bodies[0].size              = std::vector<double>(dim, 1.);
  bodies[0].cells             = std::vector<unsigned int>(dim, 4);
  bodies[0].refine_where      = "x-0.5";
  bodies[0].local_refinements = 1;
  return bodies;
}

/// Return a linear field at the nodes of a mesh.
template <int dim>
mesh::Field<dim> linear_field(const mesh::BodyMesh<dim> &mesh)
{
  mesh::Field<dim> result(mesh.n_local_nodes());
  for (unsigned int node = 0; node < result.size(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        result[node][c] += (1. + c + 0.3 * d * d) * mesh.reference_positions()[node][d];
  return result;
}

template <int dim>
void expect_volumes()
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, hanging_box<dim>(), 1);
  // Each cell adds its volume to each of its nodes. The expected sum at a node is found by position
  // from the cells of all ranks.
  using Key      = std::array<long, dim>;
  const auto key = [](const double *position) {
    Key result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = std::lround(1e6 * position[d]);
    return result;
  };
  const auto         &X = mesh.reference_positions();
  std::vector<double> values(2 * mesh.n_local_nodes()), shares;
  for (const auto &cell : mesh.cells())
    {
      const double volume = std::pow(X[cell.nodes[1]][0] - X[cell.nodes[0]][0], dim);
      for (const unsigned int node : cell.nodes)
        {
          values[2 * node] += volume;
          values[2 * node + 1] += 1.;
          shares.insert(shares.end(), X[node].begin_raw(), X[node].end_raw());
          shares.push_back(volume);
        }
    }
  std::map<Key, std::pair<double, double>> expected;
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, shares))
    for (unsigned int i = 0; i < of_rank.size(); i += dim + 1)
      {
        auto &sums = expected[key(&of_rank[i])];
        sums.first += of_rank[i + dim];
        sums.second += 1.;
      }
  mesh::sum_at_shared_nodes(mesh, 2, values);
  for (const auto &cell : mesh.cells())
    for (const unsigned int node : cell.nodes)
      {
        const auto &sums = expected.at(key(X[node].begin_raw()));
        EXPECT_NEAR(values[2 * node], sums.first, 1e-14);
        EXPECT_EQ(values[2 * node + 1], sums.second);
      }
}

template <int dim>
void expect_reach(const unsigned int degree)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, hanging_box<dim>(), degree);
  const auto                field = linear_field(mesh);
  std::mt19937              random(3);
  const auto number = [&]() { return std::uniform_real_distribution<double>(-1., 1.)(random); };
  std::vector<double> u;
  for (const auto &value : field)
    for (unsigned int c = 0; c < dim; ++c)
      u.push_back(value[c]);
  for (const auto &cell : mesh.cells())
    {
      const mesh::NodeReach<dim> reach(mesh, cell.nodes);
      // Linear fields satisfy the constraints of hanging nodes.
      const auto values = reach.values(u.data());
      for (unsigned int i = 0; i < cell.nodes.size(); ++i)
        EXPECT_NEAR((values[i] - field[cell.nodes[i]]).norm(), 0., 1e-13);
      // add() is the transpose of values(), and condense() applies both to a matrix.
      auto       r = values;
      const auto n = dim * r.size();
      for (auto &own : r)
        for (unsigned int c = 0; c < dim; ++c)
          own[c] = number();
      std::vector<double> v(u.size()), Ttr(u.size()), K(n * n);
      for (auto &own : v)
        own = number();
      for (auto &own : K)
        own = number();
      reach.add(1., r, Ttr.data());
      const auto Tv     = reach.values(v.data());
      double     inside = 0., outside = 0.;
      for (unsigned int i = 0; i < r.size(); ++i)
        inside += r[i] * Tv[i];
      for (unsigned int i = 0; i < v.size(); ++i)
        outside += v[i] * Ttr[i];
      EXPECT_NEAR(inside, outside, 1e-12);
      double full = 0., condensed = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          full += Tv[i / dim][i % dim] * K[n * i + j] * Tv[j / dim][j % dim];
      reach.condense(K);
      const auto &slots = reach.slots();
      const auto  m     = dim * slots.size();
      ASSERT_EQ(K.size(), m * m);
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int j = 0; j < m; ++j)
          condensed +=
            v[dim * slots[i / dim] + i % dim] * K[m * i + j] * v[dim * slots[j / dim] + j % dim];
      EXPECT_NEAR(full, condensed, 1e-11);
    }
}
} // namespace

TEST(SharedNodes, HaveTheSumsOverAllRanks)
{
  expect_volumes<2>();
  expect_volumes<3>();
}

TEST(SharedNodes, HaveTheValuesOfTheirOwners)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, hanging_box<3>(), 2);
  const auto              field = linear_field(mesh);
  const auto              again = mesh::owners_values(mesh, field);
  ASSERT_EQ(again.size(), field.size());
  for (unsigned int node = 0; node < field.size(); ++node)
    EXPECT_NEAR((again[node] - field[node]).norm(), 0., 1e-14);
}

TEST(NodeReach, InterpolatesHangingNodesAndItsTransposeAgrees)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_reach<2>(degree);
      expect_reach<3>(degree);
    }
}
