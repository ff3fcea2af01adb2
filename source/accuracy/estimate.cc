#include <snug/accuracy/estimate.h>
#include <snug/accuracy/gap_residual.h>
#include <snug/accuracy/jumps.h>
#include <snug/accuracy/local_errors.h>
#include <snug/accuracy/surface_layer.h>
#include <snug/accuracy/surface_residual.h>
#include <snug/base/errors.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/sensitivity/methods.h>
#include <snug/state/contact_results.h>
#include <snug/state/continuity.h>
#include <snug/state/validity_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::accuracy {
namespace {
/// Relative tolerance of the first adjoint solve, because the estimates are accurate to two digits
/// at most.
const double first_adjoint_tolerance = 1e-4;

/// Maximum share of the solver's jumps in the estimated error of the mesh, or in the displacement,
/// both in the energy norm.
const double part_of_error = 0.1, part_of_displacement = 1e-4;

/// Maximum number of attempts. Rounding stops the solver before it needs more tolerances.
const unsigned int most_attempts = 6;

/// Return the factor of the next tolerance if the jumps of the solver are @p excess times their
/// limit. The factor is a power of ten, so that rounding does not change it.
double tightened(const double excess)
{
  return excess < 3. ? 0.1 : excess < 30. ? 0.01 : 0.001;
}

/// Return the pressure. Rows without an area carry no pressure.
double pressure(const double force, const double area)
{
  return area > 0. ? force / area : 0.;
}

/// Return u + factor v.
template <int dim>
std::vector<dealii::Tensor<1, dim>> sum(std::vector<dealii::Tensor<1, dim>>        u,
                                        const double                               factor,
                                        const std::vector<dealii::Tensor<1, dim>> &v)
{
  for (unsigned int node = 0; node < u.size(); ++node)
    u[node] += factor * v[node];
  return u;
}

template <int dim>
class Adjoints
{
public:
  Adjoints(const state::StateSolver<dim>                      &solver,
           const state::ContactState<dim>                     &state,
           const std::vector<const response::Response<dim> *> &responses,
           const sensitivity::Solves                           solves,
           const double                                        tolerance)
    : solver(solver), load_case(state.load_case), column(responses.size(), responses.size())
  {
    std::vector<response::Partials<dim>> partials;
    for (unsigned int j = 0; j < responses.size(); ++j)
      if (sensitivity::needs_solve(*responses[j], solver.has_potential()))
        {
          column[j] = partials.size();
          partials.push_back(responses[j]->partials(solver, state));
        }
    if (partials.empty())
      return;
    auto parameters               = solver.model().solver;
    parameters.relative_tolerance = tolerance;
    auto solution = sensitivity::adjoint_states(solver, state, partials, solves, parameters);
    for (const auto &point : state.contact)
      areas.push_back(point.area);
    rows             = solver.contact(load_case).rows(state.surface_positions);
    const auto &feti = solver.feti(state);
    forces           = solver.gluing(load_case).row_forces(solution.dual);
    positions        = state.surface_positions;
    norms            = state::energy_norms(feti, solution.primal);
    torn = continuous = solution.primal;
    state::make_continuous(feti, nullptr, continuous);
  }

  /// Return the adjoint of a response that needs a solve, as a loaded displacement.
  LoadedDisplacement<dim> of(const unsigned int                    j,
                             const response::FieldDerivative<dim> &derivative,
                             const LoadedDisplacement<dim>        &u) const
  {
    const auto at_nodes = [&](const feti::PrimalVectors &field, const unsigned int of) {
      return mesh::owners_values(solver.mesh(), state::nodal_values(solver, field, of));
    };
    LoadedDisplacement<dim> z;
    z.displacement = sum(at_nodes(continuous, column[j]), -derivative.stiffness, u.displacement);
    if (derivative.motion.n_columns() > 0)
      z.displacement = sum(z.displacement, -1., at_nodes(derivative.motion, 0));
    const auto &contact = solver.contact(load_case);
    const auto &here    = forces[column[j]].contact;
    for (unsigned int i = 0; i < contact.n_rows(); ++i)
      z.pressures.push_back(pressure(here[i], areas[i]));
    if (contact.has_friction())
      for (const auto &force : contact.forces(rows, here).tangential)
        z.shears.push_back(-pressure(1., areas[z.shears.size()]) * force);
    z.ties    = solver.ties().tractions(positions, forces[column[j]].ties);
    z.loads   = derivative.load;
    z.thermal = -derivative.stiffness;
    z.more    = &derivative;
    return z;
  }

  mesh::Field<dim> jump_of(const unsigned int j) const
  {
    return jump(solver, torn, continuous, column[j]);
  }

  /// Return the norm of an adjoint in the energy norm.
  double norm(const unsigned int j) const { return norms[column[j]]; }

private:
  const state::StateSolver<dim> &solver;
  const unsigned int             load_case;
  std::vector<unsigned int>      column; ///< column of each response that needs one
  std::vector<double>            areas;  ///< areas of the contact rows
  std::vector<contact::Row<dim>> rows;
  /// of the rows of contact and ties, per column
  std::vector<typename state::Gluing<dim>::RowForces> forces;
  typename mesh::Surface<dim>::Field                  positions; ///< of the surface
  feti::PrimalVectors                                 torn, continuous;
  std::vector<double>                                 norms; ///< energy norms of the columns
};

/// Return the displacement and the pressures of the state.
template <int dim>
LoadedDisplacement<dim> loaded(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state)
{
  LoadedDisplacement<dim> u;
  u.displacement = mesh::owners_values(solver.mesh(), state.displacement);
  for (const auto &point : state.contact)
    {
      u.pressures.push_back(point.mean);
      if (!solver.has_friction())
        continue;
      u.shears.emplace_back();
      for (int d = 0; d < dim; ++d)
        u.shears.back()[d] = point.force == 0. ? 0. : -point.mean / point.force * point.shear[d];
    }
  const auto forces = solver.gluing(state.load_case).row_forces(state.dual.lambda).front();
  u.ties            = solver.ties().tractions(state.surface_positions, forces.ties);
  return u;
}

/// Estimates by a given state and given adjoints, and the ratios of the jumps that the solver left
/// in them to their limits.
struct Attempt
{
  Estimates estimates;
  double    excess = 0., adjoint_excess = 0.;
};

/// Products of the local errors of fields.
template <int dim>
class Products
{
public:
  /// Compute the products of all fields. Collective.
  Products(const LocalErrors<dim>                     &local,
           const std::vector<LoadedDisplacement<dim>> &fields,
           MPI_Comm                                    comm)
    : comm(comm), of_cells(local.products(fields))
  {}

  unsigned int n_cells() const { return of_cells.size(); }

  /// Return a(e_0, e_i).
  double with_first(const unsigned int cell, const unsigned int i) const
  {
    return of_cells[cell].products[i];
  }

  /// Return the norms of the local errors of field i, per cell.
  std::vector<double> norms(const unsigned int i) const
  {
    std::vector<double> result;
    for (const auto &of_cell : of_cells)
      result.push_back(of_cell.norms[i]);
    return result;
  }

  /// Return the norm over the cells of all ranks. Collective.
  double norm(const unsigned int i) const
  {
    double square = 0.;
    for (const double of_cell : norms(i))
      square += of_cell * of_cell;
    return std::sqrt(dealii::Utilities::MPI::sum(square, comm));
  }

private:
  const MPI_Comm          comm;
  std::vector<CellErrors> of_cells;
};

template <int dim>
EnergyEstimate energy_estimate(const state::ContactState<dim> &state, const Products<dim> &products)
{
  EnergyEstimate result{products.norms(0), products.norm(0)};
  // |u_h|^2 is twice the strain energy, and u - u_h is nearly orthogonal to u_h.
  const double square = result.error * result.error, whole = 2. * state.strain_energy + square;
  result.relative = whole > 0. ? std::sqrt(square / whole) : 0.;
  return result;
}

/// Return the sums of the products of local errors of a response, minus the contribution of the
/// surface layer, per cell. @p factor multiplies those of the adjoint, @p half those of the state.
template <int dim>
std::vector<double> in_cells(const Products<dim>                    &products,
                             const std::vector<std::vector<double>> &layer,
                             const unsigned int                      place,
                             const double                            factor,
                             const double                            half)
{
  std::vector<double> result;
  for (unsigned int cell = 0; cell < products.n_cells(); ++cell)
    result.push_back(factor * (products.with_first(cell, place) - layer[cell][place]) +
                     half * (products.with_first(cell, 0) - layer[cell][0]));
  return result;
}

/// Add the error of the pressure that a response of this value reads, caused by an unresolved gap.
/// The rough pressures are computed once and stored in @p rough. Collective.
template <int dim>
void add_rough_pressures(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state,
                         const double                    value,
                         std::vector<RoughPressure>     &rough,
                         ResponseEstimate               &one)
{
  if (rough.empty())
    rough = rough_pressures(solver, state);
  for (const auto &of_pair : rough)
    one.add_data(of_pair.of_cells, value, solver.mesh().communicator());
}

/// The state and the adjoints of responses as fields.
template <int dim>
struct Fields
{
  std::vector<response::FieldDerivative<dim>> derivatives; ///< per response
  std::vector<unsigned int>                   place;       ///< per response, in `all`; 0: none
  std::vector<LoadedDisplacement<dim>>        all;         ///< the state first

  Fields(const state::StateSolver<dim>                      &solver,
         const state::ContactState<dim>                     &state,
         const std::vector<const response::Response<dim> *> &responses,
         const Adjoints<dim>                                &adjoints)
    : derivatives(responses.size()), place(responses.size(), 0), all({loaded(solver, state)})
  {
    for (unsigned int j = 0; j < responses.size(); ++j)
      {
        if (responses[j]->needs_solution())
          derivatives[j] = responses[j]->field_derivative(solver, state);
        if (!sensitivity::needs_solve(*responses[j], solver.has_potential()))
          continue;
        place[j] = all.size();
        all.push_back(adjoints.of(j, derivatives[j], all[0]));
      }
  }
};

/// Estimate with given tolerance of the adjoints. The adjoint of the energy is the state itself
/// with the opposite sign, so it needs no local problem. Contact pressures of rows converge with
/// second order. At degree 2, this is lower than the order of displacements. There the products of
/// errors are as large as gaps.excess_work(), which is therefore left out, and only the size of
/// the reading is known.
template <int dim>
Attempt attempt(const state::StateSolver<dim>                      &solver,
                const state::ContactState<dim>                     &state,
                const std::vector<const response::Response<dim> *> &responses,
                const sensitivity::Solves                           solves,
                const double                                        adjoint_tolerance)
{
  const Adjoints<dim>    adjoints(solver, state, responses, solves, adjoint_tolerance);
  const Fields<dim>      fields(solver, state, responses, adjoints);
  const auto            &all = fields.all;
  const LocalErrors<dim> local(solver, state);
  const Products<dim>    products(local, all, solver.mesh().communicator());
  const auto excess = [&](const mesh::Field<dim> &jump, const unsigned int i, const double norm) {
    const double allowed = std::max(part_of_error * products.norm(i), part_of_displacement * norm);
    return allowed > 0. ? error_of_jump(local, solver, state, jump, allowed) / allowed : 0.;
  };
  Attempt result{{energy_estimate(state, products), {}}};
  auto    continuous = state.u;
  state::make_continuous(solver.feti(state), &solver.feti(state).g(), continuous);
  result.excess = excess(jump(solver, state.u, continuous, 0), 0,
                         state::energy_norms(solver.feti(state), state.u)[0]);
  if (responses.empty())
    return result;
  const GapResidual<dim>     gaps(solver, state);
  const auto                 layer = SurfaceLayer<dim>(solver, state).works(all);
  const LoadResidual<dim>    loads(solver.mesh(), solver.model().load_cases[state.load_case],
                                   state.positions, Sampling::measure);
  std::vector<RoughPressure> rough;
  for (unsigned int j = 0; j < responses.size(); ++j)
    {
      const auto   place       = fields.place[j];
      const bool   is_geometry = !responses[j]->needs_solution();
      const double sign        = is_geometry ? 0. : place == 0 ? -1. : 1.;
      const double s           = fields.derivatives[j].stiffness;
      const auto  &z           = all[place];
      const auto   cells       = in_cells(products, layer, place, sign, s / 2.);
      if (place > 0)
        result.adjoint_excess =
          std::max(result.adjoint_excess, excess(adjoints.jump_of(j), place, adjoints.norm(j)));
      auto       one       = ResponseEstimate::of_cells(cells, gaps.integral(z.pressures), sign,
                                                        solver.mesh().communicator());
      const bool is_linear = solver.mesh().degree() == 1;
      if (is_linear && place > 0)
        one.contact += gaps.excess_work(state.contact, sum(z.displacement, s, all[0].displacement));
      if (const auto read =
            responses[j]->measured(solver, state.load_case, gaps.pressures(all[0].pressures)))
        {
          const double value = responses[j]->value(solver, state);
          (is_linear ? one.contact : one.reading) += *read - value;
          add_rough_pressures(solver, state, value, rough, one);
        }
      // J depends on loads through the state and, where J contains their work, directly.
      if (!is_geometry)
        one.add_data(loads.works(place == 0
                                   ? z.displacement
                                   : sum(z.displacement, s + z.loads, all[0].displacement)),
                     1., solver.mesh().communicator());
      result.estimates.responses.push_back(std::move(one));
    }
  return result;
}
} // namespace

template <int dim>
Estimates estimate(const state::StateSolver<dim>                      &solver,
                   const state::ContactState<dim>                     &state,
                   const std::vector<const response::Response<dim> *> &responses,
                   const sensitivity::Solves                           solves,
                   std::optional<state::ContactState<dim>>            &solved_on)
{
  double     adjoint_tolerance = std::max(solver.tolerance(), first_adjoint_tolerance);
  const auto last              = [&]() -> const auto              &{ return solved_on ? *solved_on : state; };
  auto       result            = attempt(solver, state, responses, solves, adjoint_tolerance);
  for (unsigned int n = 1; n < most_attempts && !state::is_at_rest(state) &&
                           std::max(result.excess, result.adjoint_excess) > 1.;
       ++n)
    try
      {
        if (result.excess > 1.)
          solved_on = solver.solve_on(last(), tightened(result.excess) * last().tolerance);
        if (result.adjoint_excess > 1.)
          adjoint_tolerance *= tightened(result.adjoint_excess);
        result = attempt(solver, last(), responses, solves, adjoint_tolerance);
      }
    catch (const SolveError &)
      {
        break; // rounding or the maximum of F-mults stopped the solve: no more digits
      }
  for (unsigned int j = 0; j < responses.size(); ++j)
    if (!responses[j]->has_estimate())
      result.estimates.responses[j].data = std::numeric_limits<double>::quiet_NaN();
  return result.estimates;
}

template <int dim>
EnergyEstimate estimate_energy(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state)
{
  std::optional<state::ContactState<dim>> solved_on;
  return estimate<dim>(solver, state, {}, sensitivity::Solves::block, solved_on).energy;
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template EnergyEstimate estimate_energy(const state::StateSolver<dim> &,                       \
                                          const state::ContactState<dim> &);                     \
  template Estimates estimate(const state::StateSolver<dim> &, const state::ContactState<dim> &, \
                              const std::vector<const response::Response<dim> *> &,              \
                              sensitivity::Solves, std::optional<state::ContactState<dim>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
