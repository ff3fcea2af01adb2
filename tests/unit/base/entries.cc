#include <snug/base/entries.h>
#include <snug/base/errors.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace snug;

namespace {
enum class Season
{
  summer,
  autumn
};
Names names(Season)
{
  return {{"summer", "warm"}, {"autumn", "windy", "fall"}};
}
} // namespace

TEST(Entries, ReadTheFormerNameOfAChoice)
{
  Season  season = Season::summer;
  Entries entries;
  entries.add("Season", season, "The season.");
  entries.set({"", "Season", "fall", "a.prm, line 1"});
  EXPECT_EQ(season, Season::autumn);
  std::ostringstream printed;
  entries.print(printed);
  EXPECT_EQ(printed.str(), "set Season = autumn\n");
  EXPECT_NO_THROW(entries.check(Origins(), 2));
}

TEST(Entries, OfferOnlyTheNamesOfToday)
{
  Season  season = Season::summer;
  Entries entries;
  entries.add("Season", season, "The season.");
  EXPECT_EQ(entries.descriptions().front().form.allowed, "one of summer, autumn");
  try
    {
      entries.set({"", "Season", "winter", "a.prm, line 1"});
      ADD_FAILURE() << "accepted 'winter'";
    }
  catch (const InputError &error)
    {
      EXPECT_STREQ(error.what(),
                   "a.prm, line 1: entry 'Season' = 'winter': must be one of summer, autumn");
    }
}
