#ifndef snug_app_failure_h
#define snug_app_failure_h

#include <mpi.h>

#include <exception>
#include <functional>

namespace snug::app {
/// Return the exit status of an error: 2 for InputError, 3 for SolveError, 1 for other errors.
int exit_status(const std::exception &error);

/**
 * Return if no rank has an @p error, or if all ranks have one. If the other ranks do not call this
 * function within @p patience seconds after a rank with an error, they may be waiting for a message
 * that never comes. Then, and if only some ranks have an error, a rank with an error prints
 * "snug: ...", and MPI_Abort ends all ranks. Collective on @p communicator, which must have no
 * other messages.
 */
void fail_together(MPI_Comm communicator, const std::exception *error, double patience = 10.);

/**
 * Run @p work and turn what it throws into an exit status and one line
 * "snug: ..." on standard error.
 *
 * Errors that all ranks throw (those of the input, of the solver and of
 * throw_collectively()) are printed by rank 0, and their status is returned. Errors of some ranks
 * only end all ranks, see fail_together().
 */
int guarded(MPI_Comm communicator, const std::function<int()> &work, double patience = 10.);
} // namespace snug::app

#endif
