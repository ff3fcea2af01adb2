#include <snug/base/blocked_signals.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <iostream>
#include <memory>
#include <sstream>
#include <string>

namespace {

using dealii::Utilities::MPI::this_mpi_process;

/// This class prints the failures of a rank that prints nothing else.
class Failures : public ::testing::EmptyTestEventListener
{
  void OnTestStart(const ::testing::TestInfo &test) override
  {
    name_ = std::string(test.test_suite_name()) + "." + test.name();
  }

  void OnTestPartResult(const ::testing::TestPartResult &result) override
  {
    if (!result.failed())
      return;
    std::ostringstream lines;
    lines << "rank " << this_mpi_process(MPI_COMM_WORLD) << ", " << name_ << ": "
          << (result.file_name() ? result.file_name() : "") << ":" << result.line_number() << ":\n"
          << result.message() << "\n";
    std::cerr << lines.str() << std::flush;
  }

  std::string name_;
};

} // namespace

/// Every rank runs every test; the program fails if any rank does. Only rank 0
/// prints, so that the log reads as one program's; others print their failures.
int main(int argc, char *argv[])
{
  ::testing::InitGoogleTest(&argc, argv);
  auto blocked = std::make_unique<snug::BlockedSignals>(); // for the threads of MPI
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  blocked.reset();
  auto &listeners = ::testing::UnitTest::GetInstance()->listeners();
  if (this_mpi_process(MPI_COMM_WORLD) != 0)
    {
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new Failures);
    }
  return dealii::Utilities::MPI::max(RUN_ALL_TESTS(), MPI_COMM_WORLD);
}
