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

/**
 * Records every evaluation of a design problem, and on a restart returns
 * the recorded ones in order instead of evaluating again. The optimizer
 * is deterministic, so it takes the same path, bit for bit, and goes on
 * from where the record ends. Problems that follow one another, as when
 * contact is paired anew, share a journal.
 *
 * Record `index` is complete when its last line is. Before it is begun,
 * every rank has moved the problem's memory() of that evaluation to
 * warm-start.<rank>.<index % 2>; that of the record before stays until the
 * record is complete. So at any moment the last complete record has its
 * data, and a kill at any moment loses at most the evaluation under way.
 * They are remembered just before the first live evaluation.
 *
 * They are not (the log says so) if the number of ranks has changed, a
 * file is missing or cut short, or a replayed design differs from the one
 * asked for; the record is then cut there.
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
  Evaluation  evaluate(const DesignProblem &problem, const std::vector<double> &x);
  Evaluation  evaluate_live(const DesignProblem &problem, JournalRecord &record);
  void        read();
  void        begin();
  void        cut();
  void        forget_warm_start();
  void        load_warm_start(const DesignProblem &problem);
  void        store(const DesignProblem &problem, const JournalRecord &record);
  std::string path() const { return settings.directory + "/journal.txt"; }
  std::string warm_start_path(unsigned int index) const;
  void        say(const std::string &line) const;

  JournalSettings            settings;
  int                        rank    = 0;
  int                        n_ranks = 1;
  std::vector<JournalRecord> recorded;       ///< not yet replayed: [next, end)
  std::size_t                header_end = 0; ///< bytes
  unsigned int               next       = 0; ///< index of next evaluation
  unsigned int               first      = 0; ///< index of the first of the problem under way
  unsigned int               replayed   = 0;
  bool                       is_live    = false;
  std::ofstream              file; ///< rank 0 only
};
} // namespace snug::optimization

#endif
