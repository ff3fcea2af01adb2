#ifndef snug_accuracy_cell_fields_h
#define snug_accuracy_cell_fields_h

#include <snug/response/response.h>

#include <vector>

namespace snug::accuracy {
/// A displacement and the loads that act on the bodies with it.
template <int dim>
struct LoadedDisplacement
{
  mesh::Field<dim> displacement; ///< at all local nodes
  /// pressures of the contact rows [force / length^2]; empty: none
  std::vector<double> pressures;
  /// friction tractions of the contact rows on the slave sides, in space [force / length^2]; empty:
  /// none
  std::vector<dealii::Tensor<1, dim>> shears = {};
  /// tractions of the normal rows of ties on the slave sides [force / length^2]; empty: none
  std::vector<dealii::Tensor<1, dim>> ties    = {};
  double                              loads   = 1.; ///< factor of the loads of the load case
  double                              thermal = 1.; ///< factor of its thermal strains
  /// further traction and stress that act; null: none
  const response::FieldDerivative<dim> *more = nullptr;
};

/// Stresses and fluxes of displacements in the cells of this rank, and in their neighbors on other
/// ranks.
template <int dim>
class CellFields
{
public:
  using Field    = mesh::Field<dim>;
  using Nodes    = std::vector<dealii::Tensor<1, dim>>; ///< per node of a cell
  using Shapes   = std::vector<mesh::LagrangePoint<dim>>;
  using Stresses = typename elasticity::Element<dim>::Stresses;

  /// Use the geometry of @p state. References must outlive this object. Collective.
  CellFields(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  Nodes at_cell(unsigned int cell, const Field &field) const;
  Nodes positions(unsigned int cell) const { return at_cell(cell, local_positions); }
  const elasticity::Material &material(unsigned int cell) const;

  /// Return the stresses of each displacement and of its factor times the thermal strains of the
  /// load case at points of a cell, with the element's formulation.
  std::vector<Stresses> stresses(unsigned int                                cell,
                                 const std::vector<LoadedDisplacement<dim>> &of,
                                 const Shapes                               &at) const;

  /// Return the stresses() of each displacement minus the further stress that acts: the flux that
  /// is continuous between cells.
  std::vector<Stresses>
  fluxes(unsigned int cell, const std::vector<LoadedDisplacement<dim>> &of, const Shapes &at) const;

  const Field local_positions, displacement;

private:
  using Strained = typename elasticity::Element<dim>::Strained;

  Strained strained(unsigned int cell, const Field &u, double thermal) const;

  const state::StateSolver<dim>            &solver;
  const std::vector<state::BodyLoads<dim>> &loads;    ///< per body
  std::vector<elasticity::Element<dim>>     elements; ///< per body
};

/// Return sigma area.
template <int dim>
dealii::Tensor<1, dim> traction(const dealii::SymmetricTensor<2, 3> &sigma,
                                const dealii::Tensor<1, dim>        &area)
{
  dealii::Tensor<1, dim> force;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      force[c] += sigma[c][d] * area[d];
  return force;
}
} // namespace snug::accuracy

#endif
