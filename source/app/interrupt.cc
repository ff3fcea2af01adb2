#include <snug/app/interrupt.h>
#include <snug/base/errors.h>

#include <csignal>

namespace snug::app {
namespace {
volatile std::sig_atomic_t signal_received = 0;

void note_signal(int number)
{
  signal_received = number;
  std::signal(number, SIG_DFL); // who asks twice does not want to wait
}
} // namespace

void catch_interrupts()
{
  std::signal(SIGTERM, note_signal);
  std::signal(SIGINT, note_signal);
}

bool is_interrupted()
{
  return signal_received != 0;
}

void check_interrupts(MPI_Comm communicator)
{
  int received = signal_received;
  MPI_Allreduce(MPI_IN_PLACE, &received, 1, MPI_INT, MPI_MAX, communicator);
  if (received != 0)
    throw Interrupted("ended by signal " + std::to_string(received));
}
} // namespace snug::app
