#ifndef snug_accuracy_energy_estimate_h
#define snug_accuracy_energy_estimate_h

#include <snug/state/state_solver.h>

namespace snug {
class Entries;
}

namespace snug::accuracy {
enum class Estimate
{
  none,
  energy
};
inline Names names(Estimate)
{
  return {{"none"},
          {"energy", "the error of the displacement in the energy norm, by local problems in the "
                     "cells"}};
}

/// Entries of `subsection Accuracy`.
struct AccuracyParameters
{
  Estimate estimate = Estimate::energy;

  void declare(Entries &entries);
};

/// How far a displacement u_h on a mesh is from u without one.
struct EnergyEstimate
{
  /// eta_K of the cells of this rank, eta_K^2 = a(e, e) by LocalErrors
  std::vector<double> cells;
  /// eta = (sum eta_K^2)^(1/2) ~ |u - u_h|, |v|^2 = a(v, v) [(force length)^(1/2)]
  double error = 0.;
  /// eta / (|u_h|^2 + eta^2)^(1/2); 0 where nothing strains
  double relative = 0.;
};

/// That of a state. Collective.
template <int dim>
EnergyEstimate estimate_energy(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state);
} // namespace snug::accuracy

#endif
