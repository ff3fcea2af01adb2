#ifndef snug_optimization_journal_h
#define snug_optimization_journal_h

#include <snug/base/narrow.h>
#include <snug/optimization/design_problem.h>
#include <snug/optimization/journal_record.h>

#include <mpi.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace snug::optimization {
/// Where a journal lives.
struct JournalSettings
{
  /// Exists; receives journal.txt and warm-start.<rank>.<0|1>.
  std::string directory;
  /// Lines "name = value" of everything that decides the numbers. A
  /// restart with another fingerprint is refused.
  std::string fingerprint;
  /// Replay the journal of the directory; otherwise it is overwritten.
  bool     restart      = false;
  MPI_Comm communicator = MPI_COMM_SELF;
  /// Receives one line, without its end; called on every rank.
  std::function<void(const std::string &)> log;
};

/// Designs this close are the same one to a replay, relative to the largest variable, or to the
/// width of the bounds if that is smaller. Scales of constraints are sums over ranks: on another
/// number of ranks they differ by rounding, and with them the designs that an optimizer makes of
/// recorded values: by 1e-7 where MMA solves its subproblems.
constexpr double replay_tolerance = 1e-6;

/**
 * Records every evaluation of a design problem, once more where it gains gradients, and on a
 * restart returns the recorded ones in order instead of evaluating again. The optimizer is
 * deterministic, so it takes the same path, bit for bit, and goes on from where the record ends.
 * On another number of ranks the path agrees to replay_tolerance: recorded values are returned for
 * designs that differ by less.
 * Problems that follow one another, as when contact is paired anew, share a journal.
 *
 * A record is complete when its last line is. Before that of evaluate() number v is begun, every
 * rank has moved the problem's memory() of then to warm-start.<rank>.<v % 2>; that of number v - 1
 * stays until number v + 1. So at any moment the last complete record has its data, and a kill at
 * any moment loses at most the evaluation under way. They are remembered just before the first
 * live evaluation. To differentiate the last design evaluated, that is evaluated again from the
 * data of number v - 1, as it was before.
 *
 * They are not (the log says so) if the number of ranks has changed, a
 * file is missing or cut short, or a replayed design differs from the one
 * asked for by more than replay_tolerance; the record is then cut there.
 *
 * Only rank 0 reads and writes journal.txt.
 */
class Journal
{
public:
  /**
   * Collective. Opens the journal; with `restart`, reads it.
   * @throws InputError if the directory cannot be written to, or the
   *   journal is of another format or problem or is damaged other than in
   *   its last record. A missing journal is no error: there was nothing to
   *   record yet.
   */
  explicit Journal(const JournalSettings &settings);

  /**
   * @p problem with its evaluations recorded or replayed, for as long as
   * this lives. Evaluating it is collective and throws what @p problem
   * throws: TangledMesh and other SolveErrors are recorded and thrown again
   * by a replay, other errors are not recorded; InputError if the journal
   * cannot be written.
   */
  DesignProblem journaled(const DesignProblem &problem);

  /// Evaluations answered from the record so far.
  unsigned int n_replayed() const { return replayed; }

  /// Complete records, replayed or not.
  unsigned int n_records() const { return is_live ? next : narrow<unsigned int>(recorded.size()); }

private:
  Evaluation evaluate(const DesignProblem &problem, const std::vector<double> &x);
  void
  differentiate(const DesignProblem &problem, const std::vector<double> &x, Evaluation &evaluation);
  bool        is_replayed(const DesignProblem &problem, const std::vector<double> &x);
  void        go_live(const DesignProblem &problem, bool last_again);
  Evaluation  recorded_live(const DesignProblem               &problem,
                            const std::vector<double>         &x,
                            const std::function<Evaluation()> &work,
                            bool                               changes_memory);
  void        read();
  void        begin();
  void        cut();
  void        forget_warm_start();
  void        load_warm_start(const DesignProblem &problem, unsigned int values);
  void        store(const DesignProblem &problem, const JournalRecord &record, bool stores_memory);
  std::string path() const { return settings.directory + "/journal.txt"; }
  std::string warm_start_path(unsigned int value) const;
  void        say(const std::string &line) const;

  JournalSettings            settings;
  int                        rank    = 0;
  int                        n_ranks = 1;
  std::vector<JournalRecord> recorded;       ///< not yet replayed: [next, end)
  std::size_t                header_end = 0; ///< bytes
  unsigned int               next       = 0; ///< index of next evaluation
  unsigned int               values     = 0; ///< records of evaluate() among them
  unsigned int               first      = 0; ///< values before the problem under way
  std::vector<double>        last;           ///< design of the last value
  unsigned int               replayed = 0;
  bool                       is_live  = false;
  std::ofstream              file; ///< rank 0 only
};
} // namespace snug::optimization

#endif
