#include "two_boxes.h"

#include <snug/contact/matching.h>
#include <snug/mesh/refined_cells.h>

#include <gtest/gtest.h>

using namespace snug;
using namespace snug::contact;

namespace {
using Cells = std::set<dealii::CellId>;

/// Refine until no face is coarse, which adds to @p cells. Return the number of refinements.
template <int dim>
unsigned int match(const typename TwoBoxes<dim>::Bodies &bodies, Cells &cells)
{
  for (unsigned int step = 0; step < 10; ++step)
    {
      const TwoBoxes<dim>         scene(bodies, 1, MPI_COMM_WORLD, cells);
      const faces::FaceShape<dim> shape(1);
      const auto                  before = cells.size();
      std::vector<dealii::CellId> marked;
      for (const unsigned int cell : scene.surface.cells_of(
             coarse_faces(scene.surface, shape, TwoBoxes<dim>::pair(), scene.positions)))
        marked.push_back(scene.mesh.cell_id(cell));
      for (const auto &cell : mesh::gather_cells(marked, MPI_COMM_WORLD))
        mesh::refine(cell, cells);
      if (cells.size() == before)
        return step;
    }
  return 10;
}

/// The largest ratio of the sizes of faces of both sides at their centres, compared with all.
template <int dim>
double largest_ratio(const typename TwoBoxes<dim>::Bodies &bodies, const Cells &cells)
{
  const TwoBoxes<dim> scene(bodies, 1, MPI_COMM_WORLD, cells);
  const auto          centre = [&](unsigned int face) {
    dealii::Tensor<1, dim> x;
    for (const unsigned int node : scene.surface.faces()[face].nodes)
      x += scene.positions[node] / double(scene.surface.faces()[face].nodes.size());
    return x;
  };
  double largest = 0.;
  for (unsigned int f = 0; f < scene.surface.faces().size(); ++f)
    {
      double       nearest  = 1e10;
      unsigned int opposite = 0;
      for (unsigned int g = 0; g < scene.surface.faces().size(); ++g)
        if (scene.surface.faces()[g].body != scene.surface.faces()[f].body)
          {
            // by boxes: the point of the other face nearest to the centre
            auto lower = scene.positions[scene.surface.faces()[g].nodes.front()], upper = lower;
            for (const unsigned int node : scene.surface.faces()[g].nodes)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  lower[d] = std::min(lower[d], scene.positions[node][d]);
                  upper[d] = std::max(upper[d], scene.positions[node][d]);
                }
            double distance = 0.;
            for (unsigned int d = 0; d + 1 < dim; ++d)
              distance +=
                std::pow(std::max({lower[d] - centre(f)[d], centre(f)[d] - upper[d], 0.}), 2);
            if (distance < nearest)
              {
                nearest  = distance;
                opposite = g;
              }
          }
      if (nearest == 0.)
        largest = std::max(largest, mean_face_size(scene.surface, {f}, scene.positions) /
                                      mean_face_size(scene.surface, {opposite}, scene.positions));
    }
  return largest;
}

template <int dim>
void check(const typename TwoBoxes<dim>::Bodies &bodies, unsigned int least_steps)
{
  Cells cells;
  EXPECT_GT(largest_ratio<dim>(bodies, cells), coarser_by);
  const unsigned int steps = match<dim>(bodies, cells);
  EXPECT_GE(steps, least_steps);
  EXPECT_LT(steps, 10u);
  EXPECT_LE(largest_ratio<dim>(bodies, cells), coarser_by);
}
} // namespace

TEST(CoarseFaces, GoUntilSidesMatch)
{
  check<2>(TwoBoxes<2>::boxes(16, 3), 2);
  check<3>(TwoBoxes<3>::boxes(2, 8), 2);
  check<2>(TwoBoxes<2>::ball_and_socket(4, 16, 2.), 2);
  check<3>(TwoBoxes<3>::ball_and_socket(8, 3, 2.), 1);
  check<2>(TwoBoxes<2>::hanging_boxes(), 1);
}

TEST(CoarseFaces, AreNoneOnMatchingSides)
{
  Cells cells;
  EXPECT_EQ(match<2>(TwoBoxes<2>::boxes(8, 8), cells), 0u);
  EXPECT_EQ(match<2>(TwoBoxes<2>::boxes(8, 7), cells), 0u);
}
