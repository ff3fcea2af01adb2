#ifndef snug_accuracy_surface_layer_h
#define snug_accuracy_surface_layer_h

#include <snug/accuracy/applied_forces.h>
#include <snug/accuracy/contact_pressure.h>

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

  /// A point of a face in its cell, and the corresponding point of the true surface.
  struct Point
  {
    mesh::LagrangePoint<dim> shape;
    FacePoint<dim>           on_face, on_surface;
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
  };

  std::vector<Point> points(const Face &face) const;
  bool               is_supported(const Face &face) const;
  static double      work_beyond(const Local &of, const Local &on);
  std::vector<Local> locals(const Face                 &face,
                            const std::vector<Point>   &at,
                            const Loaded               &of,
                            const ContactPressure<dim> *contact) const;

  const state::StateSolver<dim>  &solver;
  const state::ContactState<dim> &state;
  const CellFields<dim>           fields;
  const AppliedForces<dim>        applied;
};
} // namespace snug::accuracy

#endif
