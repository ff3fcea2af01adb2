#ifndef snug_accuracy_surface_layer_h
#define snug_accuracy_surface_layer_h

#include <snug/accuracy/applied_forces.h>
#include <snug/accuracy/contact_pressure.h>

namespace snug::accuracy {
/**
 * What lies between the faces of a mesh and the true surface, which a point y of a face stands
 * for. With delta the way from y to it and F(u) the forces of loads, supports and contact of u,
 *   B(u, v) = int delta . n sigma(u) : eps(v) dA - [F(u) . v] - [F(v) . u]  [force length],
 * [] the difference of the sum over the true surface, v = v(y) + grad v delta there, to that over
 * the faces: the derivative of a(u, v) - F(u) . v - F(v) . u by delta. Of first order in delta;
 * only of faces with samples, the others are flat.
 */
template <int dim>
class SurfaceLayer
{
public:
  using Loaded = LoadedDisplacement<dim>;

  /// At the geometry and with the loads of @p state. References must outlive this. Collective.
  SurfaceLayer(const state::StateSolver<dim> &solver, const state::ContactState<dim> &state);

  /// B(first, second) of each cell of this rank for the first of @p of and each of them,
  /// fields at all local nodes. Collective.
  std::vector<std::vector<double>> works(const std::vector<Loaded> &of) const;

private:
  using Face  = typename mesh::BodyMesh<dim>::Face;
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// A point of a face in its cell, and the point of the true surface it stands for.
  struct Point
  {
    mesh::LagrangePoint<dim> shape;
    FacePoint<dim>           on_face, on_surface;
  };
  /// What a displacement makes at a point of a face.
  struct Local
  {
    dealii::SymmetricTensor<2, 3> stress;
    dealii::Tensor<1, dim>        value;
    dealii::Tensor<1, dim>        change;              ///< on the way to the true surface
    dealii::Tensor<1, dim>        change_along_normal; ///< of the face
    dealii::Tensor<1, dim>        same;                ///< forces, on the face and beyond
    dealii::Tensor<1, dim>        by_area, by_area_beyond;
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
