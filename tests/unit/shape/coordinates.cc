#include <cmath>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

const double pi = std::acos(-1.);

/// A ring or hollow cylinder with the radii 1 and 2.
geometry::BodyMeshParameters
ring(geometry::Part part, unsigned int around, std::vector<unsigned int> more = {1})
{
  geometry::BodyMeshParameters body;
  body.source       = geometry::Source::ring;
  body.inner_radius = 1.;
  body.radius       = 2.;
  body.length       = 1.5;
  body.part         = part;
  body.round_cells  = {around};
  body.round_cells.insert(body.round_cells.end(), more.begin(), more.end());
  return body;
}

shape::ShapeParameters patch(const std::string &face, std::vector<unsigned int> points)
{
  shape::ShapeParameters parameters;
  parameters.basis          = "B-spline patch";
  parameters.face           = face;
  parameters.control_points = std::move(points);
  parameters.degree         = 3;
  parameters.interior       = shape::InteriorKind::Laplace;
  parameters.bounds         = {-0.5, 1.};
  return parameters;
}

template <int dim>
using Field = typename mesh::BodyMesh<dim>::Field;

template <int dim>
Field<dim> moves(const mesh::BodyMesh<dim>    &mesh,
                 const shape::ShapeParameters &parameters,
                 const std::vector<double>    &design)
{
  return shape::Shapes<dim>(mesh, {{"body"}}, {parameters}).apply(design);
}

template <int dim>
double largest_difference(const Field<dim> &a, const Field<dim> &b)
{
  double result = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    result = std::max(result, (a[i] - b[i]).norm());
  return result;
}

/// The message of the InputError.
template <int dim>
std::string message(const mesh::BodyMesh<dim> &mesh, const shape::ShapeParameters &parameters)
{
  try
    {
      shape::Shapes<dim>(mesh, {{"body"}}, {parameters});
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

TEST(Coordinates, OfAFlatFaceAreArcLengths)
{
  const auto check = [](auto dimension, std::vector<unsigned int> points) {
    constexpr int dim     = dimension;
    auto          bodies  = plain_cube<dim>(5);
    bodies[0].grading     = std::vector<double>(dim, 3.);
    const auto mesh       = mesh::BodyMesh<dim>(MPI_COMM_WORLD, bodies, 2);
    auto       projected  = patch("body.top", points);
    projected.coordinates = shape::Coordinates::projection;
    auto along            = projected;
    along.coordinates     = shape::Coordinates::arc_length;
    const shape::Shapes<dim> a(mesh, {{"body"}}, {projected}), b(mesh, {{"body"}}, {along});
    const auto               design = random_numbers(a.n_variables(), 4);
    EXPECT_LT(largest_difference<dim>(a.apply(design), b.apply(design)), 1e-12);
    const auto p = a.control_points(design), q = b.control_points(design);
    for (unsigned int i = 0; i < p.size(); ++i)
      EXPECT_NEAR((p[i].position - q[i].position).norm(), 0., 1e-12);
  };
  check(std::integral_constant<int, 2>(), {6});
  check(std::integral_constant<int, 3>(), {5, 4});
}

/// Facets and parabolas of a circle: the arc length is that of the circle.
TEST(Coordinates, OfAHalfCircleAreItsArcLengthAndAngle)
{
  for (const unsigned int degree : {1, 2})
    for (const bool sampled : {false, true})
      {
        auto body = ring(geometry::Part::half, 7);
        if (sampled)
          body.sampled_boundaries = {"outer"};
        const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {body}, degree);
        auto                    parameters = formulas<2>();
        parameters.face                    = "body.outer";
        parameters.modes                   = {{"s", "length"}};
        parameters.coordinates             = shape::Coordinates::arc_length;
        const auto by_length               = moves(mesh, parameters, {1.});
        parameters.modes                   = {{"s", "angle"}};
        parameters.coordinates             = shape::Coordinates::angle;
        const auto by_angle                = moves(mesh, parameters, {1.});
        for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
          if (const auto &x = mesh.reference_positions()[node]; std::abs(x.norm() - 2.) < 1e-9)
            {
              const double theta = std::atan2(x[1], x[0]);
              // The arc length begins at the smaller x, the angle at its lower end.
              EXPECT_NEAR(by_length[node][0], 2. * (pi - theta), 1e-6) << degree << sampled;
              EXPECT_NEAR(by_length[node][1], 2. * pi, 1e-6);
              EXPECT_NEAR(by_angle[node][0], theta, 1e-12);
              EXPECT_NEAR(by_angle[node][1], theta, 1e-12);
            }
      }
}

/// A start that turns by the distance of two control points renumbers them.
TEST(Coordinates, OfABoreAreClosed)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {ring(geometry::Part::full, 24)}, 2);
  const mesh::BodyMesh<3> solid(MPI_COMM_WORLD, {ring(geometry::Part::full, 24, {1, 2})}, 1);
  const auto              design = random_numbers(8, 6);
  std::vector<double>     shifted(design.begin() + 1, design.end());
  shifted.push_back(design.front());
  for (const auto kind : {shape::Coordinates::angle, shape::Coordinates::arc_length})
    for (const unsigned int degree : {2, 3})
      {
        auto first         = patch("body.inner", {8});
        first.degree       = degree;
        first.coordinates  = kind;
        auto turned        = first;
        turned.start_angle = 45.;
        EXPECT_LT(largest_difference<2>(moves(mesh, first, design), moves(mesh, turned, shifted)),
                  1e-12);
        first.control_points = turned.control_points = {8, 1};
        EXPECT_LT(largest_difference<3>(moves(solid, first, design), moves(solid, turned, shifted)),
                  1e-12);
      }
  // no border, and smooth across the beginning
  auto parameters  = patch("body.inner", {8});
  parameters.fixed = {"border"};
  const shape::Shapes<2> shapes(mesh, {{"body"}}, {parameters});
  EXPECT_EQ(shapes.n_variables(), 8u);
  const auto points = shapes.control_points(design);
  for (unsigned int i = 0; i < 8; ++i)
    {
      const auto at = points[i].position - points[i].move;
      EXPECT_NEAR(std::remainder(std::atan2(at[1], at[0]) - pi / 4. * i, 2. * pi), 0., 1e-6);
    }
}

/// The design of a turned body is the turned design.
TEST(Coordinates, TurnWithTheBody)
{
  auto body         = ring(geometry::Part::half, 9);
  auto turned       = body;
  turned.rotate     = {{"z", "50"}};
  const auto design = random_numbers(6, 8);
  auto       outer  = patch("body.outer", {6});
  outer.coordinates = shape::Coordinates::angle;
  const mesh::BodyMesh<2> one(MPI_COMM_WORLD, {body}, 1), other(MPI_COMM_WORLD, {turned}, 1);
  const auto              a = moves(one, outer, design), b = moves(other, outer, design);
  const double            c = std::cos(50. * pi / 180.), s = std::sin(50. * pi / 180.);
  for (unsigned int node = 0; node < a.size(); ++node)
    {
      EXPECT_NEAR(b[node][0], c * a[node][0] - s * a[node][1], 1e-10);
      EXPECT_NEAR(b[node][1], s * a[node][0] + c * a[node][1], 1e-10);
    }
}

/// The axis of a hollow cylinder that leans is found, and the arc length along it is the axial
/// position.
TEST(Coordinates, OfASurfaceOfRevolutionAreAngleAndMeridian)
{
  auto body   = ring(geometry::Part::half, 8, {1, 3});
  body.rotate = {{"x", "90"}}; // the axis is -y
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, {body}, 1);
  auto                    parameters = formulas<3>();
  parameters.face                    = "body.outer";
  parameters.modes                   = {{"angle", "t", "length"}};
  parameters.coordinates             = shape::Coordinates::angle;
  const auto moved                   = moves(mesh, parameters, {1.});
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (const auto &x = mesh.reference_positions()[node];
        std::abs(std::hypot(x[0], x[2]) - 2.) < 1e-9)
      {
        // right-handed about y, from x
        EXPECT_NEAR(std::remainder(moved[node][0] - std::atan2(-x[2], x[0]), 2. * pi), 0., 1e-9);
        EXPECT_NEAR(moved[node][1], x[1] + 1.5, 1e-9);
        EXPECT_NEAR(moved[node][2], 1.5, 1e-9);
      }
}

/// A quarter of a sphere about the axis z: the meridian is a quarter of a circle.
TEST(Coordinates, OfASphereNeedAnAxis)
{
  geometry::BodyMeshParameters ball;
  ball.source             = geometry::Source::sphere;
  ball.radius             = 2.;
  ball.part               = geometry::Part::half;
  ball.round_cells        = {3};
  ball.sampled_boundaries = {"outer"};
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, {ball}, 1);
  auto                    parameters = formulas<3>();
  parameters.face                    = "body.outer";
  parameters.modes                   = {{"t", "0", "length"}};
  parameters.coordinates             = shape::Coordinates::angle;
  EXPECT_NE(message(mesh, parameters).find("Shape/Axis'"), std::string::npos);
  parameters.axis  = {0., 0., 2.};
  const auto moved = moves(mesh, parameters, {1.});
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (const auto &x = mesh.reference_positions()[node]; std::abs(x.norm() - 2.) < 1e-9)
      {
        // Nodes on the sphere have exact normals there except at the edge of the half.
        EXPECT_NEAR(moved[node][0], 2. * std::asin(std::min(1., x[2] / 2.)), 2e-3);
        EXPECT_NEAR(moved[node][2], pi, 2e-3);
      }
  auto varying        = patch("body.outer", {5, 4});
  varying.coordinates = shape::Coordinates::angle;
  varying.axis        = {0., 0., 1.};
  EXPECT_NE(message(mesh, varying).find("reaches the axis"), std::string::npos);
  varying.control_points = {1, 4};
  EXPECT_EQ(message(mesh, varying), "");
}

/// A patch over two parts of a side is the patch over the side.
TEST(Coordinates, RunAlongAChainOfBoundaries)
{
  auto bodies            = plain_cube<2>(6);
  bodies[0].curved_faces = {{"top", "cylinder z 3"}};
  const mesh::BodyMesh<2> whole(MPI_COMM_WORLD, bodies, 2);
  bodies[0].boundary_formulas = {{"crest", "top & 0.5-x"}};
  const mesh::BodyMesh<2> parts(MPI_COMM_WORLD, bodies, 2);
  const auto              design = random_numbers(5, 9);
  auto                    one    = patch("body.top", {5});
  one.coordinates                = shape::Coordinates::arc_length;
  auto chain                     = one;
  chain.face                     = "body.top + body.crest";
  EXPECT_LT(largest_difference<2>(moves(whole, one, design), moves(parts, chain, design)), 1e-12);
  EXPECT_EQ(shape::Shapes<2>(parts, {{"body"}}, {chain}).faces().size(), 2u);
  chain.face = "body.top + body.top";
  EXPECT_NE(message(parts, chain).find("once"), std::string::npos);
  chain.face = "body.crest + body.bottom";
  EXPECT_NE(message(parts, chain).find("connected"), std::string::npos);
}

/// Half of a body with a smooth end is half of the whole with equal control points on both sides.
TEST(Coordinates, AreSmoothAcrossSymmetryPlanes)
{
  // a flat face: 4 control points of half are 7 of the whole
  auto                    bodies = plain_cube<2>(4);
  const mesh::BodyMesh<2> half(MPI_COMM_WORLD, bodies, 1);
  bodies[0].corner = {-1., 0.};
  bodies[0].size   = {2., 1.};
  bodies[0].cells  = {8, 4};
  const mesh::BodyMesh<2> whole(MPI_COMM_WORLD, bodies, 1);
  for (const std::string basis : {"B-spline patch", "Bezier patch"})
    {
      auto of_half   = patch("body.top", {4});
      of_half.basis  = basis;
      auto of_whole  = patch("body.top", {7});
      of_whole.basis = basis;
      of_half.smooth = {"left"};
      const shape::Shapes<2> a(half, {{"body"}}, {of_half}), b(whole, {{"body"}}, {of_whole});
      const auto             p = a.control_points({1., 2., 3., 5.});
      const auto             q = b.control_points({5., 3., 2., 1., 2., 3., 5.});
      for (unsigned int i = 0; i < 4; ++i)
        {
          EXPECT_NEAR((p[i].position - q[i + 3].position).norm(), 0., 1e-12);
          EXPECT_NEAR((p[i].on_body - q[i + 3].on_body).norm(), 0., 1e-12);
        }
    }
  // a bore between two planes: 5 control points of half are 8 of the whole
  const mesh::BodyMesh<2> half_ring(MPI_COMM_WORLD, {ring(geometry::Part::half, 16)}, 1),
    ring_mesh(MPI_COMM_WORLD, {ring(geometry::Part::full, 32)}, 1);
  auto of_half        = patch("body.inner", {5});
  of_half.coordinates = shape::Coordinates::angle;
  of_half.smooth      = {"start", "end"};
  const shape::Shapes<2> a(half_ring, {{"body"}}, {of_half}),
    b(ring_mesh, {{"body"}}, {patch("body.inner", {8})});
  const auto p = a.control_points({1., 2., 3., 5., 4.});
  const auto q = b.control_points({1., 2., 3., 5., 4., 5., 3., 2.});
  for (unsigned int i = 0; i < 5; ++i)
    EXPECT_NEAR((p[i].on_body - q[i].on_body).norm(), 0., 1e-10) << i;
}

TEST(Coordinates, RejectBadEntriesByName)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {ring(geometry::Part::full, 12)}, 1);
  const mesh::BodyMesh<2> box(MPI_COMM_WORLD, plain_cube<2>(3), 1);
  const auto              says = [&](const auto &on, const shape::ShapeParameters &bad,
                        const std::string &text) {
    EXPECT_NE(message(on, bad).find(text), std::string::npos) << text << ": " << message(on, bad);
  };
  auto bad  = patch("body.inner", {6});
  bad.basis = "Bezier patch";
  says(mesh, bad, "must be B-spline patch for a closed face");
  bad             = patch("body.inner", {6});
  bad.coordinates = shape::Coordinates::projection;
  says(mesh, bad, "90 degrees");
  bad             = patch("body.top", {6});
  bad.coordinates = shape::Coordinates::angle;
  says(box, bad, "Axis point");
  bad        = patch("body.top", {6});
  bad.smooth = {"roof"};
  says(box, bad, "one of the boundaries");
  bad.smooth = {"bottom"};
  says(box, bad, "meets the face");
  bad.smooth = {"top"};
  says(box, bad, "other than the shaped face");
  bad.smooth = {"left"};
  bad.degree = 1;
  says(box, bad, "at least 2");
  bad       = formulas<2>();
  bad.face  = "body.top";
  bad.modes = {{"angle", "0"}};
  says(box, bad, "must be angle");
  bad.modes = {{"t", "0"}};
  says(box, bad, "formula of x, y, s, angle, length");
  bad.modes = {{"x+y+s+angle+length", "0"}};
  says(box, bad, "at most 4");
  bad.face  = "";
  bad.modes = {{"s", "0"}};
  says(box, bad, "formula of x, y (");
}
} // namespace
} // namespace snug
