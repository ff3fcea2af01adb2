#ifndef snug_accuracy_local_errors_h
#define snug_accuracy_local_errors_h

#include <snug/elasticity/local_error.h>
#include <snug/response/response.h>

#include <array>
#include <map>
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
  using Residual = elasticity::LocalResidual;

  /// At the geometry and with the loads of @p state. References must outlive this. Collective.
  LocalErrors(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// a(e_i, e_j) of each cell of this rank for all i, j of @p of, row by row, fields at all
  /// local nodes. Collective.
  std::vector<std::vector<double>> products(const std::vector<LoadedDisplacement<dim>> &of) const;

private:
  using Nodes     = std::vector<dealii::Tensor<1, dim>>;
  using Loaded    = LoadedDisplacement<dim>;
  using Functions = typename elasticity::LocalSpace<dim>::Functions;

  /// Points of a face of a cell.
  struct FacePoints
  {
    std::vector<mesh::LagrangePoint<dim>> shapes;
    std::vector<Functions>                functions;
  };

  const state::StateSolver<dim>           &solver;
  const state::ContactState<dim>          &state;
  const mesh::BodyMesh<dim>               &mesh;
  std::vector<elasticity::Element<dim>>    elements; ///< per body
  std::vector<elasticity::LocalSpace<dim>> spaces;   ///< per body
  Field                                    positions, displacement;
  std::array<FacePoints, 2 * dim>          face_points; ///< of the reference cell
  /// of the neighbours of interior faces, by how they lie to each other
  std::map<std::vector<unsigned char>, FacePoints> beyond;
  std::vector<elasticity::HeldFaces<dim>>          held; ///< per cell of this rank

  static std::vector<unsigned char> placing(const mesh::InteriorFace<dim> &face);

  FacePoints                  points(const std::vector<dealii::Point<dim>> &at) const;
  const elasticity::Material &material(const typename mesh::BodyMesh<dim>::Cell &cell) const;
  Nodes                       at_cell(unsigned int cell, const Field &field) const;
  dealii::Tensor<1, dim>
       area_vector(const mesh::LagrangePoint<dim> &shape, unsigned int face, const Nodes &X) const;
  void find_held();
  std::vector<dealii::SymmetricTensor<2, 3>>
        stresses(unsigned int                                 cell,
                 const Loaded                                &of,
                 const std::vector<mesh::LagrangePoint<dim>> &at) const;
  Nodes body_forces(unsigned int cell, double factor) const;
  void  add_interior_faces(const Loaded &of, std::vector<Residual> &r) const;
  void  add_loads(const Loaded &of, std::vector<Residual> &r) const;
  void  add_contact(const std::vector<double> &pressures, std::vector<Residual> &r) const;
  std::vector<Residual> on_faces(const Loaded &of) const;
};
} // namespace snug::accuracy

#endif
