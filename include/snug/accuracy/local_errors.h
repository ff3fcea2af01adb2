#ifndef snug_accuracy_local_errors_h
#define snug_accuracy_local_errors_h

#include <snug/accuracy/applied_forces.h>
#include <snug/accuracy/cell_fields.h>
#include <snug/elasticity/local_error.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace snug::accuracy {
/// This struct holds products and norms of the local errors e_i of displacements in a cell, see
/// elasticity::LocalError. Both have the correction factor of quadratic elements, and products also
/// that of mixed elements of degree 2.
struct CellErrors
{
  /// a(e_0, e_i); for B-bar a_+(e_0, e_i) - kappa (d_0, d_i), which contains the errors of the
  /// pressures
  std::vector<double> products;
  /// norms of the errors of the stress: a(e_i, e_i)^(1/2); for B-bar
  /// (a_+(e_i, e_i) + kappa (d_i, 2 div e_i + d_i))^(1/2)
  std::vector<double> norms;
};

/**
 * This class solves the local problems of LocalError in all cells of this rank, with tractions
 *   t = (sigma_h + sigma_h') n / 2   between cells, with sigma_h' of the neighbor,
 *   t = traction of the loads        on the boundary,
 *   t = -p n                         on both sides of contact (ContactSides), plus friction,
 *   t of the rows                    on both sides of ties, with opposite signs,
 *   t = -k (q . u) q                 of springs with the stiffness k per area along the unit
 *                                    vector q,
 * and with held directions at supports.
 */
template <int dim>
class LocalErrors
{
public:
  using Field    = mesh::Field<dim>;
  using Residual = elasticity::LocalResidual;

  /// Use the geometry and the loads of @p state. References must outlive this object. Collective.
  LocalErrors(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// Return the products of each cell of this rank for fields at all local nodes. Collective.
  std::vector<CellErrors> products(const std::vector<LoadedDisplacement<dim>> &of) const;

private:
  using Nodes     = typename CellFields<dim>::Nodes;
  using Loaded    = LoadedDisplacement<dim>;
  using Functions = typename elasticity::LocalSpace<dim>::Functions;

  /// Values at the points of a face of a cell.
  struct FaceShapes
  {
    std::vector<mesh::LagrangePoint<dim>> shapes;
    std::vector<Functions>                functions;
  };

  using Residuals = std::vector<std::vector<Residual>>; ///< [displacement][cell]

  /// Pressures and tractions on the slave side of rows of contact or of ties; empty: none.
  struct RowTractions
  {
    std::vector<double>                 pressures;
    std::vector<dealii::Tensor<1, dim>> tractions;
  };

  const state::StateSolver<dim>           &solver;
  const state::ContactState<dim>          &state;
  const mesh::BodyMesh<dim>               &mesh;
  const CellFields<dim>                    fields;
  const AppliedForces<dim>                 applied;
  std::vector<elasticity::LocalSpace<dim>> spaces;      ///< per body
  std::array<FaceShapes, 2 * dim>          face_points; ///< points of the reference cell
  /// points of the neighbors of interior faces, by relative position of the neighbor
  std::map<std::uint64_t, FaceShapes>     beyond;
  std::vector<elasticity::HeldFaces<dim>> held; ///< per cell of this rank

  static std::uint64_t placing(const mesh::InteriorFace<dim> &face);

  FaceShapes points(const std::vector<dealii::Point<dim>> &at) const;
  dealii::Tensor<1, dim>
        area_vector(const mesh::LagrangePoint<dim> &shape, unsigned int face, const Nodes &X) const;
  void  find_held();
  Nodes body_forces(unsigned int cell, const Loaded &of) const;
  void  add_interior_faces(const std::vector<Loaded> &of, Residuals &r) const;
  void  add_loads(const Loaded &of, std::vector<Residual> &r) const;
  /// Add the pressures and the tractions of contact or tied rows to the residuals.
  void      add_rows(const contact::Contact<dim>     &contact,
                     const std::vector<RowTractions> &of,
                     Residuals                       &r) const;
  void      add_springs(const Loaded &of, std::vector<Residual> &r) const;
  Residuals on_faces(const std::vector<Loaded> &of) const;
};
} // namespace snug::accuracy

#endif
