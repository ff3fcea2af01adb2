#ifndef snug_app_interrupt_h
#define snug_app_interrupt_h

#include <mpi.h>

namespace snug::app {
/// From now on SIGTERM and SIGINT only set a flag.
void catch_interrupts();

/// @throws Interrupted on all ranks if any rank got a signal. Collective.
void check_interrupts(MPI_Comm communicator);
} // namespace snug::app

#endif
