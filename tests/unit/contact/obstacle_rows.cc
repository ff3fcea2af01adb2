#include <snug/geometry/face_list.h>

#include <gtest/gtest.h>

#include "row_checks.h"

using namespace snug;
using namespace snug::contact;
using namespace snug::faces;

namespace {
/// The slave box above a ball, or another obstacle that curves, which is
/// pressed up and has a gap on top.
template <int dim>
Pair pair_with(const std::string &shape)
{
  ObstacleParameters obstacle;
  obstacle.name  = "obstacle";
  obstacle.shape = shape;
  obstacle.point.assign(dim, 0.4);
  obstacle.normal.assign(dim, 0.1);
  obstacle.axis.assign(dim, 0.2);
  obstacle.displacement.assign(dim, -0.05);
  obstacle.normal[dim - 1]       = 1.;
  obstacle.displacement[dim - 1] = 0.1;
  obstacle.radius                = shape.find("hollow") == 0 ? 3. : 0.5;
  obstacle.formula               = "0.3 * sin(x) + 0.2 * x * y + 2 * y^2 - 0.1";
  Pair pair                      = TwoBoxes<dim>::pair();
  pair.obstacle                  = obstacle;
  pair.parameters.gap            = "0.1 + 0.02 * x^2 + 0.03 * sin(y)";
  pair.parameters.largest_angle  = 180.;
  return pair;
}

template <int dim>
void expect_exact_derivatives(const std::string &shape, unsigned int degree)
{
  TwoBoxes<dim> scene(TwoBoxes<dim>::hanging_boxes(), degree);
  scene.bend();
  const Contact<dim> contact(scene.surface, {pair_with<dim>(shape), TwoBoxes<dim>::pair()}, degree,
                             scene.positions, scene.held);
  // element sizes are 0.08, differences of formulas are good to 1e-10
  EXPECT_LT(derivative_error(scene, contact, 1e-4), 1e-8) << shape;
  EXPECT_LT(reverse_error(scene, contact), 1e-9) << shape;
}

Pair plane_below(double height)
{
  Pair pair             = pair_with<2>("plane");
  pair.obstacle->point  = {0., height};
  pair.obstacle->normal = {0., 1.};
  pair.parameters       = {};
  return pair;
}
} // namespace

TEST(ObstacleRows, DerivativesAgreeWithFiniteDifferences)
{
  for (const auto &shape : obstacle_table<3>())
    {
      expect_exact_derivatives<2>(shape.name, 1);
      expect_exact_derivatives<2>(shape.name, 2);
      expect_exact_derivatives<3>(shape.name, 1);
    }
}

TEST(ObstacleRows, GapIsDistancePlusFormulaMinusApproach)
{
  const TwoBoxes<2> scene(TwoBoxes<2>::boxes(4, 4), 1);
  Pair              pair      = plane_below(0.9);
  pair.obstacle->displacement = {7., 0.03};
  pair.parameters.gap         = "0.5 * x";
  const Contact<2> contact(scene.surface, {pair}, 1, scene.positions, scene.held);
  const auto       rows = contact.rows(scene.positions);
  ASSERT_EQ(rows.size(), 5u);
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const double x = scene.positions[contact.places()[i].slave][0];
      EXPECT_NEAR(rows[i].gap, 0.1 - 0.03 + 0.5 * x, 1e-14);
      EXPECT_NEAR(rows[i].normal[1], -1., 1e-15);
      ASSERT_EQ(rows[i].coefficients.size(), 1u);
    }
  double total = 0.;
  for (const double area : contact.areas(scene.positions))
    total += area;
  EXPECT_NEAR(total, 1., 1e-14);
}

TEST(ObstacleRows, NodesOutOfReachOrTurnedAwayCarryNone)
{
  auto bodies            = TwoBoxes<2>::boxes(10, 1);
  bodies[0].curved_faces = {{"bottom", "-0.5 * x^2"}};
  const TwoBoxes<2> scene(bodies, 1);
  const auto        n_rows = [&](const PairParameters &parameters) {
    Pair pair       = plane_below(0.9);
    pair.parameters = parameters;
    return Contact<2>(scene.surface, {pair}, 1, scene.positions, scene.held).n_rows();
  };
  PairParameters parameters;
  EXPECT_EQ(n_rows(parameters), 11u);
  // heights 0.1 + x^2/2 with x = 0, 0.1, ...; a limit that is met counts
  parameters.search_distance = 0.1 + 0.5 * 0.4 * 0.4;
  EXPECT_EQ(n_rows(parameters), 5u);
  parameters.search_distance = 0.;
  // slopes of the face are x in the middle of neighbours, 0.95 at the end
  parameters.largest_angle = std::atan(0.6) * 180. / dealii::numbers::PI;
  EXPECT_EQ(n_rows(parameters), 7u);
  parameters.search_distance = 0.01;
  EXPECT_THROW(n_rows(parameters), InputError);
}

TEST(ObstacleRows, ANodeMeetsAnObstacleOnce)
{
  // bottom and left face share a node: only one of its two equal rows stays
  auto                   bodies = TwoBoxes<2>::boxes(4, 4);
  const TwoBoxes<2>      boxes(bodies, 1);
  const mesh::Surface<2> surface(boxes.mesh, {{0, 2}, {0, 0}});
  const auto             positions = surface.gather(boxes.mesh.reference_positions());
  Pair                   bottom = plane_below(0.9), left = bottom;
  left.slave              = {0, 0};
  bottom.obstacle->normal = left.obstacle->normal = {1., 1.};
  const Contact<2> contact(surface, {bottom, left}, 1, positions,
                           HeldDirections<2>(surface.n_nodes()));
  EXPECT_EQ(contact.n_rows(), 5u + 2u - 1u);
}

TEST(Contact, ANodeOnASharpEdgeBelongsToTheFaceThatMeetsTheObstacle)
{
  // Bottom and left face of a box are no smooth surface. The node that they share presses on a
  // plane below with the area on the bottom, in whatever order the pairs stand.
  const TwoBoxes<2>      boxes(TwoBoxes<2>::boxes(4, 4), 1);
  const mesh::Surface<2> surface(boxes.mesh, {{0, 2}, {0, 0}});
  const auto             positions = surface.gather(boxes.mesh.reference_positions());
  Pair                   bottom = plane_below(0.9), left = bottom;
  bottom.slave_name = "bottom";
  left.slave        = {0, 0};
  left.slave_name   = "left";
  for (const auto &pairs : {std::vector<Pair>{bottom, left}, std::vector<Pair>{left, bottom}})
    {
      const Contact<2> contact(surface, pairs, 1, positions, HeldDirections<2>(surface.n_nodes()));
      const auto       areas = contact.areas(positions);
      double           area  = 0.;
      for (const auto &pair : contact.named_pairs())
        if (pair.slave_name == "bottom")
          {
            EXPECT_EQ(pair.rows.size(), 5u);
            for (const auto &[row, share] : pair.rows)
              area += share * areas[row];
          }
      EXPECT_NEAR(area, 1., 1e-14);
    }
}

/// The upper box's bottom and the lower box's top, each with the shares of two pairs of the scene
/// that name the sides in opposite order.
TEST(Contact, PairsOfTheSameFacesAreOneContact)
{
  const TwoBoxes<2> scene(TwoBoxes<2>::boxes(4, 4), 1);
  Pair              pair = TwoBoxes<2>::pair();
  pair.parameters.slave  = Slave::finer;
  Pair exchanged         = pair;
  std::swap(exchanged.slave, exchanged.master);
  std::swap(exchanged.slave_name, exchanged.master_name);
  const Contact<2> contact(scene.surface, {pair, exchanged}, 1, scene.positions, scene.held);
  EXPECT_EQ(contact.pairs().size(), 1u);
  EXPECT_EQ(contact.n_rows(), 5u);
  for (const auto &named : contact.named_pairs())
    EXPECT_EQ(named.name(), "slave: master");
  // Other entries make another contact, whose rows would be the same: it is left without any.
  Pair other           = pair;
  other.parameters.gap = "0.1";
  EXPECT_THROW(Contact<2>(scene.surface, {pair, other}, 1, scene.positions, scene.held),
               InputError);
}

TEST(Pair, SidesNameSeveralFaces)
{
  EXPECT_EQ(geometry::face_list("a.nose + a.fillet"),
            (std::vector<std::string>{"a.nose", "a.fillet"}));
  EXPECT_EQ(geometry::face_list("a.c+d"), std::vector<std::string>{"a.c+d"});
  Side side(1, 4);
  side.add({1, 2});
  side.add({1, 4});
  EXPECT_EQ(side.boundaries(), (std::vector<Boundary>{{1, 2}, {1, 4}}));
}

TEST(Contact, SlaveIsTheFinerSideOfNodalRows)
{
  const TwoBoxes<3> scene(TwoBoxes<3>::boxes(3, 5), 1);
  Pair              pair = TwoBoxes<3>::pair();
  for (const Slave slave : {Slave::first, Slave::finer})
    {
      pair.parameters.slave = slave;
      const Contact<3> contact(scene.surface, {pair}, 1, scene.positions, scene.held);
      EXPECT_EQ(contact.n_rows(), slave == Slave::first ? 16u : 36u);
      EXPECT_EQ(contact.pairs()[0].name(),
                slave == Slave::first ? "slave: master" : "master: slave");
      for (const auto &place : contact.places())
        EXPECT_EQ(scene.is_master(place.slave), slave == Slave::finer);
    }
}
