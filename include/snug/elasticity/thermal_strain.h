#ifndef snug_elasticity_thermal_strain_h
#define snug_elasticity_thermal_strain_h

#include <snug/mesh/lagrange.h>

#include <functional>

namespace snug::elasticity {
/// Thermal strain e = alpha dT at a point of a cell, given by its shape functions. The thermal
/// strain is e I, and the stress C (eps - e I). An empty function stands for zero.
template <int dim>
using ThermalStrain = std::function<double(const mesh::LagrangePoint<dim> &)>;
} // namespace snug::elasticity

#endif
