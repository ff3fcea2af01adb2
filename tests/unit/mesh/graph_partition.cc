#include <snug/mesh/partition.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace snug;

TEST(GraphPartition, CutsASquareNearlyAsShortAsRectanglesDo)
{
  // 32 x 32 cells in 32 parts: rectangles of 8 x 4 cells cut 3 * 32 + 7 * 32 = 320 faces
  const unsigned int n = 32;
  mesh::CellSet<2>   set;
  set.communicator = MPI_COMM_WORLD;
  std::vector<std::array<unsigned int, 2>> faces;
  for (unsigned int i = 0; i < n * n; ++i)
    {
      if (i % n + 1 < n)
        faces.push_back({{i, i + 1}});
      if (i + n < n * n)
        faces.push_back({{i, i + n}});
    }
  // all cells are on rank 0
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      for (unsigned int i = 0; i < n * n; ++i)
        {
          set.numbers.push_back(i);
          set.keys.push_back({{0, i}});
        }
      set.neighbours = faces;
    }
  const auto partition = mesh::graph_partition(set, n);
  EXPECT_EQ(partition.n_parts, 32u);
  if (partition.part.empty())
    return;
  unsigned int cut = 0;
  for (const auto &face : faces)
    cut += partition.part[face[0]] != partition.part[face[1]];
  EXPECT_LE(cut, 1.2 * 320);
}
