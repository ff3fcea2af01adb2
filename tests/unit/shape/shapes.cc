#include <snug/shape/shapes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace snug {
namespace {
using Parameters = shape::ShapeParameters;

const shape::BodyNames two_names{{"upper", "lower"}};

std::vector<geometry::BodyMeshParameters> two_squares()
{
  std::vector<geometry::BodyMeshParameters> bodies(2);
  for (auto &body : bodies)
    body.cells = {4, 4};
  bodies[0].corner = {0., 1.};
  return bodies;
}

Parameters patch(const std::string &name, const std::string &face, unsigned int n)
{
  Parameters parameters;
  parameters.name           = name;
  parameters.basis          = "Bezier patch";
  parameters.face           = face;
  parameters.control_points = {n};
  parameters.direction      = {0., 1.};
  parameters.bounds         = {-0.1 * n, 0.2};
  return parameters;
}

/// The message of the error that @p spoil causes.
template <typename Spoil>
std::string failure_reason(const Spoil &spoil)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, two_squares(), 1);
  auto                    parameters = patch("roof", "lower.top", 3);
  spoil(parameters);
  try
    {
      shape::Shapes<2>(mesh, two_names, {parameters});
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

/// The largest move of a node of a cell by a unit change of variable @p j, over the edge 1/4.
double move_over_edge(const shape::Shapes<2> &shapes, const unsigned int j)
{
  double largest = 0.;
  for (const auto &move : shapes.column(j))
    largest = std::max(largest, move.norm() / 0.25);
  return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
}

TEST(Shapes, FirstStepsMoveNodesByHalfACellEdge)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, two_squares(), 1);
  Parameters              modes;
  modes.name   = "modes";
  modes.basis  = "formula modes";
  modes.face   = "upper.bottom";
  modes.modes  = {{"0", "1e3*x"}, {"0", "x*(1-x)"}};
  modes.bounds = {-1., 1.};
  const shape::Shapes<2> shapes(mesh, two_names, {patch("roof", "lower.top", 4), modes});
  const auto             steps = shapes.first_steps();
  ASSERT_EQ(steps.size(), 6u);
  // a patch has one step, of the control point that moves nodes most: those at the ends
  EXPECT_NEAR(steps[0] * move_over_edge(shapes, 0), 0.5, 1e-12);
  EXPECT_LT(steps[1] * move_over_edge(shapes, 1), 0.4);
  for (unsigned int j = 1; j < 4; ++j)
    EXPECT_EQ(steps[j], steps[0]);
  // each mode has its own
  for (unsigned int j = 4; j < 6; ++j)
    EXPECT_NEAR(steps[j] * move_over_edge(shapes, j), 0.5, 1e-12) << j;
}

TEST(Shapes, AddUpAndKeepTheirVariablesApart)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, two_squares(), 1);
  auto                    first = patch("a", "lower.top", 3);
  first.initial                 = {0.05};
  const auto             second = patch("b", "upper.bottom", 2);
  const shape::Shapes<2> both(mesh, two_names, {first, second});
  const shape::Shapes<2> a(mesh, two_names, {first});
  const shape::Shapes<2> b(mesh, two_names, {second});
  ASSERT_EQ(both.n_variables(), 5u);
  EXPECT_EQ(both.start(), (std::vector<double>{0.05, 0.05, 0.05, 0., 0.}));
  EXPECT_EQ(both.lower_bounds()[2], -0.1 * 3);
  EXPECT_EQ(both.lower_bounds()[3], -0.1 * 2);
  EXPECT_EQ(both.upper_bounds()[4], 0.2);
  const auto moves = both.apply({0.1, 0.2, -0.1, 0.3, 0.4});
  const auto of_a  = a.apply({0.1, 0.2, -0.1});
  const auto of_b  = b.apply({0.3, 0.4});
  for (unsigned int node = 0; node < moves.size(); ++node)
    EXPECT_EQ(moves[node], of_a[node] + of_b[node]);
  auto       expected = a.transpose(moves);
  const auto rest     = b.transpose(moves);
  expected.insert(expected.end(), rest.begin(), rest.end());
  EXPECT_EQ(both.transpose(moves), expected);
  const auto points = both.control_points({0., 0., 0.1, 0., 0.});
  ASSERT_EQ(points.size(), 5u);
  EXPECT_EQ(points[3].shape, "b");
  EXPECT_EQ(points[3].index, 0u);
  EXPECT_EQ(points[2].position, dealii::Point<2>(1., 1.1));
  EXPECT_EQ(both.faces().size(), 2u);
}

TEST(Shapes, RejectBoundsAndStarts)
{
  const auto expect_entry = [](const std::string &entry, const auto &spoil) {
    const auto message = failure_reason(spoil);
    EXPECT_NE(message.find("'Shape roof/" + entry + "'"), std::string::npos) << message;
  };
  EXPECT_EQ(failure_reason([](Parameters &) {}), "");
  expect_entry("Bounds", [](Parameters &p) { p.bounds = {0.5, 0.5}; });
  expect_entry("Bounds", [](Parameters &p) { p.bounds = {0.5}; });
  expect_entry("Bounds", [](Parameters &p) { p.bounds = {NAN, 1.}; });
  expect_entry("Initial", [](Parameters &p) { p.initial.assign(2, 0.); });
  expect_entry("Initial", [](Parameters &p) { p.initial.assign(3, 2.); });
  expect_entry("Initial", [](Parameters &p) { p.bounds = {0.1, 0.2}; });
}
} // namespace
} // namespace snug
