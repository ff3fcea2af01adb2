#ifndef snug_base_run_context_h
#define snug_base_run_context_h

#include <mpi.h>

#include <chrono>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>

namespace snug {
/// What a run has done so far; the same on every rank except what counts matrices of
/// subdomains, which is this rank's: their factorizations, solves and assembly.
struct Work
{
  unsigned long f_mults                     = 0;
  unsigned long preconditioner_applications = 0;
  unsigned long coarse_factorizations       = 0; ///< of G G', one for each set of rows
  unsigned long coarse_solves               = 0;
  unsigned long subdomain_solves            = 0; ///< columns times factors of subdomains
  unsigned long symbolic_factorizations     = 0;
  unsigned long numeric_factorizations      = 0;
  unsigned long assembled_subdomains        = 0;
  unsigned long soft_modes                  = 0; ///< found, coarse vectors of the dual problem
};

/**
 * The communicator, the printer and the books of one run: work counters
 * and wall seconds per stage. Passed by reference to the stages that work;
 * there is no global one.
 */
class RunContext
{
public:
  /// @p out receives the log on rank 0; other ranks print nothing.
  RunContext(MPI_Comm communicator, std::ostream &out);

  MPI_Comm communicator() const { return comm; }

  unsigned int rank() const { return my_rank; }

  unsigned int n_ranks() const { return size; }

  /// The log; swallows everything on ranks other than 0.
  std::ostream &out();

  /**
   * Show @p text as the live line of a long stage, over the previous one.
   * Only rank 0, when standard output is a terminal and no MPI launcher is
   * in between.
   */
  void progress(const std::string &text);

  /// Adds the wall time of its life to @p stage of the context, and sees to the memory at its end.
  class Timer
  {
  public:
    Timer(RunContext &context, const std::string &stage);
    ~Timer();
    Timer(const Timer &)            = delete;
    Timer &operator=(const Timer &) = delete;

  private:
    RunContext                           &context;
    std::string                           stage;
    std::chrono::steady_clock::time_point start;
  };

  /// Wall seconds of a stage on this rank; 0 if it never ran.
  double seconds(const std::string &stage) const;

  /// Wall seconds since the context was made.
  double seconds() const;

  /// The most of memory in use [MB] at an end of the stage on this rank, without what it shares
  /// with others, such as code and MPI's messages; 0 if it never ran, or where no /proc tells.
  double memory(const std::string &stage) const;

  /// That when the context was made: of the libraries.
  double memory_at_start() const { return start_memory; }

  /// Work with this rank's counters summed over ranks. Collective.
  Work total_work() const;

  Work work;

private:
  MPI_Comm                              comm;
  unsigned int                          my_rank;
  unsigned int                          size;
  std::ostream                         *stream;
  bool                                  live_line;
  bool                                  live_line_shown = false;
  std::map<std::string, double>         stage_seconds, stage_memory;
  double                                start_memory;
  std::chrono::steady_clock::time_point start;
};

/**
 * Run @p work on this rank and make failure collective: if any rank throws,
 * every rank throws the same kind of error with the message of the lowest
 * failing rank. InputError, SolveError, TangledMesh and bad_alloc (any error
 * that is_out_of_memory()) stay what they are, all else becomes a
 * runtime_error. Collective on @p communicator; @p work must not be.
 */
void everywhere(MPI_Comm communicator, const std::function<void()> &work);
} // namespace snug

#endif
