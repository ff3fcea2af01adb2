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
  "Runs snug once per line of standard input, which holds its arguments, separated by tabs,\n"
  "each in a process of its own that may take so much CPU time and address space: it costs\n"
  "a hundredth of a start of the program. Prints a line each: the exit status, or less the\n"
  "number of the signal, the seconds of CPU time, how many lines it said on standard error,\n"
  "and the last of them.\n";

void limit(int resource, rlim_t value)
{
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

/// What snug does with these arguments, in this process, to its end.
[[noreturn]] void become(const std::vector<const char *> &arguments, std::FILE *said)
{
  if (dup2(fileno(said), STDERR_FILENO) < 0 || !std::freopen("/dev/null", "w", stdout))
    _exit(125);
  _exit(app::guarded(MPI_COMM_WORLD, [&]() {
    return app::run(app::parse(int(arguments.size()), arguments.data()));
  }));
}

struct Ending
{
  int         status  = 0;
  double      seconds = 0.;
  std::string said;
};

Ending
end_of(const std::vector<const char *> &arguments, const rlim_t seconds, const rlim_t megabytes)
{
  std::FILE  *said  = std::tmpfile();
  const pid_t child = fork();
  if (child == 0)
    {
      limit(RLIMIT_CPU, seconds);
      limit(RLIMIT_AS, megabytes << 20);
      limit(RLIMIT_CORE, 0);
      // sleeping is not CPU time
      alarm(20 * seconds);
      become(arguments, said);
    }
  int    status;
  rusage usage;
  wait4(child, &status, 0, &usage);
  Ending ending;
  ending.status  = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  ending.seconds = usage.ru_utime.tv_sec + 1e-6 * usage.ru_utime.tv_usec;
  std::rewind(said);
  for (int c = std::fgetc(said); c != EOF; c = std::fgetc(said))
    ending.said += char(c);
  std::fclose(said);
  return ending;
}

/// Run what the lines of standard input say.
void run_all(const rlim_t seconds, const rlim_t megabytes)
{
  for (std::string line; std::getline(std::cin, line);)
    {
      std::vector<std::string> words = {"snug"};
      std::istringstream       fields(line);
      for (std::string word; std::getline(fields, word, '\t');)
        words.push_back(word);
      std::vector<const char *> arguments;
      for (const auto &word : words)
        arguments.push_back(word.c_str());
      const auto         ending = end_of(arguments, seconds, megabytes);
      std::istringstream said(ending.said);
      std::string        last;
      unsigned int       n_lines = 0;
      for (std::string one; std::getline(said, one); ++n_lines)
        last = one;
      std::cout << ending.status << '\t' << ending.seconds << '\t' << n_lines << '\t' << last
                << std::endl;
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
  run_all(std::stoul(argv[1]), std::stoul(argv[2]));
  return 0;
}
