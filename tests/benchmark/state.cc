#include <snug/app/build_model.h>
#include <snug/app/failure.h>
#include <snug/base/narrow.h>
#include <snug/io/summary.h>
#include <snug/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <petscsys.h>

#include <benchmark/linear_solver.h>
#include <benchmark/torn.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace {
using namespace snug;
using namespace snug::benchmark;

/// One line of the table: cells per cube edge, subdomains of both bodies
/// (0: by size).
struct Size
{
  unsigned int cells, subdomains;
};

/// Times of one side, for each repetition.
struct Times
{
  std::vector<Seconds> factor, solve;

  std::vector<Seconds> both() const
  {
    std::vector<Seconds> total;
    for (unsigned int i = 0; i < factor.size(); ++i)
      total.push_back(factor[i] + solve[i]);
    return total;
  }
};

std::string cpu_name()
{
  std::ifstream file("/proc/cpuinfo");
  std::string   line;
  while (std::getline(file, line))
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  return "unknown";
}

scene::Scene make_scene(const std::string &file, const Size &size)
{
  const std::string        n     = std::to_string(size.cells);
  const std::string        cells = "/Box cells=" + n + ',' + n + ',' + n;
  std::vector<std::string> sets  = {"Task=state", "Body punch" + cells, "Body foundation" + cells};
  if (size.subdomains > 0)
    sets.push_back("Decomposition/Subdomains=" + std::to_string(size.subdomains));
  return scene::read_scene({file, scene::read_text(file), sets, ""});
}

/// Everything of one size: mesh, the state solved once, both sides.
class Case
{
public:
  Case(const std::string &file, const Size &size)
    : context(MPI_COMM_WORLD, log)
    , scene(make_scene(file, size))
    , mesh(MPI_COMM_WORLD,
           app::mesh_parameters(scene),
           scene.degree,
           mesh::Idealization::natural(3),
           scene.tearing)
    , tearing(mesh::tear(mesh))
    , solver(mesh, tearing, app::build_model(scene, mesh), mesh.reference_positions(), context)
  {
    const auto &dual = solver.feti(solver.solve(mesh.reference_positions(), qp::WarmStart()));
    torn             = std::make_unique<Torn>(solver, dual, context);
    bonded           = std::make_unique<Bonded>(solver, dual);
    for (const LinearMethod &method : linear_methods())
      linear.push_back(std::make_unique<LinearSolver>(*bonded, method));
  }

  /// Return the times of the state, then of the linear methods.
  std::vector<Times> run(const unsigned int repeats)
  {
    std::vector<Times> times(1 + linear.size());
    // the first time touches the memory of the factors
    for (unsigned int i = 0; i <= repeats; ++i)
      {
        time(*torn, times[0], i > 0);
        for (unsigned int m = 0; m < linear.size(); ++m)
          time(*linear[m], times[1 + m], i > 0);
      }
    return times;
  }

  std::ostringstream      log;
  RunContext              context;
  scene::Scene            scene;
  mesh::BodyMesh<3>       mesh;
  mesh::Tearing           tearing;
  state::StateSolver<3>   solver;
  std::unique_ptr<Torn>   torn;
  std::unique_ptr<Bonded> bonded;

  std::vector<std::unique_ptr<LinearSolver>> linear;

private:
  template <typename Side>
  static void time(Side &side, Times &times, const bool counts)
  {
    const Seconds factor = measure([&]() { side.factorize(); });
    const Seconds solve  = measure([&]() { side.solve(); });
    if (!counts)
      return;
    times.factor.push_back(factor);
    times.solve.push_back(solve);
  }
};

/// Ratio of the medians, then the range of the ratios of single repeats.
std::string ratio(const Times &state, const Times &other, double Seconds::*clock)
{
  const auto torn = state.both(), bonded = other.both();
  double     least = torn[0].*clock / (bonded[0].*clock), most = least;
  for (unsigned int i = 1; i < torn.size(); ++i)
    {
      least = std::min(least, torn[i].*clock / (bonded[i].*clock));
      most  = std::max(most, torn[i].*clock / (bonded[i].*clock));
    }
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << median(torn).*clock / (median(bonded).*clock)
       << " (" << least << '-' << most << ')';
  return text.str();
}

void print_head(const RunContext &context, unsigned int repeats)
{
  const auto program = io::program_info(context);
  std::cout << "The contact state (Total FETI, cold) against one linear solve of the "
               "bonded bodies\n"
            << "one core of " << cpu_name() << ", BLAS " << program.blas << ", " << program.compiler
            << '\n';
  for (const auto &method : linear_methods())
    std::cout << method.name << ": " << method.options << '\n';
  std::cout << "numeric factorization (set-up of multigrid) + solve, CPU seconds, medians of "
            << repeats << " interleaved repeats; ratios: of the medians (range)\n\n"
            << " cells   H/h  subdomains  unknowns  solver    steps   factor    solve"
               "  state over it: CPU  wall\n";
}

/// F-mults of the state, iterations of the others.
void print_row(const std::string &name, const unsigned int steps, const Times &times)
{
  std::cout << "  " << std::left << std::setw(9) << name << std::right << std::setw(6) << steps
            << std::fixed << std::setprecision(3) << std::setw(9) << median(times.factor).cpu
            << std::setw(9) << median(times.solve).cpu;
}

void print_rows(const Size &size, const Case &c, const std::vector<Times> &times)
{
  const double cells_each = double(c.mesh.n_global_cells()) / c.tearing.n_global;
  std::cout << std::fixed << std::setw(4) << size.cells << "^3" << std::setw(6)
            << std::setprecision(1) << std::cbrt(cells_each) << std::setw(12) << c.tearing.n_global
            << std::setw(10) << 3 * c.mesh.n_global_free_nodes();
  print_row("state", narrow<unsigned int>(c.torn->f_mults()), times[0]);
  std::cout << '\n';
  for (unsigned int m = 0; m < c.linear.size(); ++m)
    {
      std::cout << std::string(34, ' ');
      print_row(c.linear[m]->method.name, c.linear[m]->iterations(), times[1 + m]);
      std::cout << "  " << std::left << std::setw(19)
                << ratio(times[0], times[1 + m], &Seconds::cpu)
                << ratio(times[0], times[1 + m], &Seconds::wall) << std::right << std::endl;
    }
}

void print_stages(std::ostream             &out,
                  const Size               &size,
                  const Case               &c,
                  const std::vector<Stage> &stages)
{
  out << '\n'
      << size.cells << "^3 cells, " << c.tearing.n_global
      << " subdomains, CPU seconds: count x each = all\n"
      << std::fixed;
  for (const Stage &stage : stages)
    out << "  " << std::left << std::setw(50) << stage.name << std::right << std::setw(4)
        << stage.count << " x " << std::setprecision(5) << stage.each.cpu << " = "
        << std::setprecision(3) << stage.count * stage.each.cpu << '\n';
}

int run(const std::string &file, const std::vector<Size> &sizes, unsigned int repeats)
{
  std::ostringstream breakdowns;
  print_head(RunContext(MPI_COMM_WORLD, breakdowns), repeats);
  for (const Size &size : sizes)
    {
      Case       c(file, size);
      const auto times = c.run(repeats);
      print_rows(size, c, times);
      print_stages(breakdowns, size, c, c.torn->stages(median(times[0].both())));
    }
  std::cout << breakdowns.str();
  return 0;
}

/// "20:250" or "19".
Size parse_size(const std::string &text)
{
  Size               size = {0, 0};
  char               colon;
  std::istringstream in(text);
  if (!(in >> size.cells) || (in >> colon && !(in >> size.subdomains)))
    throw InputError("a size is CELLS or CELLS:SUBDOMAINS, not '" + text + "'");
  return size;
}

const char *const usage = "usage: benchmark.state FILE.prm REPEATS CELLS[:SUBDOMAINS]...\n";
} // namespace

int main(int argc, char *argv[])
{
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
  if (argc < 4)
    {
      std::cerr << usage;
      return 2;
    }
  int                                      no_options = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_options, argv, 1);
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  return app::guarded(MPI_COMM_WORLD, [&]() {
    std::vector<Size> sizes;
    for (int i = 3; i < argc; ++i)
      sizes.push_back(parse_size(argv[i]));
    return run(argv[1], sizes, std::max(1, std::atoi(argv[2])));
  });
}
