#include <snug/app/command_line.h>
#include <snug/app/failure.h>
#include <snug/base/errors.h>

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

using namespace snug;

namespace {
app::Options parse(std::initializer_list<const char *> arguments)
{
  std::vector<const char *> argv = {"snug"};
  argv.insert(argv.end(), arguments);
  return app::parse(argv.size(), argv.data());
}

std::string error_of(std::initializer_list<const char *> arguments)
{
  try
    {
      parse(arguments);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}
} // namespace

TEST(CommandLine, TakesOptionsInAnyOrder)
{
  const auto options = parse(
    {"--set", "Task=state", "a.prm", "--output=there", "--set=Body a/Box cells=1,1", "--restart"});
  EXPECT_EQ(options.file, "a.prm");
  EXPECT_EQ(options.sets, (std::vector<std::string>{"Task=state", "Body a/Box cells=1,1"}));
  EXPECT_EQ(options.output, "there");
  EXPECT_TRUE(options.restart);
  EXPECT_EQ(parse({"--petsc", " -a 1", "a.prm", "--petsc=-b"}).petsc, "-a 1 -b");
  EXPECT_FALSE(options.validate || options.print_parameters || options.help || options.version);
}

TEST(CommandLine, TakesQuestionsWithoutAFile)
{
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
  EXPECT_TRUE(parse({"--print-parameters"}).print_parameters);
  EXPECT_TRUE(parse({"--validate", "a.prm"}).validate);
  EXPECT_FALSE(parse({"--validate", "a.prm"}).json);
  EXPECT_TRUE(parse({"--validate=json", "a.prm"}).json);
  EXPECT_TRUE(parse({"--advise", "a.prm"}).advise);
  const auto estimate = parse({"--estimate", "--ranks", "16", "a.prm"});
  EXPECT_TRUE(estimate.estimate);
  EXPECT_EQ(estimate.ranks, 16u);
}

TEST(CommandLine, NamesWhatIsWrong)
{
  const auto expect = [](const std::string &message, const std::string &part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(error_of({}), "no parameter file");
  expect(error_of({"--validate"}), "no parameter file");
  expect(error_of({"a.prm", "--outptu", "x"}), "'--outptu'");
  expect(error_of({"a.prm", "--output"}), "'--output' needs a value");
  expect(error_of({"a.prm", "--output="}), "'--output' needs a value");
  expect(error_of({"a.prm", "--set"}), "'--set' needs a value");
  expect(error_of({"a.prm", "--petsc", "mumps"}), "'mumps'");
  expect(error_of({"a.prm", "--restart=1"}), "'--restart' takes no value");
  expect(error_of({"a.prm", "b.prm"}), "'b.prm'");
  expect(error_of({"--estimate", "--ranks=0", "a.prm"}), "'--ranks' needs a whole number");
  expect(error_of({"--estimate", "--ranks=two", "a.prm"}), "'--ranks' needs a whole number");
  expect(error_of({"--ranks=2", "a.prm"}), "'--ranks' requires --estimate");
  expect(error_of({"--advise", "--restart", "a.prm"}), "only one of");
  expect(error_of({"--serve", "--validate", "a.prm"}), "only one of");
}

TEST(Failure, StatusFollowsTheKindOfError)
{
  EXPECT_EQ(app::exit_status(InputError("")), 2);
  EXPECT_EQ(app::exit_status(SolveError("")), 3);
  EXPECT_EQ(app::exit_status(TangledMesh("")), 3);
  EXPECT_EQ(app::exit_status(Interrupted("")), 3);
  EXPECT_EQ(app::exit_status(std::bad_alloc()), 1);
}

TEST(Failure, ErrorsOfAllRanksBecomeAStatus)
{
  EXPECT_EQ(app::guarded(MPI_COMM_WORLD, []() { return 0; }), 0);
  ::testing::internal::CaptureStderr();
  const int status = app::guarded(MPI_COMM_WORLD, []() -> int { throw SolveError("no"); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "snug: no\n");
  EXPECT_EQ(status, 3);
}
