#include <snug/accuracy/energy_estimate.h>
#include <snug/accuracy/local_errors.h>
#include <snug/base/entries.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace snug::accuracy {
void AccuracyParameters::declare(Entries &entries)
{
  entries.add("Estimate", estimate,
              "What is estimated of the mesh's error, once per state and of the final design.");
}

/// Rounding may make the square of a cell without error negative.
template <int dim>
EnergyEstimate estimate_energy(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state)
{
  LoadedDisplacement<dim> u{state.displacement, {}};
  for (const auto &point : state.contact)
    u.pressures.push_back(point.pressure);
  EnergyEstimate result;
  double         square = 0.;
  for (const auto &of_cell : LocalErrors<dim>(solver, state).products({u}))
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

template EnergyEstimate estimate_energy(const state::StateSolver<2> &,
                                        const state::ContactState<2> &);
template EnergyEstimate estimate_energy(const state::StateSolver<3> &,
                                        const state::ContactState<3> &);
} // namespace snug::accuracy
