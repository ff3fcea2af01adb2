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
/// This struct holds the settings of a journal.
struct JournalSettings
{
  /// existing directory for journal.txt and warm-start.<0|1>
  std::string directory;
  /// lines "name = value" of all settings on which results depend; a restart with another
  /// fingerprint is rejected
  std::string fingerprint;
  /// Replay the journal of the directory; otherwise it is overwritten.
  bool     restart      = false;
  MPI_Comm communicator = MPI_COMM_SELF;
  /// called on every rank with one line of the log, without the end of line
  std::function<void(const std::string &)> log;
};

/// Tolerance within which a replay takes a design for the recorded one, relative to the largest
/// variable, or to the width of the bounds if that is smaller. On another number of ranks, sums
/// over ranks round differently. Optimizers then propose slightly different designs from the
/// recorded values; the designs of MMA differ by up to 1e-7.
constexpr double replay_tolerance = 1e-6;

/**
 * This class records every evaluation of a design problem, and every differentiation as a second
 * record. On a restart it returns the recorded evaluations in order instead of evaluating again.
 * The optimizer is deterministic, so it takes the same path, bit for bit, and continues where the
 * records end. On another number of ranks the path agrees to replay_tolerance. Optimizations that
 * follow one another, as after a new contact search, share a journal.
 *
 * A record is complete when its last line has been written. Before the record of evaluation v is
 * written, the memory() of the problem of all ranks is stored in warm-start.<v % 2>. The file of
 * evaluation v - 1 is overwritten by evaluation v + 1 only. Therefore the last complete record
 * always has its data, and a killed run loses at most the evaluation in progress. The stored data
 * are loaded before the first evaluation that is not replayed. If the first call that is not
 * replayed is a differentiation, its design is evaluated again from the data of evaluation v - 1.
 *
 * The data are not loaded, and the log says so, if the number of ranks has changed, the file is
 * missing or truncated, or a replayed design differs from the requested design by more than
 * replay_tolerance. In the last case the records are cut there.
 *
 * Only rank 0 reads and writes files.
 */
class Journal
{
public:
  /**
   * Open the journal and, with `restart`, read it. Collective.
   * @throws InputError if the directory cannot be written to, or the
   *   journal is of another format or problem or is damaged other than in
   *   its last record. A missing journal is no error: there was nothing to
   *   record yet.
   */
  explicit Journal(const JournalSettings &settings);

  /**
   * Return @p problem with its evaluations recorded or replayed. The result refers to this journal.
   * Evaluating it is collective and throws what @p problem
   * throws: TangledMesh and other SolveErrors are recorded and thrown again
   * by a replay, other errors are not recorded; InputError if the journal
   * cannot be written.
   */
  DesignProblem journaled(const DesignProblem &problem);

  /// Return the number of calls that were answered from the records so far.
  unsigned int n_replayed() const { return replayed; }

  /// Return the number of complete records, replayed or not.
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
  unsigned int               values     = 0; ///< number of records of evaluate() below next
  unsigned int        first = 0; ///< number of records of evaluate() of earlier optimizations
  std::vector<double> last;      ///< design of the last value
  unsigned int        replayed = 0;
  bool                is_live  = false;
  std::ofstream       file; ///< rank 0 only
};
} // namespace snug::optimization

#endif
