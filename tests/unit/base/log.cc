#include <snug/base/run_context.h>
#include <snug/base/values.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace snug;

namespace {
/// Return the log of a run that prints one line of each level and warns twice of the same.
std::string log_of(const Verbosity verbosity)
{
  std::ostringstream text;
  RunContext         context(MPI_COMM_SELF, text);
  context.set_verbosity(verbosity);
  context.out(Verbosity::quiet) << "result\n";
  context.out() << "sizes\n";
  context.out(Verbosity::debug) << "memory\n";
  for (const char *text : {"locks", "locks"})
    context.warn({"locking", text});
  EXPECT_EQ(context.warnings().size(), 1u);
  return text.str();
}
} // namespace

TEST(Log, WarningsAndResultsAreInEveryLog)
{
  EXPECT_EQ(log_of(Verbosity::quiet), "result\nwarning: locks\n");
  EXPECT_EQ(log_of(Verbosity::normal), "result\nsizes\nwarning: locks\n");
  EXPECT_EQ(log_of(Verbosity::debug), "result\nsizes\nmemory\nwarning: locks\n");
}

TEST(Log, NounsAgreeWithTheirNumbers)
{
  EXPECT_EQ(counted(1, "face"), "1 face");
  EXPECT_EQ(counted(0, "face"), "0 faces");
  EXPECT_EQ(counted(2, "body", "bodies"), "2 bodies");
  EXPECT_EQ(counted(1, "MPI process", "MPI processes"), "1 MPI process");
}
