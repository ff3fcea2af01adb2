#ifndef snug_app_interrupt_h
#define snug_app_interrupt_h

#include <mpi.h>

namespace snug::app {
/// Let the first SIGTERM or SIGINT from now on only set a flag. A second signal of the same kind
/// ends the process.
void catch_interrupts();

/// Return whether this rank has received a signal.
bool is_interrupted();

/// Throw Interrupted on all ranks if any rank has received a signal. Collective.
void check_interrupts(MPI_Comm communicator);
} // namespace snug::app

#endif
