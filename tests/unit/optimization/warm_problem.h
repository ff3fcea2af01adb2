#ifndef snug_unit_optimization_warm_problem_h
#define snug_unit_optimization_warm_problem_h

#include <snug/base/errors.h>
#include <snug/optimization/journal.h>
#include <snug/optimization/minimize.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include "problems.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

/// Exception that stands for the end of the process by a signal.
struct Killed : std::runtime_error
{
  Killed() : std::runtime_error("killed") {}
};

inline int this_rank()
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int n_all_ranks()
{
  int size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

/// A directory of its own, shared by the ranks, removed at the end.
class Folder
{
public:
  Folder()
  {
    int id = getpid();
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path =
      (std::filesystem::temp_directory_path() / ("snug-journal-" + std::to_string(id))).string();
    if (this_rank() == 0)
      std::filesystem::create_directory(path);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Folder()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (this_rank() == 0)
      std::filesystem::remove_all(path);
    MPI_Barrier(MPI_COMM_WORLD);
  }

  std::string text() const
  {
    MPI_Barrier(MPI_COMM_WORLD);
    std::ifstream      in(path + "/journal.txt", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    MPI_Barrier(MPI_COMM_WORLD);
    return text.str();
  }

  void write(const std::string &text) const
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (this_rank() == 0)
      std::ofstream(path + "/journal.txt", std::ios::binary) << text;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  std::string path;
};

/// A design problem whose values depend, at 1e-9, on the designs before:
/// like a solver that starts warm. It can be killed. Asked to, it gives gradients on demand only,
/// of the state it has.
class WarmProblem
{
public:
  enum class Where
  {
    nowhere,
    evaluating,
    differentiating,
    saving
  };

  explicit WarmProblem(const std::string &directory, bool restart = false, bool on_demand = false)
    : problem(with_hole(rosenbrock_on_circle(), 0.6, 10.)), inner(problem.evaluate)
  {
    settings.directory    = directory;
    settings.fingerprint  = "variables = 2\nobjective = energy";
    settings.restart      = restart;
    settings.communicator = MPI_COMM_WORLD;
    settings.log          = [this](const std::string &line) { log += line + '\n'; };
    problem.evaluate      = [this](const std::vector<double> &x) { return live(x); };
    if (on_demand)
      {
        problem.evaluate = [this](const std::vector<double> &x) {
          auto value = live(x);
          value.gradient.clear();
          value.jacobian.clear();
          state_design = x;
          state_memory = memory;
          return value;
        };
        problem.differentiate = [this](const std::vector<double>      &x,
                                       snug::optimization::Evaluation &evaluation) {
          differentiate(x, evaluation);
        };
      }
    problem.memory = [this]() {
      die(Where::saving, live_before + n_live - 1);
      std::ostringstream bytes;
      bytes << std::hexfloat << memory + this_rank() << '.';
      return bytes.str();
    };
    problem.remember = [this](const std::string &bytes) {
      const bool whole = !bytes.empty() && bytes.back() == '.';
      memory           = whole ? std::strtod(bytes.c_str(), nullptr) - this_rank() : 0.;
      began_cold       = !whole;
      n_loads += whole;
      return whole;
    };
  }

  snug::optimization::Evaluation live(const std::vector<double> &x)
  {
    die(Where::evaluating, live_before + n_live);
    ++n_live;
    // exact in binary: saved as memory + rank
    memory     = std::floor(memory / 2. + 1000. * x[0] + 100. * x[1]);
    auto value = inner(x);
    value.objective += 1e-9 * std::sin(memory);
    value.f_mults = memory * memory;
    value.seconds = 0.1 * x[0];
    return value;
  }

  void differentiate(const std::vector<double> &x, snug::optimization::Evaluation &evaluation)
  {
    die(Where::differentiating, n_differentiated);
    ++n_differentiated;
    if (state_design != x) // solved again, from what is remembered
      {
        state_design = x;
        state_memory = memory;
      }
    const auto value    = inner(x);
    evaluation.gradient = value.gradient;
    evaluation.gradient[0] += 1e-9 * std::sin(state_memory);
    evaluation.jacobian = value.jacobian;
  }

  snug::optimization::OptimizationResult run()
  {
    snug::optimization::Journal journal(settings);
    live_before = journal.n_records();
    snug::optimization::Hooks hooks;
    hooks.on_iteration = [this](const snug::optimization::Iteration &iteration) {
      path.push_back(iteration);
    };
    snug::optimization::OptimizationParameters parameters;
    parameters.maximum_evaluations = 40;
    const auto result              = minimize(journal.journaled(problem), parameters, hooks);
    n_replayed                     = journal.n_replayed();
    return result;
  }

  snug::optimization::JournalSettings        settings;
  snug::optimization::DesignProblem          problem;
  std::string                                log;
  std::vector<snug::optimization::Iteration> path;
  unsigned int                               n_live = 0, n_loads = 0, n_replayed = 0;
  unsigned int                               n_differentiated = 0;
  bool                                       began_cold       = false;
  Where                                      where            = Where::nowhere;
  unsigned int                               when             = 0;

private:
  void die(Where place, unsigned int index) const
  {
    if (where == place && when == index)
      throw Killed();
  }

  decltype(snug::optimization::DesignProblem::evaluate) inner;
  double                                                memory = 0.;
  std::vector<double>                                   state_design;
  double                                                state_memory = 0.;
  unsigned int                                          live_before  = 0;
};

inline bool same_bits(const std::vector<double> &a, const std::vector<double> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

#endif
