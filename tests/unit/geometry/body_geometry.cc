#include <snug/base/errors.h>
#include <snug/geometry/grid_geometry.h>

#include <deal.II/base/tensor.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace snug;
using dealii::Point;

namespace {
template <int dim>
std::unique_ptr<geometry::GridGeometry<dim>> box(const geometry::BodyMeshParameters &parameters)
{
  auto body = geometry::make_geometry<dim>(parameters);
  return std::unique_ptr<geometry::GridGeometry<dim>>(
    dynamic_cast<geometry::GridGeometry<dim> *>(body.release()));
}

/// The message of the InputError that making the box throws; "" if none.
template <int dim>
std::string box_complaint(const geometry::BodyMeshParameters &parameters)
{
  try
    {
      box<dim>(parameters);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

geometry::BodyMeshParameters curved(const std::string &face, const std::string &value)
{
  geometry::BodyMeshParameters parameters;
  parameters.corner             = {1., 2., 3.};
  parameters.size               = {2., 3., 4.};
  parameters.cells              = {2, 2, 2};
  parameters.curved_faces[face] = value;
  return parameters;
}

geometry::BodyMeshParameters curved_2d(const std::string &face, const std::string &value)
{
  geometry::BodyMeshParameters parameters = curved(face, value);
  parameters.corner.pop_back();
  parameters.size.pop_back();
  parameters.cells.pop_back();
  return parameters;
}

/// Points of the logical unit cube, its face @p face (if < 2 dim).
template <int dim>
std::vector<Point<dim>> logical_points(unsigned int face)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(0., 1.);
  std::vector<Point<dim>>                points(50);
  for (auto &point : points)
    {
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = uniform(random);
      if (face < 2 * dim)
        point[face / 2] = face % 2;
    }
  return points;
}

template <int dim>
void expect_on_sphere(double radius)
{
  for (unsigned int f = 0; f < 2 * dim; ++f)
    {
      const auto        plain = dim == 3 ? curved("top", "0") : curved_2d("top", "0");
      const std::string face  = box<dim>(plain)->boundary_names()[f];
      const std::string value = "sphere " + std::to_string(radius);
      const auto geometry     = box<dim>(dim == 3 ? curved(face, value) : curved_2d(face, value));
      Point<dim> centre;
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] = 0.5;
      centre[f / 2]          = f % 2;
      Point<dim> ball_centre = geometry->grid_position(centre);
      ball_centre[f / 2] -= (f % 2 == 1 ? 1. : -1.) * radius;
      for (const auto &point : logical_points<dim>(f))
        EXPECT_NEAR(geometry->grid_position(point).distance(ball_centre), std::abs(radius), 1e-13);
      for (const auto &point : logical_points<dim>(f ^ 1))
        EXPECT_NEAR((geometry->grid_position(point) -
                     geometry->box_position(geometry->box_fraction(point)))
                      .norm(),
                    0., 1e-14);
    }
}
} // namespace

TEST(BodyGeometry, GradedCellsAreInGeometricProgression)
{
  geometry::BodyMeshParameters parameters;
  parameters.size              = {2., 1.};
  parameters.cells             = {5, 4};
  parameters.grading           = {8., 1.};
  const auto          geometry = box<2>(parameters);
  std::vector<double> size;
  for (unsigned int i = 0; i < 5; ++i)
    size.push_back(geometry->grid_position(Point<2>((i + 1) / 5., 0.))[0] -
                   geometry->grid_position(Point<2>(i / 5., 0.))[0]);
  EXPECT_NEAR(size[4] / size[0], 8., 1e-12);
  for (unsigned int i = 1; i < 5; ++i)
    EXPECT_NEAR(size[i] / size[i - 1], std::pow(8., 0.25), 1e-12);
  EXPECT_EQ(geometry->grid_position(Point<2>(0., 0.))[0], 0.);
  EXPECT_NEAR(geometry->grid_position(Point<2>(1., 0.))[0], 2., 1e-14);
  EXPECT_NEAR(geometry->grid_position(Point<2>(0., 0.3))[1], 0.3, 1e-15);
  EXPECT_GT(geometry->box_fraction(Point<2>(0.1, 0.))[0], 0.);
}

TEST(BodyGeometry, CellsAreEqualInTheFinePartAndGrowFromThere)
{
  for (const double fine : {0.3, 1., 1.9}) // sizes grow, stay and shrink
    {
      geometry::BodyMeshParameters parameters;
      parameters.size              = {2., 1.};
      parameters.cells             = {6, 1};
      parameters.fine_length       = {fine, 0.};
      const auto          geometry = box<2>(parameters);
      std::vector<double> at;
      for (unsigned int i = 0; i <= 6; ++i)
        at.push_back(geometry->grid_position(Point<2>(i / 6., 0.))[0]);
      for (unsigned int i = 1; i <= 3; ++i)
        EXPECT_NEAR(at[i], i * fine / 3., 1e-14);
      const double q = (at[4] - at[3]) / (at[3] - at[2]);
      for (unsigned int i = 4; i < 6; ++i)
        EXPECT_NEAR((at[i + 1] - at[i]) / (at[i] - at[i - 1]), q, 1e-11);
      EXPECT_NEAR(at[6], 2., 1e-13);
    }
}

TEST(BodyGeometry, FinePartMustLeaveARest)
{
  geometry::BodyMeshParameters parameters;
  parameters.size        = {2., 1.};
  parameters.cells       = {6, 1};
  parameters.fine_length = {2., 0.};
  EXPECT_NE(box_complaint<2>(parameters).find("Box fine length"), std::string::npos);
  parameters.fine_length = {0.5, 0.5}; // a single cell along y
  EXPECT_NE(box_complaint<2>(parameters).find("Box fine length"), std::string::npos);
}

TEST(BodyGeometry, SphericalFacesLieOnSpheres)
{
  expect_on_sphere<3>(5.);
  expect_on_sphere<3>(-5.);
  expect_on_sphere<2>(5.);
  expect_on_sphere<2>(-5.);
}

TEST(BodyGeometry, CylindricalFaceIsStraightAlongItsAxis)
{
  const auto geometry = box<3>(curved("bottom", "cylinder x 4"));
  // axis through (y, z) = (2 + 1.5, 3 + 4): the face touches z = 3
  for (const auto &point : logical_points<3>(4))
    {
      const auto x = geometry->grid_position(point);
      EXPECT_NEAR(std::hypot(x[1] - 3.5, x[2] - 7.), 4., 1e-13);
    }
  const auto arc = box<2>(curved_2d("top", "cylinder z -6"));
  for (const auto &point : logical_points<2>(3))
    EXPECT_NEAR(arc->grid_position(point).distance(Point<2>(2., 11.)), 6., 1e-13);
}

TEST(BodyGeometry, FormulaMovesFaceOutwardsAndFadesLinearly)
{
  auto parameters                  = curved("left", "0.1*y + 0.01*z^2 + x");
  parameters.curved_faces["right"] = "0.2*z";
  parameters.grading               = {3., 1., 1.};
  const auto geometry              = box<3>(parameters);
  for (const auto &point : logical_points<3>(6))
    {
      const auto   fraction = geometry->box_fraction(point);
      const auto   flat     = geometry->box_position(fraction);
      const double y = flat[1], z = flat[2];
      // the left face lies at x = 1
      const double left = 0.1 * y + 0.01 * z * z + 1., right = 0.2 * z;
      const auto   moved = geometry->grid_position(point) - flat;
      EXPECT_NEAR(moved[0], -left * (1. - fraction[0]) + right * fraction[0], 1e-14);
      EXPECT_EQ(moved[1], 0.);
      EXPECT_EQ(moved[2], 0.);
    }
}

TEST(BodyGeometry, CoarseMeshFillsTheUnitCubeAndNamesItsFaces)
{
  geometry::BodyMeshParameters parameters;
  parameters.cells    = {2, 3, 4};
  const auto geometry = box<3>(parameters);
  const auto coarse   = geometry->coarse_mesh();
  EXPECT_EQ(coarse.vertices.size(), 3u * 4u * 5u);
  ASSERT_EQ(coarse.cells.size(), 24u);
  double volume = 0.;
  for (const auto &cell : coarse.cells)
    {
      const auto &o = coarse.vertices[cell[0]];
      volume +=
        dealii::cross_product_3d(coarse.vertices[cell[1]] - o, coarse.vertices[cell[2]] - o) *
        (coarse.vertices[cell[4]] - o);
    }
  EXPECT_NEAR(volume, 1., 1e-14);
  ASSERT_EQ(coarse.boundary_faces.size(), 2u * (6 + 8 + 12));
  for (const auto &face : coarse.boundary_faces)
    for (const unsigned int v : face.first)
      EXPECT_EQ(coarse.vertices[v][face.second / 2], face.second % 2);
  EXPECT_EQ(geometry::boundary_index(*geometry, "left"), 0u);
  EXPECT_EQ(geometry::boundary_index(*geometry, "back"), 3u);
  EXPECT_EQ(geometry::boundary_index(*geometry, "top"), 5u);
  EXPECT_EQ(geometry::boundary_index(*box<2>({}), "bottom"), 2u);
  EXPECT_EQ(geometry::boundary_index(*box<2>({}), "top"), 3u);
  try
    {
      geometry::boundary_index(*geometry, "roof");
      FAIL();
    }
  catch (const InputError &error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("roof"), std::string::npos);
      EXPECT_NE(message.find("left, right, front, back, bottom, top"), std::string::npos);
    }
}

TEST(BodyGeometry, RejectsBadEntriesByName)
{
  const auto expect_entry = [](const std::string                  &entry,
                               const geometry::BodyMeshParameters &parameters) {
    const std::string message = box_complaint<3>(parameters);
    EXPECT_NE(message.find("'" + entry + "'"), std::string::npos) << entry << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  const auto with = [](auto member, auto value) {
    geometry::BodyMeshParameters parameters;
    parameters.*member = value;
    return parameters;
  };
  using P       = geometry::BodyMeshParameters;
  using Numbers = std::vector<double>;
  using Counts  = std::vector<unsigned int>;
  expect_entry("Box corner", with(&P::corner, Numbers{0., 0.}));
  expect_entry("Box corner", with(&P::corner, Numbers{0., 0., NAN}));
  expect_entry("Box size", with(&P::size, Numbers{1., 0., 1.}));
  expect_entry("Box size", with(&P::size, Numbers{1., 1., 1., 1.}));
  expect_entry("Box cells", with(&P::cells, Counts{2, 0, 2}));
  expect_entry("Box cells", with(&P::cells, Counts{2, 2}));
  expect_entry("Box grading", with(&P::grading, Numbers{-1., 1., 1.}));
  expect_entry("Box grading", with(&P::grading, Numbers{2., 1., 1.}));
  expect_entry("Curved faces", curved("roof", "sphere 4"));
  // half-diagonal of the bottom: sqrt(1 + 1.5^2) = 1.80
  expect_entry("Curved faces", curved("bottom", "sphere 1.8"));
  expect_entry("Curved faces", curved("bottom", "sphere"));
  expect_entry("Curved faces", curved("bottom", "sphere 4x"));
  expect_entry("Curved faces", curved("bottom", "cylinder z 4"));
  expect_entry("Curved faces", curved("bottom", "cylinder 4"));
  expect_entry("Curved faces", curved("bottom", "cylinder x 1.5"));
  expect_entry("Curved faces", curved("bottom", ""));
  expect_entry("Curved faces", curved("bottom", "sqrt(-x)"));
  EXPECT_EQ(box_complaint<3>(curved("bottom", "sphere 1.81")), "");
  EXPECT_EQ(box_complaint<3>(curved("bottom", "cylinder x 1.51")), "");
  EXPECT_NE(box_complaint<2>(curved_2d("bottom", "cylinder x 4")), "");
  // from a corner of the bottom to the other one: sqrt(2^2 + 3^2) = 3.61
  EXPECT_EQ(box_complaint<3>(curved("bottom", "sphere 3.61 at 1, 2")), "");
  expect_entry("Curved faces", curved("bottom", "sphere 3.6 at 1, 2"));
  EXPECT_EQ(box_complaint<3>(curved("bottom", "cylinder y 2.1 at 3")), "");
  expect_entry("Curved faces", curved("bottom", "cylinder y 1.9 at 3"));
  for (const auto *value :
       {"sphere 9 at 1", "sphere 9 at 1, 2, 3", "sphere 9 at", "sphere 9 at a, b",
        "cylinder x 9 at 1, 2", "sphere at 1, 2", "sphere 9 at 1, nan"})
    expect_entry("Curved faces", curved("bottom", value));
}

TEST(BodyGeometry, TheApexIsWhereTheValueSays)
{
  // of half a body: on the plane x = 1; of a quarter: on the corner (1, 2)
  const struct
  {
    std::string value;
    double      y; ///< of the apex; of cylinders along y any
  } cases[] = {{"cylinder y 9 at 1", 4.}, {"sphere 9 at 1, 2", 2.}, {"sphere -9 at 1, 2", 2.}};
  for (const auto &of : cases)
    {
      const auto   geometry = box<3>(curved("bottom", of.value));
      const double sign     = of.value.find('-') == std::string::npos ? 1. : -1.;
      for (const auto &point : logical_points<3>(4))
        {
          const auto   x  = geometry->grid_position(point);
          const double dx = x[0] - 1., dy = of.value[0] == 'c' ? 0. : x[1] - of.y;
          EXPECT_NEAR(x[2], 3. + sign * (9. - std::sqrt(81. - dx * dx - dy * dy)), 1e-13);
        }
      const auto known = geometry->known_surfaces();
      ASSERT_EQ(known.size(), 1u);
      for (const auto &point : logical_points<3>(4))
        EXPECT_NEAR(known[0].distance(geometry->grid_position(point)), 0., 1e-13);
    }
  const auto flat = box<2>(curved_2d("top", "cylinder z 7 at 3"));
  for (const auto &point : logical_points<2>(3))
    {
      const auto x = flat->grid_position(point);
      EXPECT_NEAR(x[1], 5. - (7. - std::sqrt(49. - (x[0] - 3.) * (x[0] - 3.))), 1e-13);
    }
}

TEST(BodyGeometry, FormulaErrorQuotesTheParserAndPrintsNothing)
{
  testing::internal::CaptureStderr();
  const std::string message = box_complaint<3>(curved("top", "x + foo(y)"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(message.find("x + foo(y)"), std::string::npos);
  EXPECT_NE(message.find("Unexpected token \"foo\""), std::string::npos) << message;
}
