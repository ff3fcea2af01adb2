#ifndef snug_accuracy_surface_layer_h
#define snug_accuracy_surface_layer_h

#include <snug/accuracy/applied_forces.h>
#include <snug/accuracy/contact_pressure.h>

#include <deal.II/base/quadrature_lib.h>

#include <array>

namespace snug::accuracy {
/**
 * The layer between the faces of a mesh and the true surface. Each point y of a face corresponds
 * to a point y + delta of the true surface. With the forces F(u) of loads, supports and contact of
 * u,
 *   B(u, v) = int delta . n sigma(u) : eps(v) dA - [F(u) . v] - [F(v) . u]  [force length].
 * The brackets [] are the sum over the true surface, where v = v(y) + grad v delta, minus the sum
 * over the faces. B is the derivative of a(u, v) - F(u) . v - F(v) . u with respect to delta, of
 * first order in delta. Only faces with samples contribute, because all other faces are flat.
 */
template <int dim>
class SurfaceLayer
{
public:
  using Loaded = LoadedDisplacement<dim>;

  /// Use the geometry and the loads of @p state. References must outlive this object. Collective.
  SurfaceLayer(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// Return B(first, other) of each cell of this rank for the first of @p of and each entry of
  /// @p of, with fields at all local nodes. Collective.
  std::vector<std::vector<double>> works(const std::vector<Loaded> &of) const;

private:
  using Face  = typename mesh::BodyMesh<dim>::Face;
  using Field = mesh::Field<dim>;

  /// A point of a face, and the corresponding point of the true surface.
  struct Point
  {
    FacePoint<dim> on_face, on_surface;
  };
  /// Values of a displacement at a point of a face.
  struct Local
  {
    dealii::SymmetricTensor<2, 3> stress;
    dealii::Tensor<1, dim>        value;
    dealii::Tensor<1, dim>        change; ///< of the value on the way to the true surface
    dealii::Tensor<1, dim>        change_along_normal; ///< change along the normal of the face
    dealii::Tensor<1, dim> same; ///< forces that are equal on the face and on the true surface
    dealii::Tensor<1, dim> by_area, by_area_beyond;
    dealii::Tensor<1, dim> by_volume;
  };

  std::vector<Point>              points(const Face &face) const;
  bool                            is_flat(const std::vector<Point> &at) const;
  bool                            is_supported(const Face &face) const;
  static double                   work_beyond(const Local &of, const Local &on);
  std::vector<std::vector<Local>> locals(const Face                    &face,
                                         const std::vector<Point>      &at,
                                         const std::vector<Loaded>     &of,
                                         const ContactSides<dim>       *sides,
                                         const std::vector<PairValues> &pressures) const;

  const state::StateSolver<dim>  &solver;
  const state::ContactState<dim> &state;
  const CellFields<dim>           fields;
  const AppliedForces<dim>        applied;
  const dealii::QGauss<dim - 1>   gauss;
  /// functions of the nodes and of the samples of a face, and of a cell at each of its faces, at
  /// the points
  std::vector<mesh::LagrangePoint<dim - 1>>                  at_nodes, at_samples;
  std::array<std::vector<mesh::LagrangePoint<dim>>, 2 * dim> in_cell;
};
} // namespace snug::accuracy

#endif
