#ifndef snug_state_thermal_h
#define snug_state_thermal_h

#include <snug/state/state_solver.h>

namespace snug::state {
/**
 * Return the thermal strain alpha dT in a cell with reference positions @p X_0 of its nodes; empty
 * if there is none. The temperature is a function of the reference position, so it moves with the
 * material point. Arguments must outlive the result, except X_0.
 */
template <int dim>
elasticity::ThermalStrain<dim> thermal_strain(const BodyLoads<dim>                      &loads,
                                              const elasticity::Material                &material,
                                              const std::vector<dealii::Tensor<1, dim>> &X_0);

/// @name Thermal loads f_T and their energy c_T = 1/2 int e I : C e I dV in a load case. The
/// elastic energy is 1/2 u'Ku - f_T'u + c_T. All but the gradients are collective.
/// @{

/// Return whether the load case of a state has a temperature.
template <int dim>
bool has_temperature(const StateSolver<dim> &solver, const ContactState<dim> &state);

/// Return f_T per subdomain of this rank.
template <int dim>
feti::PrimalVectors thermal_loads(const StateSolver<dim> &solver, const ContactState<dim> &state);

/// Return c_T of all ranks.
template <int dim>
double thermal_energy(const StateSolver<dim> &solver, const ContactState<dim> &state);

/// Add work * d/dX (f_T'u) + energy * d/dX c_T at fixed u to the gradient: this rank's share.
template <int dim>
void add_thermal_gradient(const StateSolver<dim>              &solver,
                          const ContactState<dim>             &state,
                          double                               work,
                          double                               energy,
                          typename mesh::BodyMesh<dim>::Field &gradient);
/// @}
} // namespace snug::state

#endif
