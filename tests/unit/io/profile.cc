#include <snug/io/profile.h>
#include <snug/mesh/lagrange.h>

#include <gtest/gtest.h>

#include <cmath>

#include "boxes.h"
#include "scratch.h"

namespace snug {
namespace {
/// The profile as one map from column to text per row.
std::vector<std::map<std::string, std::string>> read_profile(const std::string &text)
{
  const auto                                      table = test::read_csv(text);
  std::vector<std::map<std::string, std::string>> rows;
  for (unsigned int i = 1; i < table.size(); ++i)
    {
      rows.emplace_back();
      for (unsigned int c = 0; c < table[0].size(); ++c)
        rows.back()[table[0][c]] = c < table[i].size() ? table[i][c] : "";
    }
  return rows;
}

double number(const std::map<std::string, std::string> &row, const std::string &column)
{
  return std::stod(row.at(column));
}

std::string face_name(const unsigned int body, const unsigned int boundary)
{
  return std::to_string(body) + "." + std::to_string(boundary);
}

unsigned int node_number(const unsigned int node)
{
  return 10 * node;
}

TEST(Profile, RunsWithTheBodyOnItsLeft)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, test::two_boxes<2>(true), 2);
  const unsigned int      top = geometry::boundary_index(mesh.geometry(1), "top");
  const mesh::Surface<2>  surface(mesh, {{1, top}});
  auto                    positions = surface.gather(mesh.reference_positions());
  for (auto &x : positions)
    x[1] -= 0.1 * x[0] * x[0]; // highest at x = 0
  const auto rows = read_profile(io::profile_text(surface, positions, 2, {face_name, node_number}));
  // cells of size 1/4, 1/4, 1/2 with two steps each
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(number(rows.front(), "x"), 1.);
  EXPECT_EQ(number(rows.back(), "x"), 0.);
  for (const auto &row : rows)
    {
      const double x = number(row, "x"), drop = 0.1 * x * x;
      EXPECT_EQ(row.at("face"), face_name(1, top));
      EXPECT_NEAR(number(row, "arc_length"), 1. - x, 1e-9);
      EXPECT_NEAR(number(row, "y"), 2. - drop, 1e-9);
      EXPECT_NEAR(number(row, "reference_y"), 2., 1e-9);
      // Samples of a flat face are the interpolation of its nodes.
      EXPECT_EQ(number(row, "deviation"), 0.);
      EXPECT_NEAR(number(row, "move"), -drop, 1e-9);
      EXPECT_NEAR(number(row, "normal_y"), 1., 1e-9);
      EXPECT_NEAR(number(row, "reference_drop"), 0., 1e-9);
      EXPECT_NEAR(number(row, "drop"), drop, 1e-9);
    }
}

TEST(Profile, OppositeSidesAreTwoPieces)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, test::two_boxes<2>(false), 1);
  const auto              index = [&](const std::string &face) {
    return geometry::boundary_index(mesh.geometry(1), face);
  };
  const mesh::Surface<2> surface(mesh, {{1, index("bottom")}, {1, index("top")}});
  const auto             positions = surface.gather(mesh.reference_positions());
  const auto rows = read_profile(io::profile_text(surface, positions, 1, {face_name, node_number}));
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.front().at("piece"), "0");
  EXPECT_EQ(rows.back().at("piece"), "1");
  for (const auto &row : rows)
    {
      EXPECT_EQ(number(row, "normal_y"), row.at("face") == face_name(1, index("top")) ? 1. : -1.);
      EXPECT_NEAR(number(row, "drop"), 0., 1e-9);
    }
}

/// The normals of a whole ring cancel, so it has no highest point.
TEST(Profile, ARingIsClosedAndHasNoDrop)
{
  geometry::BodyMeshParameters ring;
  ring.source       = geometry::Source::ring;
  ring.radius       = 2.;
  ring.inner_radius = 1.;
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {ring}, 1);
  const mesh::Surface<2>  surface(mesh, {{0, geometry::boundary_index(mesh.geometry(0), "outer")}});
  auto                    positions = surface.gather(mesh.reference_positions());
  for (auto &x : positions)
    x *= 1.01;
  const auto rows = read_profile(io::profile_text(surface, positions, 1, {face_name, node_number}));
  ASSERT_GT(rows.size(), 2u);
  EXPECT_EQ(rows.front().at("x"), rows.back().at("x"));
  EXPECT_EQ(rows.front().at("y"), rows.back().at("y"));
  // the perimeter of the polygon of n sides
  const double n = rows.size() - 1;
  EXPECT_NEAR(number(rows.back(), "arc_length"), 4. * n * std::sin(M_PI / n), 1e-7);
  for (const auto &row : rows)
    {
      EXPECT_NEAR(number(row, "move"), 0.02, 1e-9);
      EXPECT_EQ(row.at("drop"), "");
    }
}

/// The half x > 0 of an arch, whose mean normal is that of the whole arch at a plane of symmetry.
TEST(Profile, TheDropOfAHalfIsThatOfTheWhole)
{
  auto bodies    = test::two_boxes<2>(true);
  bodies[1].warp = {"0", "-0.1*x^2"};
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, bodies, 1);
  const mesh::Surface<2>  surface(mesh, {{1, geometry::boundary_index(mesh.geometry(1), "top")}});
  const auto              positions = surface.gather(mesh.reference_positions());
  dealii::Tensor<1, 2>    along_x;
  along_x[0] = -1.;
  for (const unsigned int body : {0, 1})
    {
      const std::vector<state::SymmetryPlane<2>> planes = {{body, along_x, {0., 1.}}};
      const auto                                 rows =
        read_profile(io::profile_text(surface, positions, 1, {face_name, node_number, planes}));
      double largest = 0.;
      for (const auto &row : rows)
        largest =
          std::max(largest, std::abs(number(row, "drop") - 0.1 * std::pow(number(row, "x"), 2)));
      EXPECT_EQ(largest < 1e-9, body == 1) << largest;
    }
}

/// The true surface of a circle is r (1 - cos(a / 2)) off its chords of the angle a.
TEST(Profile, TheDeviationIsThatOfTheChords)
{
  geometry::BodyMeshParameters ring;
  ring.source             = geometry::Source::ring;
  ring.radius             = 2.;
  ring.inner_radius       = 1.;
  ring.sampled_boundaries = {"outer"};
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {ring}, 1);
  const mesh::Surface<2>  surface(mesh, {{0, geometry::boundary_index(mesh.geometry(0), "outer")}});
  const auto              positions = surface.gather(mesh.reference_positions());
  const auto rows = read_profile(io::profile_text(surface, positions, 1, {face_name, node_number}));
  ASSERT_GT(rows.size(), 2u);
  // The middle of a face is among the samples, because their degree is even.
  static_assert(mesh::surface_degree % 2 == 0);
  const double n = rows.size() - 1;
  for (const auto &row : rows)
    EXPECT_NEAR(number(row, "deviation"), 2. * (1. - std::cos(M_PI / n)), 1e-9);
}

/// A crowned half roller of radius 2 on a block, |x| < 1.6 and |y| < 1, or its half or quarter,
/// with faces whose samples alone are at the top if the number of cells is odd. Rows run along x
/// first.
std::vector<std::map<std::string, std::string>> roller_rows(const std::array<double, 2>     &lower,
                                                            const std::vector<unsigned int> &cells)
{
  geometry::BodyMeshParameters body;
  body.complete(3);
  body.corner             = {1.6 * lower[0], lower[1], -2.};
  body.size               = {1.6 * (1. - lower[0]), 1. - lower[1], 2.};
  body.cells              = {cells[0], cells[1], 1};
  body.warp               = {"0", "0", "(z+2)/2*(sqrt(4-y^2)-2-0.01*x^2)"};
  body.sampled_boundaries = {"top"};
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, {body}, 1);
  const mesh::Surface<3>  surface(mesh, {{0, geometry::boundary_index(mesh.geometry(0), "top")}});
  auto                    positions = surface.gather(mesh.reference_positions());
  for (auto &x : positions)
    x[2] -= 0.02 * x[0] * x[0];
  std::vector<state::SymmetryPlane<3>> planes;
  for (unsigned int d = 0; d < 2; ++d)
    if (lower[d] == 0.)
      {
        dealii::Tensor<1, 3> normal;
        normal[d] = -1.;
        planes.push_back({0, normal, {}});
      }
  const auto place = [&](const io::SurfacePiece &, const unsigned int node) {
    const auto &x = surface.reference_positions()[node];
    return std::array<unsigned int, 2>{
      {static_cast<unsigned int>(1e3 * (x[0] + 2.)), static_cast<unsigned int>(1e3 * (x[1] + 2.))}};
  };
  return read_profile(
    io::profile_text(surface, positions, 1, {face_name, node_number, planes, place}));
}

/// The drop is that of the true surface: the highest point of an odd number of cells lies within a
/// face, above all nodes.
TEST(Profile, HalfQuarterAndFullRollersHaveTheSameDrops)
{
  for (const auto &[lower, cells] :
       std::vector<std::pair<std::array<double, 2>, std::vector<unsigned int>>>{
         {{-1., -1.}, {5, 7}}, {{-1., 0.}, {7, 4}}, {{0., -1.}, {3, 5}}, {{0., 0.}, {4, 3}}})
    {
      const auto rows = roller_rows(lower, cells);
      ASSERT_EQ(rows.size(), (cells[0] + 1) * (cells[1] + 1));
      for (unsigned int k = 0; k < rows.size(); ++k)
        {
          const double x = number(rows[k], "x"), y = number(rows[k], "y");
          const double of_circle = 2. - std::sqrt(4. - y * y);
          EXPECT_NEAR(number(rows[k], "reference_drop"), of_circle + 0.01 * x * x, 1e-9);
          EXPECT_NEAR(number(rows[k], "drop"), of_circle + 0.03 * x * x, 1e-9);
          if (k > 0)
            {
              const double before = number(rows[k - 1], "x");
              EXPECT_TRUE(before < x - 1e-6 ||
                          (std::abs(before - x) < 1e-6 && number(rows[k - 1], "y") < y));
            }
        }
    }
}

/// Numbers have 9 digits, and round-off is 0 without a sign.
TEST(Profile, RoundOffIsZero)
{
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, test::two_boxes<2>(false), 1);
  const mesh::Surface<2>  surface(mesh, {{1, geometry::boundary_index(mesh.geometry(1), "top")}});
  auto                    positions = surface.gather(mesh.reference_positions());
  for (auto &x : positions)
    {
      x[0] -= 1e-14;
      x[1] -= 1. / 3.;
    }
  const auto rows = read_profile(io::profile_text(surface, positions, 1, {face_name, node_number}));
  for (const auto &row : rows)
    {
      EXPECT_EQ(row.at("move"), "-0.333333333");
      EXPECT_EQ(row.at("drop"), "0");
      EXPECT_EQ(row.at("normal_x"), "0");
    }
  EXPECT_EQ(rows.back().at("x"), "0");
}

TEST(Profile, SolidFacesHaveOneRowPerNode)
{
  for (const unsigned int degree : {1, 2})
    {
      const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, test::two_boxes<3>(true), degree);
      const unsigned int      left = geometry::boundary_index(mesh.geometry(1), "left");
      const mesh::Surface<3>  surface(mesh, {{1, left}});
      auto                    positions = surface.gather(mesh.reference_positions());
      for (auto &x : positions)
        x[0] += 0.1 * x[1]; // into the body, highest at y = 0
      const auto rows =
        read_profile(io::profile_text(surface, positions, degree, {face_name, node_number}));
      EXPECT_EQ(rows.size(), surface.n_nodes());
      for (unsigned int node = 0; node < rows.size(); ++node)
        EXPECT_EQ(number(rows[node], "node"), 10. * node);
      for (const auto &row : rows)
        {
          EXPECT_EQ(row.count("arc_length"), 0u);
          EXPECT_NEAR(number(row, "normal_x"), -1., 1e-9);
          EXPECT_NEAR(number(row, "move"), -0.1 * number(row, "y"), 1e-9);
          EXPECT_NEAR(number(row, "drop"), 0.1 * number(row, "y"), 1e-9);
        }
    }
}
} // namespace
} // namespace snug
