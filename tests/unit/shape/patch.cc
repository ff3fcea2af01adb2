#include <cmath>
#include <set>

#include "bodies.h"

namespace snug {
namespace {
using namespace test;

double bernstein_value(unsigned int n, unsigned int j, double s)
{
  double binomial = 1.;
  for (unsigned int i = 1; i <= j; ++i)
    binomial *= (n - i) / double(i);
  return binomial * std::pow(s, j) * std::pow(1. - s, n - 1 - j);
}

template <int dim>
dealii::Point<dim> fraction_of(const mesh::BodyMesh<dim> &mesh, unsigned int node)
{
  return mesh.geometry(1).box_fraction(mesh.logical_positions()[node]);
}

template <int dim>
bool is_free_node_of_foundation(const mesh::BodyMesh<dim> &mesh, unsigned int node)
{
  return mesh.body_of_node(node) == 1 && !mesh.is_hanging(node);
}

/// All heights 1 along (1.5, .., 2) / 2.5: the face moves as a whole and
/// the rest by its distance from the opposite face.
template <int dim>
void expect_unit_heights_lift_the_face(const std::string &basis, const std::string &face)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, shape_bodies<dim>(), 1);
  auto                      parameters = on_top<dim>(basis);
  parameters.face                      = "foundation." + face;
  parameters.direction                 = std::vector<double>(dim, 0.);
  parameters.direction[0]              = 1.5;
  parameters.direction[dim - 1]        = 2.;
  const shape::Shapes<dim> shapes(mesh, body_names(), {parameters});
  const auto               moved = shapes.apply(std::vector<double>(shapes.n_variables(), 1.));
  const unsigned int       f     = geometry::boundary_index(mesh.geometry(1), face);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
      if (mesh.is_hanging(node))
        continue;
      double expected = 0.;
      if (mesh.body_of_node(node) == 1)
        {
          const double fraction = fraction_of(mesh, node)[f / 2];
          expected              = f % 2 == 1 ? fraction : 1. - fraction;
        }
      EXPECT_NEAR(moved[node][0], 0.6 * expected, 1e-14);
      EXPECT_NEAR(moved[node][dim - 1], 0.8 * expected, 1e-14);
      EXPECT_NEAR(moved[node].norm(), expected, 1e-14);
    }
}

TEST(Patch, UnitHeightsLiftTheFaceByOneAndFadeLinearly)
{
  for (const std::string basis : {"Bezier patch", "B-spline patch"})
    {
      expect_unit_heights_lift_the_face<2>(basis, "top");
      expect_unit_heights_lift_the_face<2>(basis, "left");
      expect_unit_heights_lift_the_face<3>(basis, "top");
      expect_unit_heights_lift_the_face<3>(basis, "bottom");
      expect_unit_heights_lift_the_face<3>(basis, "back");
    }
}

TEST(Patch, ColumnsAreBernsteinPolynomialsFirstAxisFastest)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 2);
  const shape::Shapes<3>  shapes(mesh, body_names(), {on_top<3>("Bezier patch")});
  ASSERT_EQ(shapes.n_variables(), 20u);
  // A node of ghost cells alone may hang from nodes that this rank does not know.
  std::set<unsigned int> nodes;
  for (const auto &cell : mesh.cells())
    nodes.insert(cell.nodes.begin(), cell.nodes.end());
  for (unsigned int i = 0; i < 20; ++i)
    {
      const auto column = shapes.column(i);
      for (const unsigned int node : nodes)
        if (is_free_node_of_foundation(mesh, node))
          {
            const auto at = fraction_of(mesh, node);
            EXPECT_NEAR(column[node][2],
                        at[2] * bernstein_value(4, i % 4, at[0]) * bernstein_value(5, i / 4, at[1]),
                        1e-14);
          }
    }
}

TEST(Patch, BSplineOfOneSpanEqualsBezier)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 1);
  auto                    splines = on_top<3>("B-spline patch");
  splines.control_points          = {4, 4};
  splines.degree                  = 3;
  auto bezier                     = splines;
  bezier.basis                    = "Bezier patch";
  const auto alpha                = random_numbers(16, 5);
  const auto a                    = shape::Shapes<3>(mesh, body_names(), {splines}).apply(alpha);
  const auto b                    = shape::Shapes<3>(mesh, body_names(), {bezier}).apply(alpha);
  for (unsigned int node = 0; node < a.size(); ++node)
    EXPECT_NEAR((a[node] - b[node]).norm(), 0., 1e-15);
}

/// Quarter of a ring, its outer face of 6 chords or parabolas, or the true arc where it has
/// samples.
geometry::BodyMeshParameters quarter_ring(bool sampled)
{
  geometry::BodyMeshParameters ring;
  ring.source       = geometry::Source::ring;
  ring.inner_radius = 1.;
  ring.radius       = 2.;
  ring.part         = geometry::Part::quarter;
  ring.round_cells  = {6, 2};
  if (sampled)
    ring.sampled_boundaries = {"outer"};
  return ring;
}

/// The ends of the ring lie in the planes y = 0 and x = 0.
TEST(Patch, StaysInThePlanesThatTheFaceMeets)
{
  for (const std::string basis : {"Bezier patch", "B-spline patch", "node-wise"})
    for (const unsigned int degree : {1, 2})
      for (const bool sampled : {false, true})
        {
          const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {quarter_ring(sampled)}, degree);
          auto                    parameters = on_top<2>(basis, "ring");
          parameters.face                    = "ring.outer";
          parameters.interior                = shape::InteriorKind::Laplace;
          const shape::Shapes<2> shapes(mesh, {{"ring"}}, {parameters});
          const auto moved = shapes.apply(std::vector<double>(shapes.n_variables(), 0.1));
          for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
            for (unsigned int d = 0; d < 2; ++d)
              {
                const auto &x = mesh.reference_positions()[node];
                if (std::abs(x[d]) > 1e-9)
                  continue;
                EXPECT_NEAR(moved[node][d], 0., 1e-12) << basis << " at " << x;
                if (std::abs(x.norm() - 2.) < 1e-9)
                  {
                    EXPECT_NEAR(moved[node].norm(), 0.1, 1e-12) << basis << " at " << x;
                  }
              }
        }
}

/// A wedge's slope of 45 degrees is no symmetry plane of its top.
TEST(Patch, LeavesPlanesThatNormalsLeanOn)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, plain_cube<2>(4), 1);
  auto                    parameters = on_top<2>("B-spline patch", "cube");
  parameters.direction               = {0.1, 1.};
  const shape::Shapes<2> shapes(mesh, {{"cube"}}, {parameters});
  const auto             moved = shapes.apply(std::vector<double>(shapes.n_variables(), 1.));
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.reference_positions()[node][1] == 1.)
      {
        EXPECT_NEAR(moved[node][0] / moved[node][1], 0.1, 1e-14); // given: kept
      }
}

/// Control points of a patch stand where the face is: on the arc, or on its chords.
TEST(Patch, ControlPointsLieOnTheFace)
{
  for (const unsigned int degree : {1, 2})
    for (const bool sampled : {false, true})
      {
        const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {quarter_ring(sampled)}, degree);
        auto                    parameters = on_top<2>("B-spline patch", "ring");
        parameters.face                    = "ring.outer";
        parameters.interior                = shape::InteriorKind::Laplace;
        const shape::Shapes<2>    shapes(mesh, {{"ring"}}, {parameters});
        const std::vector<double> heights(shapes.n_variables(), 0.1);
        const double sagitta = sampled ? 1e-7 : degree == 1 ? 0.018 : 2e-4; // of 15 degrees
        const auto   at_rest = shapes.control_points(std::vector<double>(heights.size(), 0.));
        const auto   moved   = shapes.control_points(heights);
        for (unsigned int i = 0; i < moved.size(); ++i)
          {
            EXPECT_NEAR(at_rest[i].position.norm(), 2., sagitta) << degree << sampled;
            EXPECT_NEAR(moved[i].position.norm(), 2.1, sagitta + 1e-3) << degree << sampled;
            EXPECT_NEAR(moved[i].move.norm(), 0.1, 1e-12);
          }
        EXPECT_NEAR(at_rest.front().position[0], 0., 1e-9);
        EXPECT_NEAR(at_rest.back().position[0], 2., 1e-9);
      }
}

/// The point of the body that is exported with a control point is where a node of the moved mesh is
/// that has the same place: between these points the net is off the face.
TEST(Patch, PointsOfTheBodyLieOnTheMovedFace)
{
  auto bodies            = plain_cube<2>(4); // nodes at the places of five control points
  bodies[0].curved_faces = {{"top", "cylinder z 2 at 0"}};
  const mesh::BodyMesh<2> mesh(MPI_COMM_SELF, bodies, 1);
  auto                    patch = on_top<2>("Bezier patch", "cube");
  patch.name                    = "first";
  auto mirrored                 = patch;
  mirrored.name                 = "second";
  mirrored.basis                = "Bezier box";
  mirrored.face                 = "";
  mirrored.bodies               = {"cube"};
  mirrored.box_size             = {1., 1.};
  mirrored.box_corner           = {0., 0.};
  mirrored.direction            = {0., 1.};
  mirrored.control_points       = {5, 2};
  mirrored.symmetry             = {{"x", 0.5}};
  for (const auto &[shape, n_variables] : {std::make_pair(patch, 5u), std::make_pair(mirrored, 6u)})
    {
      const shape::Shapes<2> shapes(mesh, {{"cube"}}, {shape});
      ASSERT_EQ(shapes.n_variables(), n_variables);
      const auto   design  = random_numbers(n_variables, 3);
      const auto   moves   = shapes.apply(design);
      const auto   points  = shapes.control_points(design);
      unsigned int n_found = 0;
      for (const auto &point : points)
        {
          const double x = point.index % 5 / 4.;
          ASSERT_EQ(point.variables.size(), 1u);
          for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
            {
              const auto &logical = mesh.logical_positions()[node];
              // the box ends at the corner of the face, where it is highest
              const bool on_top = shape.basis == "Bezier patch"
                                    ? logical[1] == 1.
                                    : x == 0. && point.index >= 5 && logical[1] == 1.;
              if (!on_top || std::abs(logical[0] - x) > 1e-12)
                continue;
              const auto at = mesh.reference_positions()[node] + moves[node];
              EXPECT_NEAR((point.on_body - at).norm(), 0., 1e-12) << point.index;
              ++n_found;
              if (x > 0. && x < 1.)
                {
                  EXPECT_GT((point.position - at).norm(), 1e-3);
                }
            }
        }
      EXPECT_EQ(n_found, shape.basis == "Bezier patch" ? 5u : 1u);
    }
  // both together: variables are counted through
  const auto points = shape::Shapes<2>(mesh, {{"cube"}}, {patch, mirrored})
                        .control_points(std::vector<double>(11, 0.1));
  ASSERT_EQ(points.size(), 15u);
  const auto first = std::make_pair(points[3].variables[0], points[8].variables[0]);
  EXPECT_EQ(first.first, std::make_pair(3u, 1.));
  EXPECT_EQ(first.second, std::make_pair(5u + 1u, 1.)); // the image of control point 1
}

/// A cylinder's side: its nodes move along the radius.
TEST(Patch, FollowsTheNormalsOfACurvedFace)
{
  auto bodies            = plain_cube<3>(8);
  bodies[0].size         = {2., 1., 1.};
  bodies[0].curved_faces = {{"top", "cylinder y 2"}};
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, bodies, 2);
  auto                    parameters = on_top<3>("Bezier patch", "cube");
  const shape::Shapes<3>  shapes(mesh, {{"cube"}}, {parameters});
  const auto              moved     = shapes.apply(std::vector<double>(shapes.n_variables(), 0.1));
  unsigned int            n_checked = 0;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.logical_positions()[node][2] == 1.)
      {
        // the axis is at x = 1, z = 1 - 2
        auto radius = mesh.reference_positions()[node];
        radius[0] -= 1.;
        radius[1] = 0.;
        radius[2] += 1.;
        EXPECT_NEAR(moved[node].norm(), 0.1, 1e-14);
        // normals at the ends of parabolas: second order in h/R = 1/8
        EXPECT_NEAR((moved[node] - 0.1 * radius / radius.norm()).norm(), 0., 4e-3 * 0.1);
        ++n_checked;
      }
  EXPECT_GT(dealii::Utilities::MPI::sum(n_checked, MPI_COMM_WORLD), 288u);
}

TEST(Patch, ControlPointsStandAtGrevilleAbscissae)
{
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, shape_bodies<3>(), 1);
  const shape::Shapes<3>  shapes(mesh, body_names(), {on_top<3>("Bezier patch")});
  std::vector<double>     alpha(20, 0.);
  alpha[9]          = 0.25;
  const auto points = shapes.control_points(alpha);
  ASSERT_EQ(points.size(), 20u);
  const auto expect_at = [&](unsigned int i, const dealii::Point<3> &at) {
    EXPECT_EQ(points[i].index, i);
    EXPECT_NEAR(points[i].position.distance(at), 0., 1e-14);
  };
  expect_at(0, {-1., -1., 1.});
  expect_at(3, {1., -1., 1.});
  // 9 = 1 + 4 * 2: s = 1/3, t = 1/2
  expect_at(9, {-1. / 3, 0., 1.25});
  expect_at(19, {1., 1., 1.});
  EXPECT_NEAR(points[9].move[2], 0.25, 1e-14);
  EXPECT_EQ(points[6].move.norm(), 0.);
}

TEST(Patch, RejectsFacesThatLieAboveThemselves)
{
  // An arc whose normals lean by up to 65 degrees from its middle: turned by 40 degrees one end
  // looks back along the axis across the patch.
  const auto make = [](const std::string &degrees) {
    auto bodies            = plain_cube<2>(8);
    bodies[0].size         = {2., 2.};
    bodies[0].curved_faces = {{"top", "cylinder z 1.1"}};
    bodies[0].rotate       = {{"z", degrees}};
    const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, bodies, 1);
    auto                    parameters = on_top<2>("Bezier patch", "block");
    parameters.interior                = shape::InteriorKind::Laplace;
    parameters.coordinates             = shape::Coordinates::projection;
    shape::Shapes<2>(mesh, {{"block"}}, {parameters});
  };
  EXPECT_NO_THROW(make("0"));
  EXPECT_NO_THROW(make("20"));
  EXPECT_THROW(make("40"), InputError);
}

TEST(Patch, RejectsBadEntriesByName)
{
  auto good = on_top<3>("B-spline patch");
  EXPECT_EQ(failure_reason<3>(good), "");
  const auto expect = [&](const std::string &entry, const std::string &says,
                          void (*spoil)(shape::ShapeParameters &)) {
    auto bad = good;
    spoil(bad);
    expect_complaint<3>(bad, entry, says);
  };
  using P = shape::ShapeParameters;
  expect("Face", "punch, foundation", [](P &p) { p.face = "anvil.top"; });
  expect("Face", "left, right", [](P &p) { p.face = "foundation.roof"; });
  expect("Face", "body.face", [](P &p) { p.face = "foundation"; });
  expect("Face", "body.face", [](P &p) { p.face = ""; });
  expect("Control points", "2 numbers", [](P &p) { p.control_points = {3}; });
  expect("Control points", "at least one more than 'Degree'",
         [](P &p) { p.control_points = {3, 2}; });
  expect("Control points", "50", [](P &p) {
    p.basis          = "Bezier patch";
    p.control_points = {3, 51};
  });
  expect("Direction", "not all zero", [](P &p) { p.direction = {0., 0., 0.}; });
  expect("Direction", "3 numbers", [](P &p) { p.direction = {0., 1.}; });
  expect("Direction", "numbers", [](P &p) { p.direction = {0., 1., NAN}; });
}

TEST(NoBasis, HasNoVariables)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, shape_bodies<2>(), 1);
  const shape::Shapes<2>  none(mesh, body_names(), {{}});
  EXPECT_EQ(none.n_variables(), 0u);
  const auto moved = none.apply({});
  EXPECT_EQ(moved.size(), mesh.n_local_nodes());
  for (const auto &value : moved)
    EXPECT_EQ(value.norm(), 0.);
  EXPECT_TRUE(none.transpose(moved).empty());
}
} // namespace
} // namespace snug
