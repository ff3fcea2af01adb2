#ifndef snug_base_blocked_signals_h
#define snug_base_blocked_signals_h

#include <csignal>

namespace snug {
/**
 * This class blocks SIGTERM in the calling thread for as long as it lives. A
 * SIGTERM that arrives meanwhile takes effect at the end.
 *
 * METIS catches SIGTERM during its calls, jumps out of whatever it does, and
 * returns an error as if it had failed: the program would end with this error
 * instead of by the signal. A signal goes to any thread that does not block it:
 * threads of MPI must begin with it blocked as well, as they do where one of
 * these lives while MPI is initialized.
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
