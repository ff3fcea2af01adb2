#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/run_context.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <sstream>
#include <streambuf>

namespace snug {
namespace {
std::ostream &null_stream()
{
  static std::ostream stream(nullptr);
  return stream;
}

double of_stage(const std::map<std::string, double> &stages, const std::string &stage)
{
  const auto found = stages.find(stage);
  return found == stages.end() ? 0. : found->second;
}

/// Return the resident pages of this process alone [MB]; 0 if there is no /proc.
double private_memory()
{
  std::ifstream file("/proc/self/statm");
  double        size = 0., resident = 0., shared = 0.;
  if (!(file >> size >> resident >> shared))
    return 0.;
  return (resident - shared) * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Return whether an MPI launcher runs the program. Launchers put a pseudo terminal between the
/// program and a file.
bool under_launcher()
{
  for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_PROCID"})
    if (std::getenv(name) != nullptr)
      return true;
  return false;
}
} // namespace

RunContext::RunContext(MPI_Comm communicator, std::ostream &out)
  : comm(communicator)
  , my_rank(0)
  , size(1)
  , stream(&out)
  , live_line(false)
  , start_memory(private_memory())
  , start(std::chrono::steady_clock::now())
{
  int r, s;
  MPI_Comm_rank(comm, &r);
  MPI_Comm_size(comm, &s);
  my_rank = r;
  size    = s;
  if (my_rank != 0)
    stream = &null_stream();
  live_line = my_rank == 0 && &out == &std::cout && isatty(STDOUT_FILENO) && !under_launcher();
}

std::ostream &RunContext::out(const Verbosity level)
{
  if (level > verbosity)
    return null_stream();
  if (live_line_shown)
    *stream << "\r\033[K";
  live_line_shown = false;
  return *stream;
}

void RunContext::warn(const Warning &warning)
{
  if (std::any_of(kept_warnings.begin(), kept_warnings.end(),
                  [&](const Warning &kept) { return kept.text == warning.text; }))
    return;
  kept_warnings.push_back(warning);
  out(Verbosity::quiet) << "warning: " << warning.text << std::endl;
}

void RunContext::warn(const std::string &code, const std::vector<std::string> &lines)
{
  for (const std::string &line : lines)
    warn({code, line});
}

void RunContext::progress(const std::string &text)
{
  if (!live_line || verbosity == Verbosity::quiet)
    return;
  *stream << "\r\033[K" << text << std::flush;
  live_line_shown = true;
}

RunContext::Timer::Timer(RunContext &the_context, const std::string &the_stage)
  : context(the_context), stage(the_stage), start(std::chrono::steady_clock::now())
{
  // Mark the stage as a region for profilers of MPI. The call does nothing without one.
  MPI_Pcontrol(1, stage.c_str());
}

RunContext::Timer::~Timer()
{
  const std::chrono::duration<double> life = std::chrono::steady_clock::now() - start;
  context.stage_seconds[stage] += life.count();
  double &memory = context.stage_memory[stage];
  memory         = std::max(memory, private_memory());
  MPI_Pcontrol(-1, stage.c_str());
}

double RunContext::seconds(const std::string &stage) const
{
  return of_stage(stage_seconds, stage);
}

double RunContext::memory(const std::string &stage) const
{
  return of_stage(stage_memory, stage);
}

double RunContext::seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Work RunContext::total_work() const
{
  Work          total    = work;
  unsigned long local[4] = {work.symbolic_factorizations, work.numeric_factorizations,
                            work.assembled_subdomains, work.subdomain_solves};
  unsigned long sum[4];
  MPI_Allreduce(local, sum, 4, MPI_UNSIGNED_LONG, MPI_SUM, comm);
  total.symbolic_factorizations = sum[0];
  total.numeric_factorizations  = sum[1];
  total.assembled_subdomains    = sum[2];
  total.subdomain_solves        = sum[3];
  return total;
}

namespace {
/// Kinds of errors that are preserved on the other ranks.
enum Kind : int
{
  none,
  input,
  solve,
  tangled,
  memory,
  other
};

Kind kind_of(const std::exception &error)
{
  if (dynamic_cast<const InputError *>(&error) != nullptr)
    return input;
  if (dynamic_cast<const TangledMesh *>(&error) != nullptr)
    return tangled;
  if (dynamic_cast<const SolveError *>(&error) != nullptr)
    return solve;
  return is_out_of_memory(error) ? memory : other;
}

/// Return the message of an error, with a line for each member of an InputError.
std::string packed(const std::exception &error)
{
  const auto *input = dynamic_cast<const InputError *>(&error);
  if (input == nullptr)
    return one_line(error);
  const auto &wrong = input->wrong();
  std::string lines;
  for (std::string line : {input->text(), input->place().file, std::to_string(input->place().line),
                           wrong.entry, wrong.value, wrong.allowed, wrong.suggestion})
    {
      std::replace(line.begin(), line.end(), '\n', ' ');
      lines += line + "\n";
    }
  return lines;
}

InputError unpacked(const std::string &lines)
{
  std::istringstream       in(lines);
  std::vector<std::string> member(7);
  for (auto &line : member)
    std::getline(in, line);
  return InputError(member[0], {member[1], static_cast<unsigned int>(std::stoul(member[2]))},
                    {member[3], member[4], member[5], member[6]});
}

[[noreturn]] void throw_again(int kind, const std::string &message)
{
  switch (kind)
    {
      case input:
        throw unpacked(message);
      case solve:
        throw SolveError(message);
      case tangled:
        throw TangledMesh(message);
      case memory:
        throw std::bad_alloc();
      default:
        throw std::runtime_error(message);
    }
}
} // namespace

void throw_collectively(MPI_Comm communicator, const std::function<void()> &work)
{
  int         kind = none;
  std::string message;
  try
    {
      work();
    }
  catch (const std::exception &error)
    {
      kind = kind_of(error);
      if (kind != memory) // a message would need memory
        message = packed(error);
    }
  catch (...)
    {
      kind    = other;
      message = "unknown error";
    }
  int rank, size;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &size);
  const int mine    = kind == none ? size : rank;
  int       failing = size;
  MPI_Allreduce(&mine, &failing, 1, MPI_INT, MPI_MIN, communicator);
  if (failing == size)
    return;
  int head[2] = {kind, narrow<int>(message.size())};
  MPI_Bcast(head, 2, MPI_INT, failing, communicator);
  message.resize(head[1]);
  MPI_Bcast(&message[0], head[1], MPI_CHAR, failing, communicator);
  throw_again(head[0], message);
}
} // namespace snug
