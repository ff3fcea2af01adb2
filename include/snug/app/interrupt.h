#ifndef snug_app_interrupt_h
#define snug_app_interrupt_h

#include <mpi.h>

namespace snug::app {
/// From now on the first SIGTERM or SIGINT only sets a flag; the next one ends the process.
void catch_interrupts();

/// @throws Interrupted on all ranks if any rank got a signal. Collective.
void check_interrupts(MPI_Comm communicator);
} // namespace snug::app

#endif
