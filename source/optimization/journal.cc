#include <snug/base/errors.h>
#include <snug/base/run_context.h>
#include <snug/optimization/journal.h>
#include <snug/optimization/warm_start_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace snug::optimization {
namespace {
/// Return whether two designs are the same to replay_tolerance.
bool are_same(const DesignProblem       &problem,
              const std::vector<double> &a,
              const std::vector<double> &b)
{
  if (a.size() != b.size())
    return false;
  double largest = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
  for (std::size_t i = 0; i < a.size(); ++i)
    {
      const bool   is_bounded = i < problem.lower.size() && i < problem.upper.size();
      const double size =
        is_bounded ? std::min(largest, problem.upper[i] - problem.lower[i]) : largest;
      // Written so that NaN differs.
      if (!(std::abs(a[i] - b[i]) <= replay_tolerance * size))
        return false;
    }
  return true;
}

Evaluation replay(const JournalRecord &record)
{
  switch (record.outcome)
    {
      case JournalRecord::Outcome::value:
        return record.evaluation;
      case JournalRecord::Outcome::tangled:
        throw TangledMesh(record.message);
      case JournalRecord::Outcome::unsolved:
        throw SolveError(record.message);
    }
  return record.evaluation;
}

/// Read a file into @p text. Return whether the file exists and is readable.
bool read_file(const std::string &path, std::string &text)
{
  std::ifstream      in(path, std::ios::binary);
  std::ostringstream bytes;
  if (in && in.peek() != std::ifstream::traits_type::eof())
    bytes << in.rdbuf();
  text = bytes.str();
  return in.is_open() && !in.bad();
}

void broadcast(std::string &text, const MPI_Comm communicator)
{
  unsigned long long size = text.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, communicator);
  text.resize(size);
  constexpr std::size_t piece = 1 << 30;
  for (std::size_t done = 0; done < size; done += piece)
    MPI_Bcast(&text[done], static_cast<int>(std::min<std::size_t>(piece, size - done)), MPI_CHAR, 0,
              communicator);
}
} // namespace

Journal::Journal(const JournalSettings &the_settings) : settings(the_settings)
{
  MPI_Comm_rank(settings.communicator, &rank);
  MPI_Comm_size(settings.communicator, &n_ranks);
  if (settings.restart)
    read();
  if (header_end == 0)
    begin();
}

std::string Journal::warm_start_path(const unsigned int value) const
{
  return settings.directory + "/warm-start." + std::to_string(value % 2);
}

void Journal::say(const std::string &line) const
{
  if (settings.log)
    settings.log(line);
}

void Journal::read()
{
  std::string text;
  throw_collectively(settings.communicator, [&] {
    if (rank == 0 && std::filesystem::exists(path()) && !read_file(path(), text))
      throw InputError("cannot read " + path());
  });
  broadcast(text, settings.communicator);
  auto contents = parse_journal(text, settings.fingerprint, path());
  header_end    = contents.header_end;
  recorded      = std::move(contents.records);
  if (header_end == 0)
    say("restart: no recorded evaluations in " + path() + ", starting from the initial design");
  else
    say("restart: reusing " + counted(recorded.size(), "recorded evaluation") + " of " + path());
}

/// Start an empty journal.
void Journal::begin()
{
  forget_warm_start();
  const std::string header = journal_header(settings.fingerprint);
  header_end               = header.size();
  throw_collectively(settings.communicator, [&] {
    if (rank != 0)
      return;
    file.open(path(), std::ios::binary | std::ios::trunc);
    file << header << std::flush;
    if (!file)
      throw InputError("cannot write " + path());
  });
  is_live = true;
}

/// Cut the file behind record next - 1 and append from there.
void Journal::cut()
{
  const std::size_t end = next == 0 ? header_end : recorded[next - 1].end;
  throw_collectively(settings.communicator, [&] {
    if (rank != 0)
      return;
    std::error_code error;
    std::filesystem::resize_file(path(), end, error);
    file.open(path(), std::ios::binary | std::ios::app);
    if (error || !file)
      throw InputError("cannot write " + path());
  });
}

void Journal::forget_warm_start()
{
  std::error_code ignored;
  for (const unsigned int index : {0, 1})
    if (rank == 0)
      std::filesystem::remove(warm_start_path(index), ignored);
}

/// Load the memory of the problem that is being optimized, as it was after its first @p n values.
void Journal::load_warm_start(const DesignProblem &problem, const unsigned int n)
{
  if (n <= first || !problem.remember)
    return;
  const int before = recorded[next - 1].n_ranks;
  if (before != n_ranks)
    {
      say("restart: recorded on " + counted(before, "rank") + ", continued on " +
          counted(n_ranks, "rank") +
          ": the next solve is a cold start, results agree to the solver tolerance");
      return;
    }
  // All ranks load their data, or none: a solver that starts warm on some ranks takes another path.
  const auto bytes = read_warm_start(settings.communicator, warm_start_path(n - 1));
  int        good  = bytes && problem.remember(*bytes);
  MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, settings.communicator);
  if (good)
    return;
  problem.remember("");
  say(
    "restart: no warm-start data of this problem: the next solve is a cold start, results agree to "
    "the solver tolerance");
}

DesignProblem Journal::journaled(const DesignProblem &problem)
{
  first           = values;
  auto result     = problem;
  result.evaluate = [this, problem](const std::vector<double> &x) { return evaluate(problem, x); };
  if (problem.differentiate)
    result.differentiate = [this, problem](const std::vector<double> &x, Evaluation &evaluation) {
      differentiate(problem, x, evaluation);
    };
  return result;
}

/// Return whether the next record belongs to @p x.
bool Journal::is_replayed(const DesignProblem &problem, const std::vector<double> &x)
{
  if (is_live || next == recorded.size())
    return false;
  if (are_same(problem, recorded[next].x, x))
    {
      ++replayed;
      return true;
    }
  say("restart: evaluation " + std::to_string(next) +
      " requests another design than the recorded one: later records are discarded, the next solve "
      "is a cold start");
  forget_warm_start();
  return false;
}

/// Continue after the last record. The last value is evaluated again if its state is needed.
void Journal::go_live(const DesignProblem &problem, const bool last_again)
{
  if (is_live)
    return;
  cut();
  if (next == recorded.size())
    load_warm_start(problem, last_again ? values - 1 : values);
  is_live = true;
  if (last_again)
    problem.evaluate(last);
}

Evaluation Journal::evaluate(const DesignProblem &problem, const std::vector<double> &x)
{
  const bool is_known = is_replayed(problem, x);
  if (!is_known)
    {
      go_live(problem, false);
      const auto value = recorded_live(problem, x, [&] { return problem.evaluate(x); }, true);
      last             = x;
      return value;
    }
  last = x;
  ++values;
  return replay(recorded[next++]);
}

void Journal::differentiate(const DesignProblem       &problem,
                            const std::vector<double> &x,
                            Evaluation                &evaluation)
{
  if (is_replayed(problem, x))
    {
      evaluation = replay(recorded[next++]);
      return;
    }
  go_live(problem, x == last);
  evaluation = recorded_live(
    problem, x,
    [&] {
      auto differentiated = evaluation;
      problem.differentiate(x, differentiated);
      return differentiated;
    },
    false);
}

/// Return the result of @p work after recording it. Failures are recorded as well.
Evaluation Journal::recorded_live(const DesignProblem               &problem,
                                  const std::vector<double>         &x,
                                  const std::function<Evaluation()> &work,
                                  const bool                         changes_memory)
{
  JournalRecord record;
  record.x       = x;
  record.n_ranks = n_ranks;
  try
    {
      record.evaluation = work();
    }
  catch (const SolveError &error)
    {
      const bool is_tangled = dynamic_cast<const TangledMesh *>(&error) != nullptr;
      record.outcome =
        is_tangled ? JournalRecord::Outcome::tangled : JournalRecord::Outcome::unsolved;
      record.message = error.what();
      store(problem, record, changes_memory);
      throw;
    }
  store(problem, record, changes_memory);
  return record.evaluation;
}

/// Append a record, after the warm-start data if @p stores_memory. Both steps end on all ranks
/// together, so no rank overwrites data of a record that may still be the last one. Collective.
void Journal::store(const DesignProblem &problem,
                    const JournalRecord &record,
                    const bool           stores_memory)
{
  if (problem.memory && stores_memory)
    write_warm_start(settings.communicator, warm_start_path(values), problem.memory);
  throw_collectively(settings.communicator, [&] {
    if (rank != 0)
      return;
    file << journal_text(record, next) << std::flush;
    if (!file)
      throw InputError("cannot write " + path());
  });
  ++next;
  values += stores_memory;
}
} // namespace snug::optimization
