#include <snug/base/errors.h>
#include <snug/qp/pcpg.h>
#include <snug/state/certificate.h>
#include <snug/state/describe.h>
#include <snug/state/state_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

namespace snug::state {
namespace {
/// The KKT residual is a norm over all rows, the certificate a maximum:
/// solving this much below the tolerance meets it at once, as a rule.
const double certificate_margin = 0.25;

/// The tolerance is not lowered by more than this at once.
const double largest_step = 1e-4;
} // namespace

template <int dim>
struct StateSolver<dim>::Data
{
  Data(const mesh::BodyMesh<dim> &mesh,
       const mesh::Tearing       &tearing,
       const Model<dim>          &model,
       const Field               &positions,
       RunContext                &context)
    : problem(mesh, tearing, model, positions, context)
  {}

  StateProblem<dim> problem;
  double            solved_to = 0.; ///< KKT tolerance of the last solve

  void solve_to_certificate(const qp::WarmStart &start, ContactState<dim> &state);
};

template <int dim>
void StateSolver<dim>::Data::solve_to_certificate(const qp::WarmStart &start,
                                                  ContactState<dim>   &state)
{
  qp::WarmStart        from       = start;
  const auto          &feti       = *problem.feti;
  const RunContext    &context    = problem.context;
  qp::SolverParameters parameters = problem.model.solver;
  const double         wanted     = parameters.relative_tolerance;
  parameters.relative_tolerance *= certificate_margin;
  const unsigned long mults = context.work.f_mults;
  unsigned int        outer = 0;
  for (unsigned int attempt = 0; attempt < 5; ++attempt)
    {
      const auto this_solver = choose(qp::solver_table(), parameters.method).make(parameters);
      state.dual             = this_solver->solve(feti, from);
      outer += state.dual.outer_iterations;
      state.u           = feti.recover(feti.loads(), state.dual.lambda, state.dual.amplitudes);
      state.certificate = certify(feti, state.dual.lambda, state.u);
      if (state.certificate.worst() <= wanted)
        {
          solved_to                   = parameters.relative_tolerance;
          state.dual.outer_iterations = outer;
          state.f_mults               = context.work.f_mults - mults;
          return;
        }
      from.lambda = state.dual.lambda;
      from.active = state.dual.active;
      if (is_nearly_unloaded(feti, from.lambda))
        from.lambda = qp::MultiVector(feti.n_owned());
      parameters.relative_tolerance *=
        certificate_margin *
        std::max(largest_step, std::min(1., wanted / state.certificate.worst()));
    }
  std::ostringstream text;
  text << "the certificate of the contact state stays at " << state.certificate.worst()
       << ", above the tolerance " << wanted << "; allow a larger 'Solver/Relative tolerance'";
  throw SolveError(text.str());
}

template <int dim>
StateSolver<dim>::StateSolver(const mesh::BodyMesh<dim> &mesh,
                              const mesh::Tearing       &tearing,
                              const Model<dim>          &model,
                              const Field               &positions,
                              RunContext                &context)
  : data(std::make_unique<Data>(mesh, tearing, model, positions, context))
{}

template <int dim>
StateSolver<dim>::~StateSolver() = default;

template <int dim>
void StateSolver<dim>::pair(const Field &positions)
{
  data->problem.pair(positions);
}

template <int dim>
ContactState<dim>
StateSolver<dim>::solve(const Field &positions, const qp::WarmStart &start, unsigned int load_case)
{
  auto &problem = data->problem;
  problem.set_geometry(positions);
  problem.set_load_case(load_case);
  ContactState<dim> state;
  state.positions             = positions;
  state.load_case             = load_case;
  state.least_scaled_jacobian = problem.least_scaled_jacobian;
  {
    const RunContext::Timer timer(problem.context, "solve");
    data->solve_to_certificate(start, state);
  }
  describe(*this, problem.last_rows, state);
  return state;
}

template <int dim>
unsigned long StateSolver<dim>::linear_f_mults(const ContactState<dim> &state) const
{
  data->problem.set_load_case(state.load_case);
  const auto         &feti   = *data->problem.feti;
  const auto          face   = feti.face(state.dual.active);
  const unsigned long before = data->problem.context.work.f_mults;
  qp::MultiVector     lambda(feti.n_owned());
  face->make_feasible(lambda, feti.e());
  qp::MultiVector residual = feti.d();
  residual.add(-1., feti.apply(lambda));
  qp::MultiVector projected = residual;
  face->project(projected);
  const double scale = qp::norms(projected, data->problem.context.communicator())[0];
  qp::pcpg(feti, *face, lambda, residual, {data->solved_to * scale},
           data->problem.model.solver.max_iterations);
  return data->problem.context.work.f_mults - before;
}

template <int dim>
double StateSolver<dim>::volume(unsigned int body, const Field &positions) const
{
  double volume = 0.;
  for (unsigned int s = 0; s < data->problem.systems.size(); ++s)
    if (data->problem.systems[s].body == body)
      for (unsigned int i = 0; i < data->problem.assemblers[s]->cells().size(); ++i)
        volume += data->problem.assemblers[s]->element().volume(
          data->problem.assemblers[s]->cell_field(i, positions));
  return dealii::Utilities::MPI::sum(volume, data->problem.context.communicator());
}

template <int dim>
RowCoefficients<dim> StateSolver<dim>::rows(const Field &positions) const
{
  return data->problem.rows(positions);
}

template <int dim>
RowCoefficients<dim> StateSolver<dim>::row_derivatives(const Field &positions,
                                                       const Field &velocity) const
{
  return {data->problem.contact->row_derivatives(data->problem.surface.gather(positions),
                                                 data->problem.surface.gather(velocity)),
          data->problem.held->frame_derivatives(positions, velocity)};
}

template <int dim>
feti::PrimalVectors StateSolver<dim>::loads(const Field &positions, unsigned int load_case) const
{
  const auto          tractions = data->problem.resultants.tractions(positions);
  feti::PrimalVectors f;
  for (const auto &assembler : data->problem.assemblers)
    {
      const auto of_subdomain = assembler->load(positions, load_case, tractions);
      f.emplace_back(of_subdomain.size());
      std::copy(of_subdomain.begin(), of_subdomain.end(), f.back().column(0));
    }
  return f;
}

#define SNUG_GETTER(type, name, value) \
  template <int dim>                   \
  type StateSolver<dim>::name() const  \
  {                                    \
    return value;                      \
  }
SNUG_GETTER(const mesh::BodyMesh<dim> &, mesh, data->problem.mesh)
SNUG_GETTER(const mesh::Tearing &, tearing, data->problem.tearing)
SNUG_GETTER(const Model<dim> &, model, data->problem.model)
SNUG_GETTER(const mesh::Surface<dim> &, surface, data->problem.surface)
SNUG_GETTER(const contact::Contact<dim> &, contact, *data->problem.contact)
SNUG_GETTER(const supports::HeldNodes<dim> &, held, *data->problem.held)
SNUG_GETTER(const elasticity::FaceLoad<dim> &, face_load, data->problem.face_load)
SNUG_GETTER(const ResultantLoads<dim> &, resultants, data->problem.resultants)
SNUG_GETTER(const std::vector<std::unique_ptr<Assembler<dim>>> &,
            assemblers,
            data->problem.assemblers)
SNUG_GETTER(const feti::TotalFeti &, feti, *data->problem.feti)
SNUG_GETTER(const Gluing<dim> &, gluing, *data->problem.gluing)
SNUG_GETTER(RunContext &, context, data->problem.context)
#undef SNUG_GETTER

template class StateSolver<2>;
template class StateSolver<3>;
} // namespace snug::state
