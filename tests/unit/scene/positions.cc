#include <snug/scene/cases.h>
#include <snug/scene/read_scene.h>

#include <gtest/gtest.h>

#include "error_checks.h"

/// Load cases with Cases and Position: what they become, and what is wrong in them.
namespace {
using namespace snug;

const std::vector<std::string> closing = {"Load cases=closing"};
const std::string              own     = "Load case closing/";

TEST(Positions, MotionsMustBeRight)
{
  const std::string entry = own + "Position";
  expect_error({entry, "punsh: shift 0 0 1", "there is no body or obstacle 'punsh'"}, closing);
  expect_error({entry, "punch: turn z 3", "'turn' is neither 'rotate' nor 'shift'"}, closing);
  expect_error({entry, "punch: rotate w 3", "'rotate' needs an axis"}, closing);
  expect_error({entry, "punch: rotate z", "'rotate' needs an axis"}, closing);
  expect_error({entry, "punch: rotate z 3 around 0 0 0", "'around' is not 'about'"}, closing);
  expect_error({entry, "punch: rotate z 3 about 0 0", "3 numbers after 'about'"}, closing);
  expect_error({entry, "punch: shift 0 1", "3 numbers after 'shift'"}, closing);
  expect_error({entry, "punch: shift 0 1 x", "motion of 'punch'"}, closing);
  expect_error({entry, "punch:", "must be a list"}, closing);
  expect_error({entry, "punch: shift 0 0 1; punch: shift 0 0 2", "occurs twice"}, closing);
  expect_error({own + "Loads in space", "perhaps", "true"}, closing);
}

TEST(Positions, CasesMustBeANumber)
{
  for (const auto *wrong : {"0", "-3", "many", "2.5", "100000"})
    expect_error({own + "Cases", wrong, "between 1 and 1000"}, closing);
}

TEST(Positions, ErrorsNameTheCase)
{
  auto cases = closing;
  cases.push_back(own + "Cases=9");
  const auto error = [&](const std::string &set) {
    auto sets = cases;
    sets.push_back(set);
    return error_of(sets);
  };
  // The square root of 6 - i fails in case 7, and a weight is negative in case 4.
  EXPECT_TRUE(
    has(error(own + "Position=punch: shift 0 0 sqrt(6-i)"), "Load case closing-7/Position"));
  EXPECT_TRUE(has(error(own + "Weight=3-i"), "Load case closing-4/Weight"));
  EXPECT_TRUE(has(error(own + "Position=punch: shift 0 0 2*j"), "Load case closing-0/Position"));
  EXPECT_TRUE(has(error("Load case closing-2/Weight=-1"), "must be at least 0"));
}

TEST(Positions, CasesAreLoadCasesWithNumbers)
{
  const auto statements = scene::with_cases(
    {{"", "Load cases", "a, b", "1"},
     {"Load case b", "Cases", "3", "2"},
     {"Load case b", "Force", "up.i: 0 -100*(i+1) max(i, 1), lo.x: i 2 sin(i)", "3"},
     {"Load case b", "Pressure", "up.top: 100*(1-x^2)*i", "4"},
     {"Load case a", "Weight", "i", "5"}});
  const auto value = [&](const std::string &section, const std::string &name) {
    for (const auto &statement : statements)
      if (statement.section == section && statement.name == name)
        return statement.value;
    return std::string("none");
  };
  EXPECT_EQ(value("", "Load cases"), "a, b-0, b-1, b-2");
  EXPECT_EQ(value("Load case b-2", "Force").substr(0, 28), "up.i: 0 -300 2, lo.x: 2 2 0.");
  EXPECT_EQ(value("Load case b-0", "Force"), "up.i: 0 -100 1, lo.x: 0 2 0");
  EXPECT_EQ(value("Load case b-1", "Pressure"), "up.top: 100*(1-x^2)*(1)");
  EXPECT_EQ(value("Load case b-1", "Cases"), "none");
  EXPECT_EQ(value("Load case a", "Weight"), "i"); // a section without Cases
  EXPECT_EQ(value("Load case b", "Force"), "none");
}

TEST(Positions, OneCaseIsTheLoadCaseItself)
{
  const auto statements = scene::with_cases({{"", "Load cases", "a", "1"},
                                             {"Load case a", "Cases", "1", "2"},
                                             {"Load case a", "Weight", "2+cos(i*pi)", "3"}});
  ASSERT_EQ(statements.size(), 2u);
  EXPECT_EQ(statements[0].value, "a");
  EXPECT_EQ(statements[1].section, "Load case a");
  EXPECT_EQ(statements[1].value, "3");
}

TEST(Combinations, LimitsOfMaximaAreUpperLimits)
{
  const std::vector<std::string> two   = {"Load cases=closing, opening"};
  const std::string              entry = "Optimization/Constraints";
  expect_error({entry, "worst of compliance: >= 3", "one with <="}, two);
  expect_error({entry, "range of compliance: = 3", "one with <="}, two);
  expect_error({entry, "best of compliance: <= 3", "is not a response"}, two);
  expect_error({entry, "worst of beauty: <= 3", "'beauty' is not a response"}, two);
  expect_error({"Optimization/Combine", "mean + -2 deviation", "mean + K deviation"}, two);
  for (const std::string good :
       {"worst of compliance: <= 3", "mean of compliance: = initial",
        "deviation of compliance: <= 1", "mean + 2 deviation of compliance: <= 2 initial"})
    {
      auto sets = two;
      sets.push_back(entry + "=" + good);
      EXPECT_EQ(error_of(sets), "") << good;
    }
}
} // namespace
