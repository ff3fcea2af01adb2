#include <snug/state/symmetry_planes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace snug;

/// Warnings of a box on [0, 1]^dim whose bottom is curved and meets an obstacle.
template <int dim>
struct Half
{
  std::string                         curve;
  std::vector<supports::Support<dim>> supports;
  bool                                is_axisymmetric = false;
  std::string                         rotate          = {};

  std::vector<std::string> warnings() const
  {
    geometry::BodyMeshParameters box;
    box.cells = std::vector<unsigned int>(dim, 2);
    if (!curve.empty())
      box.curved_faces = {{"bottom", curve}};
    if (!rotate.empty())
      box.rotate = {{"z", rotate}};
    auto model = mesh::Idealization::natural(dim);
    if (is_axisymmetric)
      model.kind = mesh::Idealization::Kind::axisymmetric;
    const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, {box}, 1, model);
    contact::Pair             pair;
    pair.slave      = {0, 2 * dim - 2};
    pair.slave_name = "punch.bottom";
    pair.obstacle.emplace();
    return state::symmetry_warnings(mesh, supports, {pair});
  }
};

template <int dim>
supports::Support<dim> held(const unsigned int boundary, const unsigned int component)
{
  return {0, boundary, component, {{}}, "", boundary == 0 ? "punch.left" : "punch.other"};
}

std::string only(const std::vector<std::string> &lines)
{
  return lines.size() == 1 ? lines[0] : std::to_string(lines.size()) + " lines";
}

/// "78.5" for the angle between the tangent of a circle and a vertical line.
bool names_angle(const std::string &line, const double sine)
{
  std::ostringstream angle;
  angle.precision(3);
  angle << "at " << std::acos(sine) * 180. / M_PI << " degrees";
  return line.find(angle.str()) != std::string::npos;
}
} // namespace

TEST(SymmetryPlanes, AnApexBesideThemIsNamed)
{
  // the apex at 0.5 is 0.5 off the plane x = 0
  const auto line = only(Half<2>{"cylinder z 2", {held<2>(0, 0)}}.warnings());
  EXPECT_NE(line.find("'punch.bottom' meets 'punch.left'"), std::string::npos) << line;
  EXPECT_TRUE(names_angle(line, 0.25)) << line;
  EXPECT_NE(line.find("'Curved faces'"), std::string::npos) << line;
  EXPECT_TRUE(names_angle(only(Half<3>{"sphere 4", {held<3>(0, 0)}}.warnings()), 0.125));
  EXPECT_TRUE(names_angle(only(Half<3>{"cylinder y -4", {held<3>(0, 3)}}.warnings()), 0.125));
  EXPECT_TRUE(
    names_angle(only(Half<2>{"cylinder z 2", {held<2>(0, 2)}, false, "20"}.warnings()), 0.25));
  // front and left of a sphere
  EXPECT_EQ((Half<3>{"sphere 4", {held<3>(0, 0), held<3>(2, 1)}}.warnings().size()), 2u);
  // the axis is one
  EXPECT_TRUE(names_angle(only(Half<2>{"sphere 2", {}, true}.warnings()), 0.25));
}

TEST(SymmetryPlanes, OtherScenesHaveNoWarning)
{
  const auto none = [](const auto &scene) { return scene.warnings().empty(); };
  EXPECT_TRUE(none(Half<2>{"cylinder z 2 at 0", {held<2>(0, 0)}}));
  EXPECT_TRUE(none(Half<2>{"sphere 2 at 0", {}, true}));
  EXPECT_TRUE(none(Half<3>{"sphere 4 at 0, 0", {held<3>(0, 0), held<3>(2, 1)}}));
  EXPECT_TRUE(none(Half<3>{"cylinder y 4 at 0", {held<3>(0, 0), held<3>(2, 1)}}));
  EXPECT_TRUE(none(Half<3>{"cylinder y 4 at 0", {held<3>(0, 3)}}));
  EXPECT_TRUE(none(Half<2>{"", {held<2>(0, 0)}}));                            // plane
  EXPECT_TRUE(none(Half<2>{"cylinder z 2", {held<2>(0, 1)}}));                // along the plane
  EXPECT_TRUE(none(Half<2>{"cylinder z 2", {held<2>(0, 0), held<2>(0, 1)}})); // clamped
  EXPECT_TRUE(none(Half<2>{"cylinder z 2", {held<2>(0, 0), held<2>(1, 0)}})); // confined
  EXPECT_TRUE(none(Half<2>{"cylinder z 2", {held<2>(3, 1)}}));                // does not meet it
  auto moved      = held<2>(0, 0);
  moved.values[0] = [](const dealii::Point<2> &) { return 0.1; };
  EXPECT_TRUE(none(Half<2>{"cylinder z 2", {moved}}));
}
