#include <snug/accuracy/estimate.h>
#include <snug/accuracy/gap_residual.h>
#include <snug/accuracy/local_errors.h>
#include <snug/accuracy/surface_layer.h>
#include <snug/accuracy/surface_residual.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/sensitivity/methods.h>
#include <snug/state/contact_results.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::accuracy {
double ResponseEstimate::error() const
{
  return std::max({std::abs(cells + contact), std::abs(cells) / 2., std::abs(contact) / 2.}) +
         std::abs(reading) + data;
}

namespace {
/// The estimates have two digits at most.
const double adjoint_tolerance = 1e-4;

/// Rows without an area carry no pressure.
double pressure(const double force, const double area)
{
  return area > 0. ? force / area : 0.;
}

/// u + factor v
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
           const sensitivity::Solves                           solves)
    : solver(solver), state(state), column(responses.size(), responses.size())
  {
    std::vector<response::Partials<dim>> partials;
    for (unsigned int j = 0; j < responses.size(); ++j)
      if (sensitivity::needs_solve(*responses[j]))
        {
          column[j] = partials.size();
          partials.push_back(responses[j]->partials(solver, state));
        }
    auto parameters               = solver.model().solver;
    parameters.relative_tolerance = std::max(parameters.relative_tolerance, adjoint_tolerance);
    if (!partials.empty())
      solution = sensitivity::adjoint_states(solver, state, partials, solves, parameters);
  }

  /// Of a response that needs a solve.
  LoadedDisplacement<dim> of(const unsigned int                    j,
                             const response::FieldDerivative<dim> &derivative,
                             const LoadedDisplacement<dim>        &u) const
  {
    LoadedDisplacement<dim> z;
    z.displacement =
      sum(mesh::owners_values(solver.mesh(),
                              state::nodal_values(solver, solution.primal, column[j])),
          -derivative.stiffness, u.displacement);
    const auto forces = solver.gluing().gather_contact(solution.dual.column(column[j]));
    for (unsigned int i = 0; i < forces.size(); ++i)
      {
        const double scale = solver.gluing().contact_scales()[i];
        z.pressures.push_back(scale > 0. ? pressure(forces[i] / scale, state.contact[i].area) : 0.);
      }
    z.loads = derivative.load;
    z.more  = &derivative;
    return z;
  }

private:
  const state::StateSolver<dim>  &solver;
  const state::ContactState<dim> &state;
  std::vector<unsigned int>       column; ///< of each response that needs one
  sensitivity::KktVectors         solution;
};
/// The state itself.
template <int dim>
LoadedDisplacement<dim> loaded(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state)
{
  LoadedDisplacement<dim> u;
  u.displacement = mesh::owners_values(solver.mesh(), state.displacement);
  for (const auto &point : state.contact)
    u.pressures.push_back(point.pressure);
  return u;
}

/// Rounding may make the square of a cell without error negative.
template <int dim>
EnergyEstimate energy_estimate(const state::StateSolver<dim>          &solver,
                               const state::ContactState<dim>         &state,
                               const std::vector<std::vector<double>> &products)
{
  EnergyEstimate result;
  double         square = 0.;
  for (const auto &of_cell : products)
    {
      const double of_this = std::max(0., of_cell[0]);
      result.cells.push_back(std::sqrt(of_this));
      square += of_this;
    }
  square       = dealii::Utilities::MPI::sum(square, solver.mesh().communicator());
  result.error = std::sqrt(square);
  // |u_h|^2 is twice the strain energy, and u - u_h nearly orthogonal to u_h.
  const double whole = 2. * state.strain_energy + square;
  result.relative    = whole > 0. ? std::sqrt(square / whole) : 0.;
  return result;
}

/// By the parts of the cells of this rank.
ResponseEstimate response_estimate(const std::vector<double> &cells,
                                   const std::vector<double> &contact,
                                   MPI_Comm                   comm)
{
  ResponseEstimate result;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    {
      result.cells += cells[cell];
      result.contact += contact[cell];
      result.indicators.push_back(std::abs(cells[cell]) + std::abs(contact[cell]));
    }
  result.cells   = dealii::Utilities::MPI::sum(result.cells, comm);
  result.contact = dealii::Utilities::MPI::sum(result.contact, comm);
  return result;
}
} // namespace

namespace {
/// Add parts of an error that is of the data, with a @p factor.
void add_data(const std::vector<double> &of_cells,
              const double               factor,
              MPI_Comm                   comm,
              ResponseEstimate          &to)
{
  double sum = 0.;
  for (unsigned int cell = 0; cell < of_cells.size(); ++cell)
    {
      sum += of_cells[cell];
      to.indicators[cell] += std::abs(factor * of_cells[cell]);
    }
  to.data += std::abs(factor * dealii::Utilities::MPI::sum(sum, comm));
}
} // namespace

/// The adjoint of the energy is the state itself, with the opposite sign: no local problem of its
/// own. Pressures of rows are of second order, which at degree 2 is less than displacements have:
/// there products of errors are as large as what rows do more than pressures, which is left out,
/// and the size of the reading is all that is known of it.
template <int dim>
Estimates estimate(const state::StateSolver<dim>                      &solver,
                   const state::ContactState<dim>                     &state,
                   const std::vector<const response::Response<dim> *> &responses,
                   const sensitivity::Solves                           solves)
{
  const unsigned int                          n = responses.size();
  const Adjoints<dim>                         adjoints(solver, state, responses, solves);
  std::vector<response::FieldDerivative<dim>> derivatives(n);
  std::vector<LoadedDisplacement<dim>>        all = {loaded(solver, state)};
  std::vector<unsigned int>                   place(n, 0); // in `all`
  for (unsigned int j = 0; j < n; ++j)
    if (responses[j]->needs_solution())
      derivatives[j] = responses[j]->field_derivative(solver, state);
  for (unsigned int j = 0; j < n; ++j)
    if (sensitivity::needs_solve(*responses[j]))
      {
        place[j] = all.size();
        all.push_back(adjoints.of(j, derivatives[j], all[0]));
      }
  const auto products = LocalErrors<dim>(solver, state).products(all);
  Estimates  result{energy_estimate(solver, state, products), {}};
  if (responses.empty())
    return result;
  const GapResidual<dim>     gaps(solver, state);
  const auto                 layer = SurfaceLayer<dim>(solver, state).works(all);
  const LoadResidual<dim>    loads(solver.mesh(), solver.model().load_cases[state.load_case],
                                   state.positions, Sampling::measure);
  std::vector<RoughPressure> rough;
  for (unsigned int j = 0; j < n; ++j)
    {
      const bool          is_geometry = !responses[j]->needs_solution();
      const double        sign        = is_geometry ? 0. : responses[j]->stationary() ? -1. : 1.;
      const double        s           = derivatives[j].stiffness;
      const auto         &z           = all[place[j]];
      std::vector<double> cells, contact = gaps.integral(z.pressures);
      for (unsigned int cell = 0; cell < products.size(); ++cell)
        cells.push_back(sign * (products[cell][place[j]] - layer[cell][place[j]]) +
                        s / 2. * (products[cell][0] - layer[cell][0]));
      for (double &of_cell : contact)
        of_cell *= sign;
      auto       one       = response_estimate(cells, contact, solver.mesh().communicator());
      const bool is_linear = solver.mesh().degree() == 1;
      if (is_linear && place[j] > 0)
        one.contact += gaps.excess_work(state.contact, sum(z.displacement, s, all[0].displacement));
      if (const auto read = responses[j]->measured(solver, gaps.pressures(all[0].pressures)))
        {
          const double value = responses[j]->value(solver, state);
          (is_linear ? one.contact : one.reading) += *read - value;
          if (rough.empty())
            rough = rough_pressures(solver, state);
          for (const auto &of_pair : rough)
            add_data(of_pair.of_cells, value, solver.mesh().communicator(), one);
        }
      // J depends on loads by the state and, where it has their work, by itself
      if (!is_geometry)
        add_data(loads.works(responses[j]->stationary()
                               ? z.displacement
                               : sum(z.displacement, s + z.loads, all[0].displacement)),
                 1., solver.mesh().communicator(), one);
      result.responses.push_back(std::move(one));
    }
  return result;
}

template <int dim>
EnergyEstimate estimate_energy(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state)
{
  return estimate<dim>(solver, state, {}, sensitivity::Solves::block).energy;
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template EnergyEstimate estimate_energy(const state::StateSolver<dim> &,                       \
                                          const state::ContactState<dim> &);                     \
  template Estimates estimate(const state::StateSolver<dim> &, const state::ContactState<dim> &, \
                              const std::vector<const response::Response<dim> *> &,              \
                              sensitivity::Solves);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::accuracy
