#include <gtest/gtest.h>

#include "error_checks.h"

using namespace snug;

namespace {
const std::vector<std::string> tip = {"Responses=tip", "Response tip/Quantity=displacement",
                                      "Response tip/Component=z", "Response tip/Point=0, 0, 0"};

std::vector<std::string> named(const std::string &quantity)
{
  return {"Responses=it", "Response it/Quantity=" + quantity};
}
} // namespace

TEST(ResponseErrors, Names)
{
  EXPECT_EQ(error_of(tip), "");
  expect_error({"Responses", "a, a", "'a' must not occur twice"});
  expect_error({"Responses", "volume", "must not be the name of a quantity"});
  EXPECT_TRUE(has(error_of({"Response tip/Exponent=2"}), "unknown subsection 'Response tip'"));
  expect_error({"Response tip/Quantity", "displacment", "did you mean"}, tip);
  expect_error({"Optimization/Objective", "beauty", "potential energy, "});
  expect_error({"Optimization/Objective", "tpi", "did you mean 'tip'?"}, tip);
}

TEST(ResponseErrors, Places)
{
  expect_error({"Response tip/Point", "", "either 'Point' or 'Face'"}, tip);
  expect_error({"Response tip/Point", "0, 0", "must have 3 numbers"}, tip);
  expect_error({"Response tip/Component", "normal", "x, y or z with 'Point'"}, tip);
  expect_error({"Response tip/Component", "w", "normal, x, y, z"}, tip);
  expect_error({"Response tip/Body", "hammer", "no body 'hammer'"}, tip);
  expect_error({"Response it/Face", "punch.topp", "did you mean"}, named("displacement"));
  auto on_face = named("displacement");
  on_face.push_back("Response it/Face=punch.top");
  EXPECT_EQ(error_of(on_face), "");
  expect_error({"Response it/Body", "punch", "left out with 'Face'"}, on_face);
  expect_error({"Optimization/Objective", "displacement", "needs a subsection Response"});
}

TEST(ResponseErrors, PairsAndNumbers)
{
  for (const std::string quantity :
       {"contact force", "contact area", "pressure norm", "peak pressure"})
    {
      expect_error({"Response it/Pair", "punch.top: x.y", "no such pair"}, named(quantity));
      expect_error({"Response it/Body", "punch", "must be left out"}, named(quantity));
      auto sides = named(quantity);
      sides.push_back("Response it/Pair=foundation.top: punch.bottom");
      EXPECT_EQ(error_of(sides), "");
    }
  expect_error({"Response it/Exponent", "0.99", "between 1 and 1000"}, named("von Mises norm"));
  expect_error({"Response it/Smoothing", "0", "above 0"}, named("contact area"));
  expect_error({"Response it/Exponent", "2", "must be left out"}, named("contact area"));
  // nothing to measure
  expect_error({"Optimization/Objective", "peak pressure", "no contact"}, {"Contact/Pairs="});
}

TEST(ResponseErrors, Constraints)
{
  const std::string path = "Optimization/Constraints";
  EXPECT_EQ(error_of({path + "=volume: = initial, mass: <= 0.9 initial, peak "
                             "pressure: <= 200, volume: >= 3",
                      "Body punch/Density=1"}),
            "");
  expect_error({path, "weight: initial", "volume"});
  expect_error({path, "volume: same", "<= 120"});
  expect_error({path, "volume: nan", "<= 120"});
  expect_error({path, "volume: < 3", "<= 120"});
  expect_error({path, "potential energy: 1", "already"});
  expect_error({path, "volume: initial", "MMA takes no equalities"},
               {"Optimization/Algorithm=MMA"});
  EXPECT_EQ(error_of({"Optimization/Algorithm=MMA", path + "=volume: <= initial"}), "");
}
