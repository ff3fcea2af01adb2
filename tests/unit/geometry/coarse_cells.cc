#include <snug/geometry/coarse_cells.h>

#include <gtest/gtest.h>

using namespace snug;

/// Ids in all bodies and in one body are inverse to each other, with the path of the children.
TEST(CoarseCells, IdsOfOneBodyDoNotDependOnTheOthers)
{
  const geometry::CoarseCells<3> cells({0, 4, 4, 9}); // three bodies, the second without cells
  const dealii::CellId           id(6, {7, 2});
  EXPECT_EQ(cells.body(id), 2u);
  EXPECT_EQ(cells.in_body(id), dealii::CellId(2, {7, 2}));
  EXPECT_EQ(cells.in_all(2, cells.in_body(id)), id);
  EXPECT_EQ(cells.body(dealii::CellId(3, {})), 0u);
  EXPECT_EQ(cells.body(dealii::CellId(4, {})), 2u);
  EXPECT_EQ(cells.coarse_cell(dealii::CellId(8, {})), 4u);
}
