#include <snug/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <random/checks.h>
#include <random/random_scene.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>

namespace {
using namespace snug::test;

const char usage[] =
  "usage: random.problems FIRST LAST | NUMBER | FILE.prm\n"
  "Solves random contact problems FIRST to LAST and compares with dense algebra:\n"
  "is there an equilibrium, what are forces and displacements. Or one, which is\n"
  "printed as a parameter file, or that of a file. The exit status is 1 if one is wrong.\n";

/// Outcomes of the problems of one kind.
struct Tally
{
  std::array<unsigned int, 6> counts{};
  double                      force_error = 0., displacement_error = 0.;
  std::vector<unsigned long>  f_mults;

  void add(const Outcome &outcome)
  {
    ++counts[outcome.kind];
    force_error        = std::max(force_error, outcome.force_error);
    displacement_error = std::max(displacement_error, outcome.displacement_error);
    if (outcome.kind == Outcome::solved || outcome.kind == Outcome::neutral)
      f_mults.push_back(outcome.f_mults);
  }

  void print(const std::string &name)
  {
    std::sort(f_mults.begin(), f_mults.end());
    std::cout << "| " << name << " |";
    unsigned int all = 0;
    for (const unsigned int count : counts)
      all += count;
    std::cout << ' ' << all << " |";
    for (const unsigned int count : counts)
      std::cout << ' ' << count << " |";
    std::cout << std::setprecision(2) << ' ' << force_error << " | " << displacement_error << " | "
              << (f_mults.empty() ? 0 : f_mults[f_mults.size() / 2]) << " | "
              << (f_mults.empty() ? 0 : f_mults.back()) << " |\n";
  }
};

/// One line of what is not as it should be, or of all.
void report(const std::string &name, const Outcome &outcome, bool all)
{
  if (outcome.message.empty() && !all)
    return;
  std::cout << name << ": " << (outcome.kind == Outcome::wrong ? "WRONG: " : "") << outcome.message
            << std::setprecision(2) << "; errors " << outcome.force_error << ", "
            << outcome.displacement_error << ", F-mults " << outcome.f_mults << std::endl;
}

bool run_file(const std::string &file, bool prints)
{
  const auto outcome = check_scene(file, snug::scene::read_text(file));
  if (prints)
    report(file, outcome, true);
  return outcome.kind == Outcome::wrong;
}

/// Return whether the outcome of a problem is wrong.
bool run(unsigned int first, unsigned int last, bool prints)
{
  std::vector<Tally> tallies(kinds().size());
  unsigned int       n_wrong = 0;
  for (unsigned int number = first; number <= last; ++number)
    {
      const auto name    = "random-" + std::to_string(number) + ".prm";
      const auto outcome = check_scene(name, random_scene(number));
      tallies[number % tallies.size()].add(outcome);
      n_wrong += outcome.kind == Outcome::wrong;
      if (prints && first == last)
        std::cout << random_scene(number);
      if (prints)
        report("# " + name, outcome, first == last);
    }
  if (prints && last > first)
    {
      std::cout << "| kind | problems | solved | solved, free to move | no equilibrium | undecided "
                   "| invalid | wrong | error of forces | of displacements | F-mults, median | "
                   "most |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
      for (unsigned int k = 0; k < tallies.size(); ++k)
        tallies[k].print(kinds()[k]);
    }
  return n_wrong > 0;
}
} // namespace

int main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool prints = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  try
    {
      const std::string first = argc > 1 ? argv[1] : "", end = ".prm";
      if (argc == 2 && first.size() > end.size() &&
          first.compare(first.size() - end.size(), end.size(), end) == 0)
        return run_file(first, prints);
      if (argc == 2 || argc == 3)
        return run(std::stoul(first), std::stoul(argv[argc - 1]), prints);
      std::cerr << usage;
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      MPI_Abort(MPI_COMM_WORLD, 2);
    }
  return 2;
}
