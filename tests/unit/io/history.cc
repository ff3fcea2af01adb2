#include <snug/base/errors.h>
#include <snug/io/history.h>
#include <snug/io/text_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scratch.h"

namespace snug {
namespace {
io::HistoryLine line_of_history(unsigned int iteration)
{
  io::HistoryLine line;
  line.iteration            = iteration;
  line.evaluations          = 2 * iteration + 1;
  line.objective            = -1. / (3. + iteration);
  line.constraint_violation = std::nextafter(1e-9, 1.);
  line.projected_gradient   = 0.1 * iteration;
  line.active_contacts      = 21 + iteration;
  line.f_mults              = 1234;
  line.scaled_jacobian      = 2. / 3.;
  line.seconds              = 12.345;
  line.design               = {0.1, -0.2 / 3.};
  line.values               = {7. / 3.};
  return line;
}

TEST(History, ReadsBackBitForBit)
{
  const test::ScratchDirectory scratch;
  if (!scratch.is_first())
    return;
  io::History history(scratch.file("history.csv"), 2, {"tilted.peak"});
  for (unsigned int i = 0; i < 3; ++i)
    {
      history.add(line_of_history(i));
      const auto table = test::read_csv(test::read_file(scratch.file("history.csv")));
      ASSERT_EQ(table.size(), i + 2); // complete after each line
      EXPECT_EQ(table[0],
                (std::vector<std::string>{"iteration", "evaluations", "objective",
                                          "constraint_violation", "projected_gradient",
                                          "active_contacts", "f_mults", "scaled_jacobian",
                                          "seconds", "design_0", "design_1", "tilted.peak"}));
      const auto &fields = table.back();
      const auto  line   = line_of_history(i);
      ASSERT_EQ(fields.size(), table[0].size());
      EXPECT_EQ(std::stoul(fields[0]), i);
      EXPECT_EQ(std::stoul(fields[1]), line.evaluations);
      EXPECT_EQ(std::stod(fields[2]), line.objective);
      EXPECT_EQ(std::stod(fields[3]), line.constraint_violation);
      EXPECT_EQ(std::stod(fields[4]), line.projected_gradient);
      EXPECT_EQ(std::stoul(fields[5]), line.active_contacts);
      EXPECT_EQ(std::stoul(fields[6]), line.f_mults);
      EXPECT_EQ(std::stod(fields[7]), line.scaled_jacobian);
      EXPECT_EQ(std::stod(fields[8]), line.seconds);
      EXPECT_EQ(std::stod(fields[9]), line.design[0]);
      EXPECT_EQ(std::stod(fields[10]), line.design[1]);
      EXPECT_EQ(std::stod(fields[11]), line.values[0]);
    }
}

TEST(History, LogLineStandsUnderItsHeader)
{
  const std::string header = io::log_header();
  const std::string line   = io::log_line(line_of_history(7));
  EXPECT_EQ(header.size(), line.size());
  std::istringstream                  names(header), numbers(line);
  const std::map<std::string, double> values = {
    {"iter", 7.}, {"evals", 15.}, {"objective", -0.1}, {"contacts", 28.}, {"dual-its", 1234.}};
  std::vector<std::string> columns;
  for (std::string name; names >> name;)
    {
      columns.push_back(name);
      double value;
      EXPECT_TRUE(numbers >> value) << name;
      const auto expected = values.find(name);
      if (expected != values.end())
        {
          EXPECT_NEAR(value, expected->second, 1e-12);
        }
    }
  EXPECT_EQ(columns,
            (std::vector<std::string>{"iter", "evals", "objective", "gradient", "violation",
                                      "contacts", "dual-its", "quality", "seconds"}));
}

TEST(TextFile, ExactNumbersReadBack)
{
  for (const double x : {0., -1. / 3., 5e-324, 1.7976931348623157e308})
    EXPECT_EQ(std::strtod(io::exact(x).c_str(), nullptr), x);
}

TEST(TextFile, PadsWithoutCutting)
{
  EXPECT_EQ(io::padded(7, 4), "0007");
  EXPECT_EQ(io::padded(12345, 4), "12345");
}

TEST(TextFile, NamesTheFileItCannotWrite)
{
  try
    {
      io::write_text_file("/nowhere/at/all.txt", "text");
      FAIL() << "no exception";
    }
  catch (const std::runtime_error &error)
    {
      EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.txt"), std::string::npos);
    }
}

TEST(TextFile, ReplacesAFileAndLeavesNothingBeside)
{
  const test::ScratchDirectory scratch;
  if (!scratch.is_first())
    return;
  io::write_text_file(scratch.file("a"), "a long first text");
  io::write_text_file(scratch.file("a"), "short");
  EXPECT_EQ(test::read_file(scratch.file("a")), "short");
  const std::filesystem::directory_iterator files(scratch.path);
  EXPECT_EQ(std::distance(files, {}), 1);
}

TEST(OutputDirectory, IsMadeWithItsParents)
{
  const test::ScratchDirectory scratch;
  std::ostringstream           log;
  const RunContext             context(MPI_COMM_WORLD, log);
  const std::string            path = scratch.file("some/deep/place");
  io::make_output_directory(context, path);
  io::make_output_directory(context, path);
  EXPECT_TRUE(std::filesystem::is_directory(path));
  EXPECT_TRUE(std::filesystem::is_empty(path));
}

TEST(OutputDirectory, EveryRankHearsOfFailure)
{
  const test::ScratchDirectory scratch;
  if (scratch.is_first())
    io::write_text_file(scratch.file("file"), "in the way");
  std::ostringstream log;
  const RunContext   context(MPI_COMM_WORLD, log);
  EXPECT_THROW(io::make_output_directory(context, scratch.file("file/x")), InputError);
  EXPECT_THROW(io::make_output_directory(context, scratch.file("file")), InputError);
}
} // namespace
} // namespace snug
