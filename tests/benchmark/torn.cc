#include <snug/base/narrow.h>
#include <snug/feti/initial_active_set.h>
#include <snug/state/certificate.h>

#include <benchmark/torn.h>

namespace snug::benchmark {
namespace {
const unsigned int repeats = 7;

feti::SubdomainTable subdomain_table(const state::StateSolver<3> &solver)
{
  feti::SubdomainTable table;
  table.n_modes    = 6;
  table.body_names = solver.model().body_names;
  for (const auto &subdomain : solver.tearing().subdomains)
    table.body.push_back(subdomain.body);
  return table;
}

/// The part of the wanted tolerance at which StateSolver begins.
const double margin = 0.25;
} // namespace

Torn::Torn(const state::StateSolver<3> &solver,
           const feti::LoadedProblem   &dual,
           RunContext                  &context)
  : solver(solver)
  , dual(dual)
  , context(context)
  , cache(solver.model().feti.factorization, context)
  , structure(solver.gluing(0).layout(), subdomain_table(solver), solver.model().feti, cache)
  , soft_modes(std::make_shared<const feti::DeflationStructure>(structure.coarse,
                                                                unsigned(dual.loads().size()),
                                                                std::vector<feti::RowForces>(),
                                                                1))
  , pairs{{}, 1, 3}
{
  for (const auto is_contact : dual.bounded())
    pairs.of_row.push_back(is_contact ? 0 : 1);
}

/// Linearize anew with the operators of an earlier linearization; null ones are computed.
void Torn::linearize(feti::SharedOperators shared)
{
  problem.reset();
  linearization.reset();
  const auto &now = dual.linearization();
  linearization =
    std::make_unique<feti::Linearization>(structure, now.subdomains(), now.B(), std::move(shared));
  problem = std::make_unique<feti::LoadedProblem>(*linearization, dual.loads(), dual.g(), &pairs);
}

void Torn::factorize()
{
  feti::SharedOperators operators(narrow<unsigned int>(dual.loads().size()));
  operators.soft_modes = soft_modes;
  linearize(std::move(operators));
}

void Torn::solve()
{
  const Work           before     = context.work;
  const double         wanted     = solver.model().solver.relative_tolerance;
  qp::SolverParameters parameters = solver.model().solver;
  qp::WarmStart        start;
  double               error = wanted;
  outer_iterations           = 0;
  do
    {
      parameters.relative_tolerance *= margin;
      auto dual =
        choose(qp::solver_table(), parameters.method).make(parameters)->solve(*problem, start);
      const auto u = linearization->recover(problem->loads(), dual.lambda, dual.amplitudes);
      error        = state::certify(*problem, dual.lambda, u).worst();
      start        = {dual.lambda, dual.active};
      outer_iterations += dual.outer_iterations;
  } while (error > wanted);
  active = start.active;
  work   = context.work;
  work.f_mults -= before.f_mults;
  work.preconditioner_applications -= before.preconditioner_applications;
  work.coarse_solves -= before.coarse_solves;
}

Stage Torn::factorization_of_inverses() const
{
  const feti::FactorCache own(solver.model().feti.factorization, context);
  std::vector<std::unique_ptr<feti::GeneralizedInverse>> inverses;
  const auto                                             factorize = [&]() {
    inverses.clear();
    for (const auto &system : dual.linearization().subdomains())
      inverses.push_back(
        std::make_unique<feti::GeneralizedInverse>(system, own.inverses, context, "K"));
  };
  factorize(); // touches the memory
  return {"factorization of K + rho Q", 1, median_time(repeats, factorize)};
}

Stage Torn::factorization_of_interiors() const
{
  const feti::FactorCache                        own(solver.model().feti.factorization, context);
  const auto                                    &now = dual.linearization();
  std::vector<std::unique_ptr<feti::LocalSchur>> schur;
  const auto                                     factorize = [&]() {
    schur.clear();
    for (const auto &system : now.subdomains())
      schur.push_back(std::make_unique<feti::LocalSchur>(system, false, own, "K_ii"));
  };
  factorize();
  return {"factorization of K_ii", 1, median_time(repeats, factorize)};
}

std::vector<Stage> Torn::stages(const Seconds &whole)
{
  const unsigned int n_mults = work.f_mults, n_preconds = work.preconditioner_applications,
                     n_coarse = work.coarse_solves, n_outer = outer_iterations;

  const auto x    = problem->d();
  const auto face = problem->free_set(active);
  auto       y    = x;
  face->project(y); // makes the coarse problem
  face->precondition(x);
  const auto make_face = [&]() {
    const auto fresh = problem->free_set(active);
    fresh->project(y);
  };
  const Seconds apply        = median_time(repeats, [&]() { problem->apply(x); });
  const Seconds precondition = median_time(repeats, [&]() { face->precondition(x); });
  const Seconds project      = median_time(repeats, [&]() { face->project(y); });
  const Seconds fresh        = median_time(repeats, make_face) - project;
  const auto    shared       = linearization->shared();

  // Last, because a new linearization ends the face.
  const Seconds coarse = median_time(repeats, [&]() { linearize(shared); });

  std::vector<Stage> stages = {factorization_of_inverses(),
                               factorization_of_interiors(),
                               {"coarse space, W, d and e", 1, coarse},
                               {"F", n_mults, apply},
                               {"preconditioner", n_preconds, precondition},
                               {"projection", n_coarse, project},
                               {"coarse problem of a face", n_outer + 1, fresh}};
  Seconds            rest   = whole;
  for (const Stage &stage : stages)
    rest = rest - double(stage.count) * stage.each;
  stages.push_back({"rest: reorthogonalisation, W, KKT, u, certificate", 1, rest});
  return stages;
}
} // namespace snug::benchmark
