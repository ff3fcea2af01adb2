#ifndef snug_state_springs_h
#define snug_state_springs_h

#include <snug/elasticity/face_load.h>
#include <snug/faces/nodal_normals.h>
#include <snug/state/model.h>

namespace snug::state {
/// A spring that pulls at nodes: the force -kappa (c . u) c, c . u = sum_a c_a . u_a. A row of
/// derivatives contains c' and kappa'.
template <int dim>
struct SpringRow
{
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> coefficients; ///< global node, c_a
  double stiffness = 0.; ///< kappa [force / length]
  /// factor of the length of the row of B, with which its compliance is not above that of the body
  double scale = 1.;
};

/**
 * This class computes the rows of springs (supports::Spring). A spring at a point in the direction
 * q has c_a = N_a q with the shape functions of the closest face, and those of masters instead of
 * hanging nodes. A spring on a boundary with the stiffness k per area is a spring at each Gauss
 * point of its faces with kappa = k dA. There q is an axis, or sum_a N_a n_a over its length with
 * the nodal normals n_a of a smooth side (supports::smooth_sides()); a rotation about the axis of a
 * round side then stretches no spring. All data are replicated. Members with positions are
 * collective.
 */
template <int dim>
class Springs
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// Collect the springs of the model at @p positions. References must outlive this object.
  /// @throws InputError for negative stiffnesses, and for points that are not on their boundary.
  Springs(const mesh::BodyMesh<dim>       &mesh,
          const Model<dim>                &model,
          const elasticity::FaceLoad<dim> &face_load,
          const Field                     &positions);

  bool empty() const { return places.empty(); }

  std::vector<SpringRow<dim>> rows(const Field &positions) const;

  /// Return the exact derivatives along @p velocity.
  std::vector<SpringRow<dim>> row_derivatives(const Field &positions, const Field &velocity) const;

  /// Add factor * d/dX sum_i kappa_i (c_i . u) (c_i . w) at fixed u and w to the gradient, for the
  /// forces kappa_i (c_i . u) and kappa_i (c_i . w). Add the share of this rank.
  void add_energy_gradient(const Field               &positions,
                           const std::vector<double> &forces_of_u,
                           const Field               &u,
                           const std::vector<double> &forces_of_w,
                           const Field               &w,
                           double                     factor,
                           Field                     &gradient) const;

  /// Force of a spring on the body at a node.
  struct Force
  {
    std::string            face; ///< "body.boundary"
    unsigned int           body;
    dealii::Tensor<1, dim> position, value;
  };
  /// Return the forces on the bodies for the forces kappa (c . u) of all rows. Collective.
  std::vector<Force> forces(const Field &positions, const std::vector<double> &forces_of_u) const;

private:
  using Nodes        = std::vector<dealii::Tensor<1, dim>>;
  using SurfaceField = typename mesh::Surface<dim>::Field;

  /// A spring on one smooth side, or at a point.
  struct Group
  {
    const supports::Spring<dim> *spring;
    std::vector<unsigned int>    faces; ///< of the side
  };

  /// A row: a point of a face.
  struct Place
  {
    unsigned int        group, face;
    std::vector<double> weights;     ///< shape functions of the face
    double              scale;       ///< see SpringRow
    unsigned int        gauss_point; ///< of the face
    double              stiffness;   ///< per area, or at the point
  };

  void   add_sides(const supports::Spring<dim> &spring, const SurfaceField &x);
  void   add_point(const supports::Spring<dim> &spring);
  void   set_scales(const SurfaceField &x);
  Nodes  at_face(unsigned int face, const SurfaceField &x) const;
  double stiffness(const Place        &place,
                   const SurfaceField &x,
                   const SurfaceField *velocity = nullptr) const;
  elasticity::FaceLoadValues<dim> load_of(const Place &place) const;
  dealii::Tensor<1, dim>          sum(const Place &place, const SurfaceField &field) const;
  SpringRow<dim>                  row(const Place &place, const dealii::Tensor<1, dim> &q) const;
  SurfaceField                    normals(const Group &group, const SurfaceField &x) const;

  const mesh::BodyMesh<dim>       &mesh;
  const Model<dim>                &model;
  const elasticity::FaceLoad<dim> &face_load;
  const faces::FaceShape<dim>      shape;
  const mesh::Surface<dim>         surface;
  std::vector<Group>               groups;
  std::vector<Place>               places; ///< of the rows, by group
};
} // namespace snug::state

#endif
