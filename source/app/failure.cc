#include <snug/app/failure.h>
#include <snug/base/errors.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace snug::app {
namespace {
void print(const std::exception &error)
{
  std::cerr << "snug: " + one_line(error) + "\n" << std::flush;
}

int fail(MPI_Comm own_communicator, const std::exception &error, const double patience)
{
  fail_together(own_communicator, &error, patience);
  int rank;
  MPI_Comm_rank(own_communicator, &rank);
  if (rank == 0)
    print(error);
  return exit_status(error);
}
} // namespace

void fail_together(MPI_Comm communicator, const std::exception *error, const double patience)
{
  using Clock          = std::chrono::steady_clock;
  const auto  deadline = Clock::now() + std::chrono::duration<double>(patience);
  int         n_failed = error ? 1 : 0, size, arrived = 0;
  MPI_Request request;
  MPI_Comm_size(communicator, &size);
  MPI_Iallreduce(MPI_IN_PLACE, &n_failed, 1, MPI_INT, MPI_SUM, communicator, &request);
  while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), !arrived)
    {
      if (error && Clock::now() > deadline)
        break;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  if (arrived && (n_failed == 0 || n_failed == size))
    return;
  if (error)
    {
      print(*error);
      MPI_Abort(MPI_COMM_WORLD, exit_status(*error));
    }
  MPI_Barrier(communicator); // until another rank ends this one
}

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
