#ifndef snug_app_failure_h
#define snug_app_failure_h

#include <mpi.h>

#include <exception>
#include <functional>

namespace snug::app {
/// Return the exit status of an error: 2 for InputError, 3 for SolveError, 1 for other errors.
int exit_status(const std::exception &error);

/**
 * Run @p work and turn what it throws into an exit status and one line
 * "snug: ..." on standard error.
 *
 * Errors that all ranks throw (those of the input, of the solver and of
 * throw_collectively()) are printed by rank 0, and their status is returned. If the other ranks do
 * not throw within @p patience seconds, they may be waiting for a message
 * that never comes: the rank prints its own error, and MPI_Abort ends all ranks.
 */
int guarded(MPI_Comm communicator, const std::function<int()> &work, double patience = 10.);
} // namespace snug::app

#endif
