#include <snug/base/errors.h>
#include <snug/base/run_context.h>
#include <snug/optimization/journal.h>

#include <cstring>
#include <filesystem>
#include <sstream>

namespace snug::optimization {
namespace {
bool bitwise_equal(const std::vector<double> &a, const std::vector<double> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
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

/// A file's text; empty if there is none.
std::string read_file(const std::string &path)
{
  if (!std::filesystem::exists(path))
    return "";
  std::ifstream      in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in)
    throw InputError("cannot read " + path);
  return text.str();
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

Journal::Journal(const JournalSettings &settings, const Evaluate &evaluate)
  : settings(settings), evaluate_live(evaluate)
{
  MPI_Comm_rank(settings.communicator, &rank);
  MPI_Comm_size(settings.communicator, &n_ranks);
  if (settings.restart)
    read();
  if (header_end == 0)
    begin();
}

std::string Journal::path() const
{
  return settings.directory + "/journal.txt";
}

std::string Journal::warm_start_path(const unsigned int index) const
{
  return settings.directory + "/warm-start." + std::to_string(rank) + "." +
         std::to_string(index % 2);
}

void Journal::say(const std::string &line) const
{
  if (settings.log)
    settings.log(line);
}

unsigned int Journal::n_replayed() const
{
  return replayed;
}

unsigned int Journal::n_records() const
{
  return is_live ? next : recorded.size();
}

void Journal::read()
{
  std::string text;
  everywhere(settings.communicator, [&] {
    if (rank == 0)
      text = read_file(path());
  });
  broadcast(text, settings.communicator);
  auto contents = parse_journal(text, settings.fingerprint, path());
  header_end    = contents.header_end;
  recorded      = std::move(contents.records);
  if (header_end == 0)
    say("restart: nothing recorded in " + path() + ", starting afresh");
  else
    say("restart: replaying " + std::to_string(recorded.size()) + " evaluations of " + path());
}

/// Start an empty journal.
void Journal::begin()
{
  forget_warm_start();
  const std::string header = journal_header(settings.fingerprint);
  header_end               = header.size();
  everywhere(settings.communicator, [&] {
    if (rank != 0)
      return;
    file.open(path(), std::ios::binary | std::ios::trunc);
    file << header << std::flush;
    if (!file)
      throw InputError("cannot write " + path());
  });
  is_live = true;
}

/// The record is exhausted: go on from its state, behind its last record.
void Journal::resume()
{
  cut();
  load_warm_start();
  is_live = true;
}

/// Cut the file behind record next - 1 and append from there.
void Journal::cut()
{
  const std::size_t end = next == 0 ? header_end : recorded[next - 1].end;
  everywhere(settings.communicator, [&] {
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
    std::filesystem::remove(warm_start_path(index), ignored);
}

void Journal::load_warm_start()
{
  if (next == 0 || !settings.load_warm_start)
    return;
  const unsigned int index  = next - 1;
  const int          before = recorded[index].n_ranks;
  if (before != n_ranks)
    {
      say("restart: written on " + std::to_string(before) + " ranks, continued on " +
          std::to_string(n_ranks) + ": the solver starts cold, results agree to its tolerance");
      return;
    }
  const int here = std::filesystem::exists(warm_start_path(index));
  int       everyone;
  MPI_Allreduce(&here, &everyone, 1, MPI_INT, MPI_MIN, settings.communicator);
  if (!everyone)
    {
      say("restart: no warm-start data: the solver starts cold, results "
          "agree to its tolerance");
      return;
    }
  everywhere(settings.communicator,
             [&] { settings.load_warm_start(index, warm_start_path(index)); });
}

Evaluation Journal::evaluate(const std::vector<double> &x)
{
  if (!is_live && next < recorded.size() && bitwise_equal(recorded[next].x, x))
    {
      ++replayed;
      return replay(recorded[next++]);
    }
  if (!is_live && next < recorded.size())
    {
      say("restart: evaluation " + std::to_string(next) +
          " asks for another design than the one recorded: the record is "
          "cut there, the solver starts cold");
      forget_warm_start();
      cut();
      is_live = true;
    }
  if (!is_live)
    resume();

  JournalRecord record;
  record.x       = x;
  record.n_ranks = n_ranks;
  try
    {
      record.evaluation = evaluate_live(x);
    }
  catch (const TangledMesh &error)
    {
      record.outcome = JournalRecord::Outcome::tangled;
      record.message = error.what();
      store(record);
      throw;
    }
  catch (const SolveError &error)
    {
      record.outcome = JournalRecord::Outcome::unsolved;
      record.message = error.what();
      store(record);
      throw;
    }
  store(record);
  return record.evaluation;
}

/// Append; warm-start data first. Both steps end on all ranks together, so
/// no rank overwrites data of a record that may still be the last one.
void Journal::store(JournalRecord &record)
{
  if (settings.save_warm_start)
    everywhere(settings.communicator, [&] {
      const std::string final_path = warm_start_path(next);
      const std::string temporary  = final_path + ".new";
      settings.save_warm_start(next, temporary);
      std::error_code error;
      std::filesystem::rename(temporary, final_path, error);
      if (error)
        throw InputError("cannot write " + final_path);
    });
  everywhere(settings.communicator, [&] {
    if (rank != 0)
      return;
    file << journal_text(record, next) << std::flush;
    if (!file)
      throw InputError("cannot write " + path());
  });
  ++next;
}
} // namespace snug::optimization
