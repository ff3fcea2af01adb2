#ifndef snug_accuracy_cell_fields_h
#define snug_accuracy_cell_fields_h

#include <snug/response/response.h>

#include <vector>

namespace snug::accuracy {
/// A displacement and what acts on the bodies with it.
template <int dim>
struct LoadedDisplacement
{
  typename mesh::BodyMesh<dim>::Field displacement; ///< at all local nodes
  /// of contact rows, as pressures [force / length^2]
  std::vector<double> pressures;
  double              loads = 1.; ///< factor of those of the load case
  /// what else acts, its traction and stress; null: nothing
  const response::FieldDerivative<dim> *more = nullptr;
};

/// What displacements make of the cells of this rank, and of those beside them on others.
template <int dim>
class CellFields
{
public:
  using Field  = typename mesh::BodyMesh<dim>::Field;
  using Nodes  = std::vector<dealii::Tensor<1, dim>>; ///< per node of a cell
  using Shapes = std::vector<mesh::LagrangePoint<dim>>;

  /// At the geometry of @p state. References must outlive this. Collective.
  CellFields(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  Nodes at_cell(unsigned int cell, const Field &field) const;
  Nodes positions(unsigned int cell) const { return at_cell(cell, local_positions); }
  const elasticity::Material &material(unsigned int cell) const;

  /// Of the displacement @p u at points of a cell, with the element's formulation.
  std::vector<dealii::SymmetricTensor<2, 3>>
  stresses(unsigned int cell, const Field &u, const Shapes &at) const;

  /// Of the displacement, less what acts as one: the flux that is continuous between cells.
  std::vector<dealii::SymmetricTensor<2, 3>>
  fluxes(unsigned int cell, const LoadedDisplacement<dim> &of, const Shapes &at) const;

  const Field local_positions, displacement;

private:
  const state::StateSolver<dim>        &solver;
  std::vector<elasticity::Element<dim>> elements; ///< per body
};

/// sigma area
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
