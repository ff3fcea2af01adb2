#include <snug/base/units.h>

#include <gtest/gtest.h>

namespace snug {
namespace {
TEST(Units, NameStressesAndProducts)
{
  const Units units({"mm", "N"});
  EXPECT_EQ(units.name("force/length^2"), "MPa");
  EXPECT_EQ(units.name("(force/length^2)^2"), "(MPa)^2");
  EXPECT_EQ(units.name("force/length^2 length^(2/p)"), "MPa mm^(2/p)");
  EXPECT_EQ(units.name("force length"), "N mm");
  EXPECT_EQ(units.name("length^3"), "mm^3");
  EXPECT_EQ(units.name("rad"), "rad");
  EXPECT_EQ(units.after_number("length"), " mm");
  EXPECT_EQ(units.after_number(""), "");
}

TEST(Units, KeepStressesWithoutANameOfTheirOwn)
{
  EXPECT_EQ(Units({"cm", "kgf"}).name("force/length^2"), "kgf/cm^2");
  EXPECT_EQ(Units({"in", "lbf"}).name("force/length^2"), "psi");
}

TEST(Units, NameNothingWithoutNames)
{
  const Units units;
  EXPECT_FALSE(units.are_named());
  EXPECT_EQ(units.name("force"), "");
  EXPECT_EQ(units.after_number("force"), "");
}
} // namespace
} // namespace snug
