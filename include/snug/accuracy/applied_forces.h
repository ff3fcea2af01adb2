#ifndef snug_accuracy_applied_forces_h
#define snug_accuracy_applied_forces_h

#include <snug/accuracy/cell_fields.h>

namespace snug::accuracy {
/// A point of a boundary face, or the point of the true surface that corresponds to it.
template <int dim>
struct FacePoint
{
  dealii::Tensor<1, dim> reference, position; ///< [length]
  dealii::Tensor<1, dim> area;                ///< n dA, n outward [length^2]
};

/// The forces of loads and of response derivatives at points of cells and boundary faces of this
/// rank.
template <int dim>
class AppliedForces
{
public:
  using Cell = typename mesh::BodyMesh<dim>::Cell;
  using Face = typename mesh::BodyMesh<dim>::Face;

  /// Use the loads of @p state. References must outlive this object. Collective.
  AppliedForces(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  bool act_on(const Face &face, const LoadedDisplacement<dim> &of) const;

  /// Return t dA [force] of pressures and tractions per area. On the true surface they act with
  /// its area.
  dealii::Tensor<1, dim>
  by_area(const Face &face, const FacePoint<dim> &point, const LoadedDisplacement<dim> &of) const;

  /// Return t dA [force] of total forces and moments, which are distributed over the faces of the
  /// mesh.
  dealii::Tensor<1, dim>
  spread(const Face &face, const FacePoint<dim> &point, const LoadedDisplacement<dim> &of) const;

  bool act_in(const Cell &cell, const LoadedDisplacement<dim> &of) const;

  /// Return the body forces [force / length^3] at the reference position @p reference.
  dealii::Tensor<1, dim> by_volume(const Cell                    &cell,
                                   const dealii::Tensor<1, dim>  &reference,
                                   const LoadedDisplacement<dim> &of) const;

private:
  using Tractions = typename state::ResultantLoads<dim>::Tractions::value_type;

  static bool has_more(const Face &face, const LoadedDisplacement<dim> &of);

  const state::BoundaryLoad<dim> *load(const Face &face) const;

  const state::Model<dim>                  &model;
  const std::vector<state::BodyLoads<dim>> &bodies;
  const Tractions                           tractions; ///< tractions of the resultants
};
} // namespace snug::accuracy

#endif
