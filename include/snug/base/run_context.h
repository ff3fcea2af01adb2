#ifndef snug_base_run_context_h
#define snug_base_run_context_h

#include <snug/base/values.h>
#include <snug/base/warning.h>

#include <mpi.h>

#include <chrono>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace snug {
/// Counters of the work of a run. They are equal on every rank, except counters of subdomain
/// matrices, which are this rank's: factorizations, solves and assembly.
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
  double subdomain_solve_seconds = 0.; ///< seconds of the subdomain solves of this rank alone
};

/// This class adds the wall seconds of its lifetime to a sum. It is for short work: a
/// RunContext::Timer also reads the memory.
class AddedSeconds
{
public:
  explicit AddedSeconds(double &the_sum) : sum(the_sum), start(std::chrono::steady_clock::now()) {}
  ~AddedSeconds()
  {
    sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  AddedSeconds(const AddedSeconds &)            = delete;
  AddedSeconds &operator=(const AddedSeconds &) = delete;

private:
  double                               &sum;
  std::chrono::steady_clock::time_point start;
};

/// Amount of text in the log. Each level contains the text of the levels before.
enum class Verbosity
{
  quiet,
  normal,
  debug
};
inline Names names(Verbosity)
{
  return {{"quiet", "warnings, errors and the final result"},
          {"normal", "also sizes, contacts, convergence and certificates"},
          {"debug", "also numbers for developers of the program, such as soft modes and the memory "
                    "after each stage"}};
}

/**
 * The communicator, the log, the work counters and the wall seconds per stage of one run. A
 * RunContext is passed by reference to the stages of the run. There is no global one.
 */
class RunContext
{
public:
  /// @p out receives the log on rank 0; all other ranks print nothing.
  RunContext(MPI_Comm communicator, std::ostream &out);

  MPI_Comm communicator() const { return comm; }

  unsigned int rank() const { return my_rank; }

  unsigned int n_ranks() const { return size; }

  /// Set the amount of text in the log, which is Verbosity::normal before the first call.
  void set_verbosity(Verbosity level) { verbosity = level; }

  /// Return the log for text of @p level. The log discards text above the verbosity, and
  /// everything on ranks other than 0.
  std::ostream &out(Verbosity level = Verbosity::normal);

  /// Print "warning: " and the text as a line of the log, at every verbosity, and keep @p warning.
  /// A warning with a text that is kept already is left out.
  void warn(const Warning &warning);

  /// Warn of each of @p lines.
  void warn(const std::string &code, const std::vector<std::string> &lines);

  const std::vector<Warning> &warnings() const { return kept_warnings; }

  /**
   * Show @p text as the live line of a long stage, overwriting the previous one. Only rank 0
   * shows it, if the log is not quiet, standard output is a terminal and no MPI launcher is between
   * the program and the terminal.
   */
  void progress(const std::string &text);

  /// This class adds the wall time of its lifetime to @p stage of the context, and updates the
  /// memory of the stage at its end.
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

  /// Return the wall seconds of a stage on this rank; 0 if it never ran.
  double seconds(const std::string &stage) const;

  /// Return the wall seconds since the context was made.
  double seconds() const;

  /// Return the maximum memory [MB] in use at an end of the stage on this rank, without memory
  /// shared with other processes, such as code and messages of MPI. Return 0 if the stage never
  /// ran, or if there is no /proc.
  double memory(const std::string &stage) const;

  /// Return the memory in use when the context was made, that is of the libraries.
  double memory_at_start() const { return start_memory; }

  /// Return the work, with this rank's counters summed over ranks, not its seconds. Collective.
  Work total_work() const;

  Work work;

private:
  MPI_Comm                              comm;
  unsigned int                          my_rank;
  unsigned int                          size;
  std::ostream                         *stream;
  Verbosity                             verbosity = Verbosity::normal;
  bool                                  live_line;
  bool                                  live_line_shown = false;
  std::vector<Warning>                  kept_warnings;
  std::map<std::string, double>         stage_seconds, stage_memory;
  double                                start_memory;
  std::chrono::steady_clock::time_point start;
};

/**
 * Run @p work on this rank and make failure collective: if any rank throws, every rank throws the
 * same kind of error with the message of the lowest failing rank. InputError, SolveError,
 * TangledMesh and bad_alloc (any error that is_out_of_memory()) keep their kind. All other errors
 * become a runtime_error. Collective on @p communicator; @p work must not be collective.
 */
void throw_collectively(MPI_Comm communicator, const std::function<void()> &work);
} // namespace snug

#endif
