#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

/// Every rank runs every test; the program fails if any rank does. Only rank 0
/// prints, so that the log reads as one program's.
int main(int argc, char *argv[])
{
  ::testing::InitGoogleTest(&argc, argv);
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  auto &listeners = ::testing::UnitTest::GetInstance()->listeners();
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    delete listeners.Release(listeners.default_result_printer());
  return dealii::Utilities::MPI::max(RUN_ALL_TESTS(), MPI_COMM_WORLD);
}
