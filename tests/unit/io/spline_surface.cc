#include <snug/io/spline_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace snug {
namespace {
/// A face of the only body of a mesh, with its chart and its positions in a design.
template <int dim>
struct Designed
{
  using Vector = dealii::Tensor<1, dim>;

  mesh::BodyMesh<dim>         mesh;
  shape::ShapeParameters      parameters;
  shape::ShapedFace<dim>      face;
  shape::FaceCoordinates<dim> coordinates;
  shape::FaceChart<dim>       chart;
  std::vector<Vector>         positions;

  Designed(const geometry::BodyMeshParameters          &body,
           const std::string                           &boundary,
           const shape::Coordinates                     kind,
           const std::function<Vector(const Vector &)> &move)
    : mesh(MPI_COMM_WORLD, {body}, 1)
    , parameters(make(boundary, kind))
    , face(mesh, {{"part"}}, parameters)
    , coordinates(face, parameters)
    , chart(face, coordinates)
    , positions(face.positions())
  {
    for (auto &x : positions)
      x += move(x);
  }

  static shape::ShapeParameters make(const std::string &boundary, const shape::Coordinates kind)
  {
    shape::ShapeParameters parameters;
    parameters.face        = "part." + boundary;
    parameters.coordinates = kind;
    return parameters;
  }
};

/// A ring of radii 1 and 3, or half of it, whose outer face has samples.
geometry::BodyMeshParameters ring(const geometry::Part part, const unsigned int dim)
{
  geometry::BodyMeshParameters body;
  body.source       = geometry::Source::ring;
  body.radius       = 3.;
  body.inner_radius = 1.;
  body.part         = part;
  body.complete(dim);
  body.round_cells = {16, 2, 3};
  body.round_cells.resize(dim);
  body.sampled_boundaries = {"outer"};
  body.is_designed        = true;
  return body;
}

/// Return random fractions of the coordinates.
template <int dim>
std::vector<dealii::Tensor<1, dim - 1>> random_fractions(const unsigned int n)
{
  std::mt19937                            random(7);
  std::uniform_real_distribution<double>  uniform(0., 1.);
  std::vector<dealii::Tensor<1, dim - 1>> result(n);
  for (auto &at : result)
    for (unsigned int a = 0; a < dim - 1; ++a)
      at[a] = uniform(random);
  return result;
}

/// The radius 3 + 0.1 cos(2 angle) of a bore that is pulled oval, with the angle in the plane.
template <int dim>
dealii::Tensor<1, dim> oval(const dealii::Tensor<1, dim> &x)
{
  const double           angle = std::atan2(x[1], x[0]);
  dealii::Tensor<1, dim> move;
  move[0] = 0.1 * std::cos(2. * angle) * std::cos(angle);
  move[1] = 0.1 * std::cos(2. * angle) * std::sin(angle);
  return move;
}

template <int dim>
void expect_oval(const geometry::Part part, const double tolerance)
{
  const Designed<dim> designed(ring(part, dim), "outer", shape::Coordinates::arc_length, oval<dim>);
  const auto          surface =
    io::fit_splines<dim>(io::points_of(designed.chart, designed.positions), tolerance, 5000);
  EXPECT_LE(surface.deviation, tolerance);
  EXPECT_GT(surface.deviation, 0.);
  EXPECT_TRUE(designed.chart.fills_rectangle());
  for (const auto &at : random_fractions<dim>(500))
    {
      const auto   x = surface.value(at);
      const double r = std::hypot(x[0], x[1]), angle = std::atan2(x[1], x[0]);
      // The samples of faces of 22.5 degrees deviate from the oval by 2e-6, and the maximum over
      // some random points is not the maximum of the face.
      EXPECT_NEAR(r, 3. + 0.1 * std::cos(2. * angle), 2. * tolerance + 4e-6);
      if (dim == 3)
        {
          EXPECT_NEAR(x[dim - 1], at[dim - 2], 1e-9);
        }
    }
}

TEST(SplineSurface, DeviatesByAtMostTheTolerance)
{
  expect_oval<2>(geometry::Part::full, 1e-3);
  expect_oval<2>(geometry::Part::half, 1e-5);
  expect_oval<3>(geometry::Part::half, 1e-5);
  expect_oval<3>(geometry::Part::full, 1e-5);
}

/// Only the spans at the bump are divided, and only along x.
TEST(SplineSurface, RefinesWhereAndAlongWhichTheDesignIsCurved)
{
  geometry::BodyMeshParameters body;
  body.complete(3);
  body.cells              = {20, 4, 1};
  body.sampled_boundaries = {"top"};
  body.is_designed        = true;
  const Designed<3> designed(body, "top", shape::Coordinates::projection, [](const auto &x) {
    dealii::Tensor<1, 3> move;
    move[2] = 0.01 * std::exp(-200. * (x[0] - 0.8) * (x[0] - 0.8)) + 0.1 * x[1];
    return move;
  });
  const auto        surface =
    io::fit_splines<3>(io::points_of(designed.chart, designed.positions), 1e-6, 5000);
  EXPECT_LE(surface.deviation, 1e-6);
  EXPECT_LE(surface.n_spans(1), 4u);
  unsigned int at_bump = 0, elsewhere = 0;
  const auto   breaks = surface.axes[0].breaks();
  for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
    ++(breaks[i] > 0.5 ? at_bump : elsewhere);
  EXPECT_GT(at_bump, 2 * elsewhere);
}

/// Kinks need more spans than allowed: the best surface is returned with its deviation.
TEST(SplineSurface, ReturnsTheBestSurfaceOfFewPoints)
{
  geometry::BodyMeshParameters body;
  body.complete(2);
  body.cells              = {10, 1};
  body.sampled_boundaries = {"top"};
  body.is_designed        = true;
  const Designed<2> designed(body, "top", shape::Coordinates::projection, [](const auto &x) {
    dealii::Tensor<1, 2> move;
    move[1] = std::abs(x[0] - 0.5);
    return move;
  });
  const auto        surface =
    io::fit_splines<2>(io::points_of(designed.chart, designed.positions), 1e-12, 40);
  EXPECT_LE(surface.points.size(), 40u);
  EXPECT_GT(surface.deviation, 1e-12);
  EXPECT_LT(surface.deviation, 1e-2);
  EXPECT_FALSE(designed.chart.is_oriented()); // the body is on the right along x
}

/// A face whose border is not the rectangle of its coordinates: its loops are a circle.
TEST(FaceChart, FindsTheBorderOfADisc)
{
  geometry::BodyMeshParameters body;
  body.source = geometry::Source::cylinder;
  body.radius = 2.;
  body.complete(3);
  body.round_cells        = {4, 1};
  body.sampled_boundaries = {"top"};
  body.is_designed        = true;
  const auto bump         = [](const dealii::Tensor<1, 3> &x) {
    dealii::Tensor<1, 3> move;
    move[2] = 0.05 * std::cos(x[0]) * std::cos(0.7 * x[1]);
    return move;
  };
  const Designed<3> designed(body, "top", shape::Coordinates::projection, bump);
  EXPECT_FALSE(designed.chart.fills_rectangle());
  EXPECT_TRUE(designed.chart.is_oriented());
  const auto loops = designed.chart.loops();
  ASSERT_EQ(loops.size(), 1u);
  ASSERT_EQ(loops[0].size(), 1u); // no corner
  double turn = 0.;
  for (unsigned int k = 0; k < loops[0][0].size(); ++k)
    {
      const auto lever = loops[0][0][k] - designed.chart.range() / 2.;
      EXPECT_NEAR(lever.norm(), 2., 1e-12);
      if (k > 0)
        {
          const auto before = loops[0][0][k - 1] - designed.chart.range() / 2.;
          turn += before[0] * lever[1] - before[1] * lever[0];
        }
    }
  EXPECT_GT(turn, 0.); // counterclockwise
  const auto surface =
    io::fit_splines<3>(io::points_of(designed.chart, designed.positions), 1e-6, 5000);
  EXPECT_LE(surface.deviation, 1e-6);
  for (const auto &at : random_fractions<3>(500))
    {
      auto lever = at;
      for (unsigned int a = 0; a < 2; ++a)
        lever[a] = (at[a] - 0.5) * 4.;
      if (lever.norm() > 1.99)
        continue;
      const auto           x = surface.value(at);
      dealii::Tensor<1, 3> flat;
      flat[0] = x[0];
      flat[1] = x[1];
      EXPECT_NEAR(x[2] - 1., bump(flat)[2], 3e-6);
      EXPECT_NEAR(x[0], lever[0], 1e-5);
    }
}
} // namespace
} // namespace snug
