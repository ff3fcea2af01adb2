#include <snug/app/failure.h>
#include <snug/base/errors.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace snug::app {
namespace {
/// Return whether all ranks call this function within @p patience seconds.
bool all_arrive(MPI_Comm communicator, const double patience)
{
  using Clock          = std::chrono::steady_clock;
  const auto  deadline = Clock::now() + std::chrono::duration<double>(patience);
  MPI_Request request;
  int         arrived = 0;
  MPI_Ibarrier(communicator, &request);
  while (true)
    {
      MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
      if (arrived || Clock::now() > deadline)
        return arrived;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

int fail(MPI_Comm own_communicator, const std::exception &error, const double patience)
{
  const int  status   = exit_status(error);
  const bool together = all_arrive(own_communicator, patience);
  int        rank;
  MPI_Comm_rank(own_communicator, &rank);
  if (rank == 0 || !together)
    std::cerr << "snug: " + one_line(error) + "\n" << std::flush;
  if (!together)
    MPI_Abort(MPI_COMM_WORLD, status);
  return status;
}
} // namespace

int exit_status(const std::exception &error)
{
  if (dynamic_cast<const InputError *>(&error) != nullptr)
    return 2;
  // A search that ends before its first design is evaluated is one that is not solved.
  return dynamic_cast<const SolveError *>(&error) || dynamic_cast<const Interrupted *>(&error) ? 3
                                                                                               : 1;
}

int guarded(MPI_Comm communicator, const std::function<int()> &work, const double patience)
{
  // No message of the work can be taken for one of fail().
  MPI_Comm own;
  MPI_Comm_dup(communicator, &own);
  int status = 0;
  try
    {
      status = work();
    }
  catch (const std::exception &error)
    {
      status = fail(own, error, patience);
    }
  catch (...)
    {
      status = fail(own, std::runtime_error("unknown error"), patience);
    }
  MPI_Comm_free(&own);
  return status;
}
} // namespace snug::app
