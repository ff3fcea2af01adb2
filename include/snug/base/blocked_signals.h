#ifndef snug_base_blocked_signals_h
#define snug_base_blocked_signals_h

#include <csignal>

namespace snug {
/**
 * This class blocks SIGTERM in the calling thread during its lifetime. A SIGTERM that arrives in
 * this time takes effect at the end of the lifetime.
 *
 * METIS catches SIGTERM during its calls, jumps out of its computation, and returns an error as
 * if it had failed. The program would then end with this error instead of by the signal. A signal
 * is delivered to any thread that does not block it. Threads of MPI must therefore begin with
 * SIGTERM blocked too, as they do if an object of this class exists while MPI is initialized.
 */
class BlockedSignals
{
public:
  BlockedSignals()
  {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &set, &before);
  }

  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }

  BlockedSignals(const BlockedSignals &)            = delete;
  BlockedSignals &operator=(const BlockedSignals &) = delete;

private:
  sigset_t before;
};
} // namespace snug

#endif
