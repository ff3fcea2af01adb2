#include <snug/app/command_line.h>
#include <snug/app/failure.h>
#include <snug/app/study.h>
#include <snug/base/petsc_handle.h>

#include <deal.II/base/mpi.h>

#include <sys/resource.h>
#include <sys/wait.h>

#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace {
using namespace snug;

const char usage[] =
  "usage: stability.many SECONDS MEGABYTES\n"
  "Runs snug once per line of standard input, which holds its arguments, separated by tabs:\n"
  "on one rank each in a process of its own that may take so much CPU time and address space,\n"
  "on several ranks one after the other. Starts of the program take longer than most scenes.\n"
  "Prints a line each: the exit status, or less the number of the signal, the seconds of CPU\n"
  "time, how many lines all ranks said on standard error, and the last of them.\n";

struct Limits
{
  rlim_t seconds, megabytes;
};

struct Ending
{
  int         status  = 0;
  double      seconds = 0.;
  std::string said;
};

void limit(int resource, rlim_t value)
{
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

double cpu_seconds(const rusage &usage)
{
  return usage.ru_utime.tv_sec + 1e-6 * usage.ru_utime.tv_usec;
}

int run(const std::vector<std::string> &words)
{
  std::vector<const char *> arguments = {"snug"};
  for (const auto &word : words)
    arguments.push_back(word.c_str());
  return app::guarded(MPI_COMM_WORLD, [&]() {
    return app::run(app::parse(int(arguments.size()), arguments.data()));
  });
}

/// Run in a child, which crashes and ends alone.
Ending end_of_child(const std::vector<std::string> &words, const Limits &limits)
{
  std::FILE  *said  = std::tmpfile();
  const pid_t child = fork();
  if (child == 0)
    {
      limit(RLIMIT_CPU, limits.seconds);
      limit(RLIMIT_AS, limits.megabytes << 20);
      limit(RLIMIT_CORE, 0);
      // sleeping is not CPU time
      alarm(20 * limits.seconds);
      if (dup2(fileno(said), STDERR_FILENO) < 0 || !std::freopen("/dev/null", "w", stdout))
        _exit(125);
      _exit(run(words));
    }
  int    status;
  rusage usage;
  wait4(child, &status, 0, &usage);
  Ending ending;
  ending.status  = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  ending.seconds = cpu_seconds(usage);
  std::rewind(said);
  for (int c = std::fgetc(said); c != EOF; c = std::fgetc(said))
    ending.said += char(c);
  std::fclose(said);
  return ending;
}

/// Return what all ranks said, one after the other, on rank 0.
std::string gathered(const std::string &said)
{
  std::string all;
  for (const auto &of_rank : dealii::Utilities::MPI::gather(MPI_COMM_WORLD, said))
    all += of_rank;
  return all;
}

/// Run here, on all ranks; the time is that of this one.
Ending end_of_run(const std::vector<std::string> &words)
{
  std::ostringstream said, log;
  rusage             before, after;
  auto *const err = std::cerr.rdbuf(said.rdbuf()), *const out = std::cout.rdbuf(log.rdbuf());
  getrusage(RUSAGE_SELF, &before);
  Ending ending;
  ending.status = run(words);
  getrusage(RUSAGE_SELF, &after);
  std::cerr.rdbuf(err);
  std::cout.rdbuf(out);
  ending.seconds = cpu_seconds(after) - cpu_seconds(before);
  ending.said    = gathered(said.str());
  return ending;
}

/// The next line of standard input, on all ranks; false at its end.
bool next_line(std::string &line)
{
  using namespace dealii::Utilities::MPI;
  const bool good = this_mpi_process(MPI_COMM_WORLD) > 0 || bool(std::getline(std::cin, line));
  line            = broadcast(MPI_COMM_WORLD, line);
  return broadcast(MPI_COMM_WORLD, good);
}

void print(const Ending &ending)
{
  std::istringstream said(ending.said);
  std::string        last;
  unsigned int       n_lines = 0;
  for (std::string one; std::getline(said, one); ++n_lines)
    last = one;
  std::cout << ending.status << '\t' << ending.seconds << '\t' << n_lines << '\t' << last
            << std::endl;
}

void run_all(const Limits &limits)
{
  const bool alone = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  for (std::string line; next_line(line);)
    {
      std::vector<std::string> words;
      std::istringstream       fields(line);
      for (std::string word; std::getline(fields, word, '\t');)
        words.push_back(word);
      const auto ending = alone ? end_of_child(words, limits) : end_of_run(words);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        print(ending);
    }
}
} // namespace

int main(int argc, char *argv[])
{
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
  int                                      no_options = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);
  petsc::return_errors();
  PetscPopSignalHandler();
  if (argc != 3)
    {
      std::cerr << usage;
      return 2;
    }
  run_all({std::stoul(argv[1]), std::stoul(argv[2])});
  return 0;
}
