#include <snug/base/assertions.h>
#include <snug/base/narrow.h>

#include <gtest/gtest.h>

#include <string>

using namespace snug;

namespace {
/// Message of the InternalError that @p work throws, empty if it throws none.
template <typename Work>
std::string internal_error(const Work &work)
{
  try
    {
      work();
    }
  catch (const InternalError &error)
    {
      return error.what();
    }
  return "";
}
} // namespace

// In each build, also in an optimized one.
TEST(Assertions, NameThePlaceTheConditionAndTheReason)
{
  const int size = 2;
  EXPECT_EQ(internal_error([]() { SNUG_ASSERT(1 < 2, "no reason"); }), "");
  const std::string message = internal_error([]() { SNUG_ASSERT(size < 2, "two is too many"); });
  EXPECT_EQ(message.find("internal error at tests/unit/base/assertions.cc:"), 0u) << message;
  EXPECT_NE(message.find("two is too many (violated: size < 2)"), std::string::npos) << message;
}

TEST(Assertions, PrintBothNumbers)
{
  const unsigned int  three = 3;
  const unsigned long four  = 4;
  EXPECT_EQ(internal_error([&]() { SNUG_ASSERT_EQUAL(four, three + 1); }), "");
  EXPECT_NE(internal_error([&]() {
              SNUG_ASSERT_EQUAL(four, three);
            }).find("the values are 4 and 3 (violated: four == three)"),
            std::string::npos);
  EXPECT_EQ(internal_error([&]() { SNUG_ASSERT_BELOW(three, four); }), "");
  EXPECT_NE(internal_error([&]() {
              SNUG_ASSERT_BELOW(four, four);
            }).find("the values are 4 and 4 (violated: four < four)"),
            std::string::npos);
}

TEST(Assertions, RefuseAnIntegerThatDoesNotFit)
{
  EXPECT_EQ(narrow<int>(std::size_t(7)), 7);
  EXPECT_NE(internal_error([]() { narrow<int>(std::size_t(1) << 31); }), "");
  EXPECT_NE(internal_error([]() { narrow<int>(std::size_t(1) << 32); }), "");
}
