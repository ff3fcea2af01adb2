#include <gtest/gtest.h>

#include "error_checks.h"

using namespace snug;

TEST(Errors, LoadCases)
{
  const std::vector<std::string> two = {"Load cases=closing, opening"};
  const std::string              own = "Load case closing/";
  EXPECT_EQ(error_of(two), "");
  expect_error({"Load cases", "a, a", "'a' must not occur twice"});
  expect_error({"Load cases", "a/b", "letters, digits"});
  EXPECT_TRUE(
    has(error_of({"Load case closing/Weight=1"}), "unknown subsection 'Load case closing'"));
  expect_error({own + "Weight", "-1", "must be at least 0"}, two);
  expect_error({own + "Gravity", "1, 2", "must have 3 numbers"}, two);
  expect_error({own + "Pressure", "top: 1", "'body.boundary'"}, two);
  expect_error({own + "Pressure", "punch.topp: 1", "did you mean 'top'?"}, two);
  expect_error({own + "Traction", "punch.top: 1 2", "3 components"}, two);
  // what a body holds already
  expect_error({own + "Displacement", "punch.left: x = 1", "held twice"}, two);
  expect_error(
    {"Optimization/Constraints", "strain energy: 1",
     "its load case or a combination: 'closing.strain energy' or 'worst of strain energy'"},
    two);
  expect_error({"Optimization/Constraints", "closing.beauty: 1", "'beauty' is not a response"},
               two);
  expect_error({"Optimization/Combine", "best", "sum, mean, worst, range"}, two);
  EXPECT_EQ(error_of({"Load cases=closing, opening",
                      "Optimization/Constraints=closing.strain energy: "
                      "initial, volume: initial"}),
            "");
}

namespace {
/// A box of two regions, each with its material.
const std::string two_regions = R"(
set Dimension = 2
set Bodies    = bar
set Materials = steel, rubber
subsection Body bar
  set Box cells       = 2, 1
  set Region formulas = core: x - 0.5
  set Materials       = core: rubber, body: steel
end
)";

} // namespace

TEST(Errors, MaterialsAreInTheirRanges)
{
  const auto says = [&](const std::string &set, const std::string &part) {
    const auto message = error_of({set}, two_regions);
    EXPECT_TRUE(has(message, "--set: entry '" + set.substr(0, set.find('=')))) << message;
    EXPECT_TRUE(has(message, part)) << message;
  };
  EXPECT_EQ(error_of({}, two_regions), "");
  expect_error({"Materials", "a, a", "'a' must not occur twice"});
  says("Material steel/Young's modulus=0", "must be positive");
  says("Material rubber/Poisson's ratio=0.5", "below 0.5");
  says("Material rubber/Density=-1", "must be at least 0");
  EXPECT_TRUE(has(error_of({"Material tin/Density=1"}, two_regions), "unknown subsection"));
}

TEST(Errors, RegionsHaveOneMaterial)
{
  const auto says = [&](const std::string &materials, const std::string &part) {
    const auto message = error_of({"Body bar/Materials=" + materials}, two_regions);
    EXPECT_TRUE(has(message, "--set: entry 'Body bar/Materials'")) << message;
    EXPECT_TRUE(has(message, part)) << message;
  };
  says("stele", "not one of the 'Materials' of the scene, steel, rubber; did you");
  says("core: steel", "the region 'body' has no material");
  says("core: steel, boddy: steel", "did you mean 'body'?");
  says("core: steel, core: rubber", "different regions");
  EXPECT_EQ(error_of({"Body bar/Materials=steel"}, two_regions), "");
  EXPECT_TRUE(has(error_of({"Body bar/Region formulas=core: x - 50"}, two_regions),
                  "the region 'core' has no cells"));
  EXPECT_TRUE(
    has(error_of({"Body bar/Region formulas=core: t"}, two_regions), "'Body bar/Region formulas'"));
  for (const std::string set : {"Density=1", "Young's modulus=2", "Poisson's ratio=0.2"})
    EXPECT_TRUE(has(error_of({"Body bar/" + set}, two_regions), "must be left out")) << set;
}

TEST(Errors, ModelsFitTheDimension)
{
  expect_error({"Model", "plane strain", "must be solid for Dimension = 3"});
  expect_error({"Model", "2D", "one of auto, solid, plane strain"});
  expect_error({"Thickness", "0", "must be positive"});
  expect_error({"Thickness", "nan", "must be a number"});
  expect_error({"Thickness", "2", "left out for Model = solid"});
  expect_error({"Body punch/Formulation", "b-bar", "standard, B-bar"});
}

TEST(Errors, SectionsFitTheirModel)
{
  const std::string text    = R"(
set Dimension = 2
set Bodies    = disc
subsection Body disc
  set Box cells   = 2, 2
  set Box corner  = -1, 0
  set Formulation = B-bar
end
)";
  const auto        message = [&text](const std::string &model) {
    return error_of({"Model=" + model}, text);
  };
  EXPECT_TRUE(has(message("solid"), "Dimension = 2")) << message("solid");
  EXPECT_TRUE(has(message("plane stress"), "'Body disc/Formulation' = 'B-bar'"))
    << message("plane stress");
  EXPECT_TRUE(has(message("axisymmetric"), "'Body disc/Box corner' = '-1, 0'"))
    << message("axisymmetric");
  EXPECT_EQ(message("plane strain"), "");
  const auto shifted =
    error_of({"Model=axisymmetric", "Body disc/Box corner=0, 0", "Body disc/Shift=-1, 0"}, text);
  EXPECT_TRUE(has(shifted, "entry 'Body disc/Shift' = '-1, 0'")) << shifted;
  EXPECT_EQ(shifted.find("entry '"), shifted.rfind("entry '")) << shifted;
  EXPECT_TRUE(
    has(error_of({"Model=axisymmetric", "Body disc/Box corner=0, 0", "Thickness=0.5"}, text),
        "left out for Model = axisymmetric"));
}
