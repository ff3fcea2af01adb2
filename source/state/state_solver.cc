#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/qp/pcpg.h>
#include <snug/state/certificate.h>
#include <snug/state/contact_results.h>
#include <snug/state/state_solver.h>

#include <algorithm>
#include <sstream>

namespace snug::state {
namespace {
/// The KKT residual is a norm over all rows, the certificate a maximum. A solution to this fraction
/// of the tolerance usually meets the certificate at once.
const double certificate_margin = 0.25;

/// Minimum factor by which the error of the certificate lowers the tolerance in one attempt.
const double largest_step = 1e-4;
} // namespace

template <int dim>
void StateSolver<dim>::solve_to_certificate(const qp::WarmStart &start,
                                            ContactState<dim>   &state) const
{
  qp::WarmStart        from       = start;
  const auto          &dual       = feti(state);
  qp::SolverParameters parameters = model().solver;
  const double         wanted     = state.tolerance;
  parameters.relative_tolerance   = certificate_margin * wanted;
  const unsigned long mults       = context().work.f_mults;
  unsigned int        outer       = 0;
  for (unsigned int attempt = 0; attempt < 5; ++attempt)
    {
      const auto this_solver = choose(qp::solver_table(), parameters.method).make(parameters);
      state.dual             = this_solver->solve(dual, from);
      outer += state.dual.outer_iterations;
      state.u =
        dual.linearization().recover(dual.loads(), state.dual.lambda, state.dual.amplitudes);
      dual.add_minimal_rigid_motion(state.dual.determined_rows(), state.u, state.dual.amplitudes);
      state.certificate = certify(dual, state.dual.lambda, state.u);
      if (state.certificate.worst() <= wanted)
        {
          state.solved_to             = parameters.relative_tolerance;
          state.tolerance             = wanted;
          state.dual.outer_iterations = outer;
          state.f_mults               = context().work.f_mults - mults;
          return;
        }
      from = {state.dual.lambda, state.dual.active, state.dual.directions, state.dual.slips};
      if (is_nearly_unloaded(dual, from.lambda))
        from.lambda = qp::MultiVector(dual.n_owned());
      parameters.relative_tolerance *=
        certificate_margin *
        std::max(largest_step, std::min(1., wanted / state.certificate.worst()));
    }
  std::ostringstream text;
  text << "the certificate of the contact state stays at " << state.certificate.worst()
       << ", above the tolerance " << wanted << "; increase 'Solver/Relative tolerance'";
  throw SolveError(text.str());
}

template <int dim>
StateSolver<dim>::StateSolver(const mesh::BodyMesh<dim> &mesh,
                              const mesh::Tearing       &tearing,
                              const Model<dim>          &model,
                              const Field               &positions,
                              RunContext                &context)
  : problem(std::make_unique<StateProblem<dim>>(mesh, tearing, model, positions, context))
  , relative_tolerance(model.solver.relative_tolerance)
{}

template <int dim>
void StateSolver<dim>::pair(const Field &positions)
{
  ++n_pairings;
  problem->pair(positions);
}

template <int dim>
ContactState<dim> StateSolver<dim>::solve(const Field                          &positions,
                                          const qp::WarmStart                  &start,
                                          const unsigned int                    load_case,
                                          const std::vector<ContactState<dim>> &earlier)
{
  const auto               &after = model().load_cases[load_case].after;
  const std::vector<double> none, &slips = after ? earlier.at(*after).slips : none;
  problem->set(positions, load_case, slips);
  return solve_present(positions, start, load_case, relative_tolerance, slips);
}

template <int dim>
qp::WarmStart StateSolver<dim>::scaled_start(const std::vector<ContactState<dim>> &states,
                                             const Field                          &positions,
                                             const unsigned int                    load_case) const
{
  if (const auto &after = model().load_cases[load_case].after)
    {
      // The rows of held motions are the last ones, and other motions may be held.
      const auto   &dual = states.at(*after).dual;
      const auto    n    = problem->of(load_case).gluing->layout().n_owned();
      qp::WarmStart start{qp::MultiVector(n), dual.active};
      std::copy_n(dual.lambda.column(0), std::min(n, dual.lambda.n_rows()), start.lambda.column(0));
      start.active.resize(n, 1);
      // A slip that turns round would first slip the wrong way.
      qp::free_tangents(problem->of(load_case).cones, start.active);
      return start;
    }
  for (auto other = states.rbegin(); other != states.rend(); ++other)
    {
      if (&problem->of(other->load_case) != &problem->of(load_case))
        continue;
      const auto f = loads(positions, load_case), g = loads(positions, other->load_case);
      double     products[3] = {0., 0., 0.};
      for (unsigned int s = 0; s < f.size(); ++s)
        for (unsigned int i = 0; i < f[s].n_rows(); ++i)
          {
            products[0] += f[s](i) * f[s](i);
            products[1] += f[s](i) * g[s](i);
            products[2] += g[s](i) * g[s](i);
          }
      MPI_Allreduce(MPI_IN_PLACE, products, 3, MPI_DOUBLE, MPI_SUM, context().communicator());
      const auto [ff, fg, gg] = products;
      if (!(fg > 0.) || fg * fg < 0.5 * ff * gg)
        continue;
      qp::WarmStart start;
      start.lambda = qp::MultiVector(other->dual.lambda.n_rows());
      start.lambda.add(fg / gg, other->dual.lambda);
      return start;
    }
  return qp::WarmStart();
}

template <int dim>
ContactState<dim> StateSolver<dim>::solve_on(const ContactState<dim> &state,
                                             const double             tolerance) const
{
  feti(state); // throws at another geometry
  auto result =
    solve_present(state.positions,
                  {state.dual.lambda, state.dual.active, state.dual.directions, state.dual.slips},
                  state.load_case, tolerance, state.slips_before);
  result.f_mults += state.f_mults;
  return result;
}

template <int dim>
ContactState<dim> StateSolver<dim>::solve_present(const Field               &positions,
                                                  const qp::WarmStart       &start,
                                                  const unsigned int         load_case,
                                                  const double               tolerance,
                                                  const std::vector<double> &slips) const
{
  const auto       &geometry = problem->geometry();
  ContactState<dim> state;
  state.positions             = positions;
  state.surface_positions     = surface().gather(positions);
  state.load_case             = load_case;
  state.pairing               = n_pairings;
  state.tolerance             = tolerance;
  state.slips_before          = slips;
  state.least_scaled_jacobian = geometry.least_scaled_jacobian;
  const RunContext::Timer timer(context(), "solve");
  solve_to_certificate(start, state);
  recover_contact_results(*this, problem->of(load_case).rows, state);
  return state;
}

template <int dim>
const feti::LoadedProblem &StateSolver<dim>::feti(const ContactState<dim> &state) const
{
  SNUG_ASSERT(state.pairing == n_pairings, "the state belongs to another contact search");
  return problem->loaded(state.positions, state.load_case);
}

template <int dim>
void StateSolver<dim>::restore(const ContactState<dim> &state)
{
  SNUG_ASSERT(state.pairing == n_pairings, "the state belongs to another contact search");
  problem->set(state.positions, state.load_case, state.slips_before);
}

template <int dim>
unsigned long StateSolver<dim>::linear_f_mults(const ContactState<dim> &state) const
{
  const auto         &dual     = feti(state);
  const auto          free_set = dual.free_set(state.dual.active);
  const unsigned long before   = context().work.f_mults;
  qp::MultiVector     lambda(dual.n_owned());
  free_set->make_feasible(lambda, dual.e());
  qp::MultiVector residual = dual.d();
  residual.add(-1., dual.apply(lambda));
  qp::MultiVector projected = residual;
  free_set->project(projected);
  const double scale = qp::norms(projected, context().communicator())[0];
  qp::pcpg(dual, *free_set, lambda, residual, {state.solved_to * scale},
           model().solver.max_iterations);
  return context().work.f_mults - before;
}

template <int dim>
std::vector<unsigned int> StateSolver<dim>::positions() const
{
  std::vector<unsigned int> first;
  for (unsigned int c = 0; c < model().load_cases.size(); ++c)
    if (std::none_of(first.begin(), first.end(), [&](const unsigned int other) {
          return &problem->of(other) == &problem->of(c);
        }))
      first.push_back(c);
  return first;
}

template <int dim>
bool StateSolver<dim>::has_friction() const
{
  const auto first = positions();
  return std::any_of(first.begin(), first.end(),
                     [&](const unsigned int c) { return contact(c).has_friction(); });
}

template <int dim>
bool StateSolver<dim>::has_potential() const
{
  const auto locks = [](const PointLoad &point) {
    return std::find(point.locked.begin(), point.locked.end(), true) != point.locked.end();
  };
  return !has_friction() &&
         std::none_of(model().load_cases.begin(), model().load_cases.end(), [&](const auto &of) {
           return std::any_of(of.points.begin(), of.points.end(), locks);
         });
}

template <int dim>
RowCoefficients<dim> StateSolver<dim>::row_derivatives(const Field       &positions,
                                                       const Field       &velocity,
                                                       const unsigned int load_case) const
{
  const auto           x = surface().gather(positions), v = surface().gather(velocity);
  const auto          &contact_here = contact(load_case);
  RowCoefficients<dim> result{contact_here.row_derivatives(x, v),
                              {},
                              held().frame_derivatives(positions, velocity),
                              springs().row_derivatives(positions, velocity),
                              ties().row_derivatives(x, v)};
  if (contact_here.has_friction())
    result.tangents =
      contact_here.tangent_row_derivatives(x, v, contact_here.rows(x), result.contact);
  if (!points().empty())
    points().differentiate(x, v, rows(positions, load_case), contact_here, result);
  return result;
}

template <int dim>
feti::PrimalVectors StateSolver<dim>::loads(const Field &positions, unsigned int load_case) const
{
  const auto          tractions = resultants().tractions(positions);
  feti::PrimalVectors f;
  for (const auto &assembler : assemblers())
    {
      const auto of_subdomain = assembler->load(positions, load_case, tractions);
      f.emplace_back(of_subdomain.size());
      std::copy(of_subdomain.begin(), of_subdomain.end(), f.back().column(0));
    }
  return f;
}

template class StateSolver<2>;
template class StateSolver<3>;
} // namespace snug::state
