#ifndef snug_accuracy_local_errors_h
#define snug_accuracy_local_errors_h

#include <snug/elasticity/local_error.h>
#include <snug/state/state_solver.h>

#include <array>
#include <vector>

namespace snug::accuracy {
/// A displacement and what acts on the bodies with it.
template <int dim>
struct LoadedDisplacement
{
  typename mesh::BodyMesh<dim>::Field displacement; ///< at local nodes, or zero velocities
  /// of contact rows, as pressures [force / length^2]
  std::vector<double> pressures;
  bool                has_loads = true; ///< those of the load case
};

/**
 * The local problems of LocalError in all cells of this rank, with tractions
 *   t = (sigma_h + sigma_h') n / 2   between cells, sigma_h' the neighbour's,
 *   t = those of the loads           on the boundary,
 *   t = -p n                         on both sides of contact (ContactPressure),
 * and held directions where supports are.
 */
template <int dim>
class LocalErrors
{
public:
  using Field    = typename mesh::BodyMesh<dim>::Field;
  using Residual = typename elasticity::LocalError<dim>::Residual;

  /// At the geometry and with the loads of @p state. References must outlive this. Collective.
  LocalErrors(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// a(e_i, e_j) of each cell of this rank for all i, j of @p of, row by row. Collective.
  std::vector<std::vector<double>> products(const std::vector<LoadedDisplacement<dim>> &of) const;

private:
  using Nodes = std::vector<dealii::Tensor<1, dim>>;

  struct FacePoint;

  const state::StateSolver<dim>           &solver;
  const state::ContactState<dim>          &state;
  const mesh::BodyMesh<dim>               &mesh;
  std::vector<elasticity::Element<dim>>    elements; ///< per body
  std::vector<elasticity::LocalError<dim>> local;    ///< per body
  Field                                    positions;
  /// of the faces of the reference cell
  std::array<std::vector<mesh::LagrangePoint<dim>>, 2 * dim> face_points;
  std::vector<elasticity::HeldFaces<dim>>                    held; ///< per cell of this rank

  const elasticity::Material &material(const typename mesh::BodyMesh<dim>::Cell &cell) const;
  Nodes                       at_cell(unsigned int cell, const Field &field) const;
  dealii::Tensor<1, dim>
       area_vector(const mesh::LagrangePoint<dim> &shape, unsigned int face, const Nodes &X) const;
  void find_held();
  void add_cells(const LoadedDisplacement<dim> &of, std::vector<Residual> &r) const;
  void add_interior_faces(const Field &displacement, std::vector<Residual> &r) const;
  void add_loads(std::vector<Residual> &r) const;
  void add_contact(const std::vector<double> &pressures, std::vector<Residual> &r) const;
};
} // namespace snug::accuracy

#endif
