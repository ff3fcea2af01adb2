#include <snug/base/errors.h>
#include <snug/state/certificate.h>
#include <snug/state/expected_contacts.h>

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

Torn::Torn(const state::StateSolver<3> &solver, const feti::TotalFeti &dual, RunContext &context)
  : solver(solver)
  , dual(dual)
  , context(context)
  , all(solver.tearing().subdomains.size(), true)
  , none(all.size(), false)
  , feti(dual.subdomains(),
         solver.gluing().layout(),
         subdomain_table(solver),
         solver.model().feti,
         context)
{}

void Torn::factorize()
{
  feti.update(all);
  feti.set_loads(dual.g());
  std::vector<unsigned int> pair_of_row; // there is one pair
  for (const auto is_contact : feti.bounded())
    pair_of_row.push_back(is_contact ? 0 : 1);
  feti.expect(state::expected_contacts(feti, pair_of_row, 1, 3));
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
      const auto dual =
        choose(qp::solver_table(), parameters.method).make(parameters)->solve(feti, start);
      const auto u = feti.recover(feti.loads(), dual.lambda, dual.amplitudes);
      error        = state::certify(feti, dual.lambda, u).worst();
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
  feti::FillOrderings    orderings;
  const feti::FactorPool factors(feti::FactorOf::kplus, solver.model().feti.factorization,
                                 &orderings);
  std::vector<std::unique_ptr<feti::GeneralizedInverse>> inverses;
  for (const auto &system : feti.subdomains())
    inverses.push_back(std::make_unique<feti::GeneralizedInverse>(system, factors, context));
  const auto factorize = [&]() {
    for (auto &inverse : inverses)
      inverse->release();
    for (auto &inverse : inverses)
      inverse->factorize("K");
  };
  factorize(); // touches the memory
  return {"factorization of K + rho Q", 1, median_time(repeats, factorize)};
}

Stage Torn::factorization_of_interiors() const
{
  feti::FillOrderings    orderings;
  feti::SharedPatterns   patterns;
  const feti::FactorPool factors(feti::FactorOf::dirichlet, solver.model().feti.factorization,
                                 &orderings);
  std::vector<std::unique_ptr<feti::LocalSchur>> schur;
  for (const auto &system : feti.subdomains())
    schur.push_back(std::make_unique<feti::LocalSchur>(system, false, factors, patterns, context));
  const auto factorize = [&]() {
    for (auto &part : schur)
      part->release();
    for (auto &part : schur)
      part->factorize("K_ii");
  };
  factorize();
  return {"factorization of K_ii", 1, median_time(repeats, factorize)};
}

std::vector<Stage> Torn::stages(const Seconds &whole)
{
  const unsigned int n_mults = work.f_mults, n_preconds = work.preconditioner_applications,
                     n_coarse = work.coarse_solves, n_outer = outer_iterations;

  const auto x    = feti.d();
  const auto face = feti.free_set(active);
  auto       y    = x;
  face->project(y); // makes the coarse problem
  face->precondition(x);
  const auto make_face = [&]() {
    const auto fresh = feti.free_set(active);
    fresh->project(y);
  };
  const Seconds apply        = median_time(repeats, [&]() { feti.apply(x); });
  const Seconds precondition = median_time(repeats, [&]() { face->precondition(x); });
  const Seconds project      = median_time(repeats, [&]() { face->project(y); });
  const Seconds fresh        = median_time(repeats, make_face) - project;
  const Seconds coarse       = median_time(repeats, [&]() {
    feti.update(none);
    feti.set_loads(dual.g());
  });

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
