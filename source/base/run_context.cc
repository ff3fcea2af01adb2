#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/base/run_context.h>

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <streambuf>

namespace snug {
namespace {
std::ostream &null_stream()
{
  static std::ostream stream(nullptr);
  return stream;
}
/// MPI launchers put a pseudo terminal between the program and a file.
bool under_launcher()
{
  for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SLURM_PROCID"})
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

std::ostream &RunContext::out()
{
  if (live_line_shown)
    *stream << "\r\033[K";
  live_line_shown = false;
  return *stream;
}

void RunContext::progress(const std::string &text)
{
  if (!live_line)
    return;
  *stream << "\r\033[K" << text << std::flush;
  live_line_shown = true;
}

RunContext::Timer::Timer(RunContext &the_context, const std::string &the_stage)
  : context(the_context), stage(the_stage), start(std::chrono::steady_clock::now())
{}

RunContext::Timer::~Timer()
{
  const std::chrono::duration<double> life = std::chrono::steady_clock::now() - start;
  context.stage_seconds[stage] += life.count();
}

double RunContext::seconds(const std::string &stage) const
{
  const auto found = stage_seconds.find(stage);
  return found == stage_seconds.end() ? 0. : found->second;
}

double RunContext::seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Work RunContext::total_work() const
{
  Work          total    = work;
  unsigned long local[3] = {work.symbolic_factorizations, work.numeric_factorizations,
                            work.assembled_subdomains};
  unsigned long sum[3];
  MPI_Allreduce(local, sum, 3, MPI_UNSIGNED_LONG, MPI_SUM, comm);
  total.symbolic_factorizations = sum[0];
  total.numeric_factorizations  = sum[1];
  total.assembled_subdomains    = sum[2];
  return total;
}

namespace internal {
int kind_of_current_exception(std::string &message)
{
  try
    {
      throw;
    }
  catch (const InputError &error)
    {
      message = error.what();
      return 1;
    }
  catch (const TangledMesh &error)
    {
      message = error.what();
      return 3;
    }
  catch (const SolveError &error)
    {
      message = error.what();
      return 2;
    }
  catch (const std::exception &error)
    {
      message = error.what();
      return 4;
    }
  catch (...)
    {
      message = "unknown error";
      return 4;
    }
}

void rethrow_together(MPI_Comm comm, int kind, const std::string &message)
{
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int mine    = kind == 0 ? size : rank;
  int       failing = size;
  MPI_Allreduce(&mine, &failing, 1, MPI_INT, MPI_MIN, comm);
  if (failing == size)
    return;
  MPI_Bcast(&kind, 1, MPI_INT, failing, comm);
  int length = narrow<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, failing, comm);
  std::string text = message;
  text.resize(length);
  MPI_Bcast(&text[0], length, MPI_CHAR, failing, comm);
  if (kind == 1)
    throw InputError(text);
  if (kind == 2)
    throw SolveError(text);
  if (kind == 3)
    throw TangledMesh(text);
  throw std::runtime_error(text);
}
} // namespace internal
} // namespace snug
