#include <snug/mesh/body_mesh.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/parts.h>
#include <snug/mesh/tearing.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

using namespace snug;

namespace {
unsigned int n_ranks()
{
  return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
}

/// Two boxes; a corner of the first is refined.
template <int dim>
std::vector<geometry::BodyMeshParameters> boxes(unsigned int n)
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  for (auto &body : bodies)
    body.cells.assign(dim, n);
  bodies[0].refine_where      = "0.45 - x - y";
  bodies[0].local_refinements = 2;
  bodies[1].corner.assign(dim, 2.);
  return bodies;
}

template <int dim>
mesh::BodyMesh<dim> make(MPI_Comm           communicator,
                         const std::string &method,
                         unsigned int       degree     = 1,
                         unsigned int       subdomains = 10)
{
  return mesh::BodyMesh<dim>(communicator, boxes<dim>(dim == 2 ? 8 : 4), degree,
                             mesh::Idealization::natural(dim), {subdomains, method});
}

template <int dim>
using CellPlace = std::pair<unsigned int, std::array<long, dim>>;

/// Body and centre of a cell, on a grid finer than the cells.
template <int dim>
CellPlace<dim> place(const mesh::BodyMesh<dim> &mesh, unsigned int cell)
{
  const auto &nodes = mesh.cells()[cell].nodes;
  const auto  centre =
    (mesh.logical_positions()[nodes.front()] + mesh.logical_positions()[nodes.back()]) / 2.;
  CellPlace<dim> result;
  result.first = mesh.cells()[cell].body;
  for (unsigned int c = 0; c < dim; ++c)
    result.second[c] = std::lround(centre[c] * 4096);
  return result;
}

/// Parts on all ranks against those of the whole mesh on one.
template <int dim>
void expect_parts_of_one_rank(const std::string &method)
{
  const auto                             whole = make<dim>(MPI_COMM_SELF, method);
  const auto                             mesh  = make<dim>(MPI_COMM_WORLD, method);
  std::map<CellPlace<dim>, unsigned int> part;
  for (unsigned int cell = 0; cell < whole.cells().size(); ++cell)
    part[place(whole, cell)] = whole.cells()[cell].part;
  for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
    EXPECT_EQ(mesh.cells()[cell].part, part.at(place(mesh, cell)));
  EXPECT_EQ(dealii::Utilities::MPI::sum(mesh.cells().size(), MPI_COMM_WORLD), whole.cells().size());
  EXPECT_EQ(mesh.n_global_cells(), whole.n_global_cells());
  EXPECT_EQ(mesh.n_global_free_nodes(), whole.n_global_free_nodes());
  EXPECT_EQ(mesh::tear(mesh).n_global, mesh::tear(whole).n_global);
}

template <int dim>
void expect_balance(const std::string &method)
{
  const auto                 mesh = make<dim>(MPI_COMM_WORLD, method);
  std::vector<unsigned long> cells_of_part(30, 0);
  for (const auto &cell : mesh.cells())
    ++cells_of_part.at(cell.part);
  dealii::Utilities::MPI::sum(cells_of_part, MPI_COMM_WORLD, cells_of_part);
  const double largest = *std::max_element(cells_of_part.begin(), cells_of_part.end());
  EXPECT_NEAR(double(mesh.cells().size()), double(mesh.n_global_cells()) / n_ranks(),
              1.01 * largest);
}

/// Every node of an owned cell is free, or hangs on free nodes of this rank
/// and reproduces linear functions.
template <int dim>
void expect_complete_constraints(unsigned int degree)
{
  const auto  mesh = make<dim>(MPI_COMM_WORLD, "METIS", degree);
  const auto &x    = mesh.logical_positions();
  unsigned    n    = 0;
  for (const auto &hanging : mesh.hanging())
    {
      dealii::Tensor<1, dim> sum;
      double                 weights = 0.;
      for (const auto &master : hanging.masters)
        {
          EXPECT_FALSE(mesh.is_hanging(master.first));
          sum += master.second * x[master.first];
          weights += master.second;
        }
      EXPECT_NEAR(weights, 1., 1e-14);
      EXPECT_NEAR((sum - x[hanging.node]).norm(), 0., 1e-14);
      ++n;
    }
  EXPECT_GT(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 0u);
}

void expect_runs_in_balance(const std::vector<std::vector<unsigned long>> &cells,
                            unsigned int                                   ranks)
{
  const auto          owners  = mesh::ranks_of_parts(cells, ranks);
  unsigned long       largest = 0, all = 0;
  std::vector<double> load(ranks, 0.);
  for (unsigned int b = 0; b < cells.size(); ++b)
    {
      EXPECT_TRUE(std::is_sorted(owners[b].begin(), owners[b].end()));
      for (unsigned int p = 0; p < cells[b].size(); ++p)
        {
          largest = std::max(largest, cells[b][p]);
          all += cells[b][p];
          load.at(owners[b][p]) += cells[b][p];
        }
    }
  for (const double has : load)
    EXPECT_NEAR(has, double(all) / ranks, 1.01 * largest);
}
} // namespace

TEST(Distribute, PartsDoNotDependOnTheNumberOfRanks)
{
  for (const std::string method : {"grid", "METIS"})
    {
      expect_parts_of_one_rank<2>(method);
      expect_parts_of_one_rank<3>(method);
    }
}

TEST(Distribute, RanksAreInBalanceWithinOnePart)
{
  for (const std::string method : {"grid", "METIS"})
    {
      expect_balance<2>(method);
      expect_balance<3>(method);
    }
}

TEST(Distribute, ConstraintsAreCompleteOnEveryRank)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_complete_constraints<2>(degree);
      expect_complete_constraints<3>(degree);
    }
}

TEST(Distribute, BodiesGoToTheRanksInRunsThatBalance)
{
  std::mt19937                                 random(3);
  std::uniform_int_distribution<unsigned long> size(80, 120), n_parts(1, 40);
  for (unsigned int ranks = 1; ranks < 12; ++ranks)
    for (unsigned int n_bodies = 1; n_bodies < 6; ++n_bodies)
      {
        std::vector<std::vector<unsigned long>> cells(n_bodies);
        for (auto &body : cells)
          {
            body.resize(n_parts(random));
            for (auto &part : body)
              part = size(random);
          }
        cells.back().resize(60, 100);
        expect_runs_in_balance(cells, ranks);
      }
}

TEST(Distribute, ThereAreAsManyPartsAsRanks)
{
  const auto mesh = make<3>(MPI_COMM_WORLD, "grid", 1, 1);
  EXPECT_GE(mesh::tear(mesh).n_global, n_ranks());
}

TEST(Distribute, SubdomainsBySizeAreLargerWhereBodiesAreNearlyIncompressible)
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  for (auto &body : bodies)
    body.cells = {10, 10, 10};
  bodies[1].corner = {2., 2., 2.};
  mesh::TearingParameters tearing;
  tearing.at_least_ranks        = false;
  tearing.nearly_incompressible = {false, true};
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, bodies, 1, mesh::Idealization::natural(3), tearing);
  EXPECT_EQ(mesh::tear(mesh).n_global, 8U + 1U);
}

TEST(Distribute, RanksMayBeWithoutCells)
{
  const std::vector<geometry::BodyMeshParameters> cube(1);
  const mesh::BodyMesh<3>                         mesh(MPI_COMM_WORLD, cube, 2);
  EXPECT_EQ(mesh.n_global_cells(), 1u);
  EXPECT_EQ(mesh.n_global_free_nodes(), 27u);
  const auto tearing = mesh::tear(mesh);
  EXPECT_EQ(tearing.n_global, 1u);
  EXPECT_EQ(tearing.first_id_of_rank.size(), n_ranks() + 1);
}
