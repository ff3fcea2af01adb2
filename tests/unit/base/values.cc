#include <snug/base/values.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

using namespace snug;

namespace {
/// Return whether from_text() refuses @p text as a value of type T.
template <typename T>
bool refuses(const std::string &text)
{
  T value;
  try
    {
      from_text(text, value);
    }
  catch (const std::invalid_argument &)
    {
      return true;
    }
  return false;
}
} // namespace

TEST(Values, NumbersAreReadBackToTheLastBit)
{
  std::mt19937_64     random(1);
  std::vector<double> numbers;
  while (numbers.size() < 10000)
    {
      const unsigned long bits = random();
      double              number;
      std::memcpy(&number, &bits, sizeof number);
      if (!std::isnormal(number))
        continue;
      numbers.push_back(number);
      double again;
      from_text(to_text(number), again);
      EXPECT_EQ(again, number) << to_text(number);
    }
  for (const char separator : {',', ' '})
    {
      std::vector<double> again;
      from_text(to_text(numbers, separator), again);
      EXPECT_EQ(again, numbers);
    }
}

TEST(Values, NumbersOfOtherFormsAreRefused)
{
  for (const std::string text : {"", "nan", "inf", "0x10", "1e", "1 2", "1.5.2", "1e999", "--1"})
    EXPECT_TRUE(refuses<double>(text)) << text;
  for (const std::string text : {"", "-1", "1.5", "2147483648", "1e3", "99999999999999999999"})
    EXPECT_TRUE(refuses<unsigned int>(text)) << text;
  unsigned int largest;
  from_text("2147483647", largest);
  EXPECT_EQ(largest, 2147483647u);
  EXPECT_TRUE(refuses<std::vector<unsigned int>>("2, 0"));
  EXPECT_FALSE(refuses<std::vector<double>>("2, 0"));
}

TEST(Values, DecimalCommasAreRefusedWhereTheyCanBe)
{
  for (const std::string text : {"0,15", "1,5e3", "-0,1"})
    EXPECT_TRUE(refuses<double>(text)) << text;
  for (const std::string text : {"0,5, 1", "1, 2,5", "-0,1, 0,1", "0,5 0,5", "-0,1"})
    EXPECT_TRUE(refuses<std::vector<double>>(text)) << text;
  for (const std::string text : {"1,2", "1, 2", "1,2,3", "0.5,1", "1,0.5", "-0, 1"})
    EXPECT_FALSE(refuses<std::vector<double>>(text)) << text;
  EXPECT_EQ(decimal_point_hint("0,15"), "; write 0.15 instead of 0,15");
  EXPECT_EQ(decimal_point_hint("top: 0 0 -12,5"), "; write 12.5 instead of 12,5");
  EXPECT_EQ(decimal_point_hint("0, 0,5*x"), "; write 0.5 instead of 0,5");
  for (const std::string text :
       {"", "1, 2", "1,2,3", "max(0,5)", "0.5,1", "x,1", "1,", "0,0,-2*max(x, y)"})
    EXPECT_EQ(decimal_point_hint(text), "") << text;
}

TEST(Values, SeparatorsWithinParenthesesDoNotSeparate)
{
  using Parts = std::vector<std::string>;
  EXPECT_EQ(split(" a , max(x, min(y, z)),b", ','), (Parts{"a", "max(x, min(y, z))", "b"}));
  EXPECT_EQ(components("0 0  -5*max(x, y)"), (Parts{"0", "0", "-5*max(x, y)"}));
  EXPECT_EQ(vector_components("x y, 0"), (Parts{"x y", "0"}));
  EXPECT_EQ(vector_components("x max(y, 0)"), (Parts{"x", "max(y, 0)"}));
  // An empty last part is no part.
  EXPECT_EQ(split("a,b,", ','), (Parts{"a", "b"}));
  EXPECT_EQ(split("a,,b", ','), (Parts{"a", "", "b"}));
}

TEST(Values, MapsAreReadBackAndHaveDifferentKeys)
{
  const VectorMap vectors = {{"bottom", {0.1, -2e-7}}, {"top", {3.}}};
  VectorMap       again;
  from_text(to_text(vectors), again);
  EXPECT_EQ(again, vectors);
  const TextMap texts = {{"a", "max(x, y): 1"}, {"b", "c"}};
  TextMap       read;
  from_text(to_text(texts, ';'), read, ';');
  EXPECT_EQ(read, texts);
  for (const std::string text : {"a: 1, a: 2", "a", ": 1", "a:"})
    EXPECT_TRUE(refuses<TextMap>(text)) << text;
}
