#include <snug/mesh/partition.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace snug;

/// n x n cells of size (a, 1), all on rank 0.
mesh::CellSet<2> square(const unsigned int n, const double a)
{
  mesh::CellSet<2> set;
  set.communicator = MPI_COMM_WORLD;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    for (unsigned int i = 0; i < n * n; ++i)
      {
        set.numbers.push_back(i);
        set.places.emplace_back(geometry::no_element, 1.);
        set.keys.push_back({{0, i}});
        if (i % n + 1 < n)
          {
            set.neighbours.push_back({{i, i + 1}});
            set.areas.push_back(1.);
          }
        if (i + n < n * n)
          {
            set.neighbours.push_back({{i, i + n}});
            set.areas.push_back(a);
          }
      }
  return set;
}

/// Return the length of the cuts of square() in n parts.
double cut_length(const unsigned int n, const double a)
{
  const auto set       = square(n, a);
  const auto partition = mesh::graph_partitions<2>({&set}, {double(n)}).front();
  EXPECT_EQ(partition.n_parts, n);
  double cut = 0.;
  for (unsigned int p = 0; p < set.areas.size(); ++p)
    if (partition.part[set.neighbours[p][0]] != partition.part[set.neighbours[p][1]])
      cut += set.areas[p];
  return dealii::Utilities::MPI::sum(cut, MPI_COMM_WORLD);
}

TEST(GraphPartition, CutsASquareNearlyAsShortAsRectanglesDo)
{
  // 32 x 32 cells in 32 parts: rectangles of 8 x 4 cells cut 3 * 32 + 7 * 32
  EXPECT_LE(cut_length(32, 1.), 1.2 * 320);
}

TEST(GraphPartition, PartsOfFlatCellsAreNotFlat)
{
  // 32 parts of area 320, squares with a perimeter of 71.6 each but for the outer 704; parts of as
  // many cells in both directions would cut 1640
  EXPECT_LE(cut_length(32, 10.), 1.3 * (32 * 71.6 - 704) / 2.);
}

/// The bodies are partitioned on different ranks where there are several.
TEST(GraphPartition, BodiesBesideOthersAreDividedAsAlone)
{
  const auto one = square(32, 1.), other = square(20, 3.);
  const auto together = mesh::graph_partitions<2>({&one, &other, &one}, {50., 20., 50.});
  const auto alone    = mesh::graph_partitions<2>({&other}, {20.});
  EXPECT_EQ(together[0].part, together[2].part);
  EXPECT_EQ(together[1].part, alone[0].part);
  EXPECT_EQ(together[1].n_parts, alone[0].n_parts);
}
