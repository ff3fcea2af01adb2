#ifndef snug_state_springs_h
#define snug_state_springs_h

#include <snug/contact/nearest_face.h>
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
  /// factor of the length of the row of B that makes its compliance as large as that of the body
  /// near it, or smaller
  double scale = 1.;
};

/**
 * This class computes the rows of springs (supports::Spring). A spring on a boundary with stiffness
 * k per area and direction q is one spring at each node a that does not hang, with c_a = q and
 * kappa_a = int N_a k dA, shares of hanging nodes at their masters. q is an axis or the nodal
 * normal of a smooth side (supports::smooth_sides()). A spring at a point has c_a = N_a q with the
 * shape functions of the closest face. All data are replicated. Members with positions are
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

  /// Force of a spring on the body at a place.
  struct Force
  {
    std::string            face; ///< "body.boundary"
    unsigned int           body;
    dealii::Tensor<1, dim> position, value;
  };
  /// Return the forces on the bodies for the forces kappa (c . u) of all rows.
  std::vector<Force> forces(const Field &positions, const std::vector<double> &forces_of_u) const;

private:
  using SurfaceField = typename mesh::Surface<dim>::Field;
  using Weights      = std::vector<std::pair<unsigned int, double>>; ///< surface nodes

  /// A spring on one smooth side, or at a point.
  struct Group
  {
    const supports::Spring<dim> *spring;
    std::vector<unsigned int>    faces; ///< of the side
    Weights                      at;    ///< shape functions of the point
  };

  /// A row.
  struct Place
  {
    unsigned int group;
    Weights      weights; ///< one node with the weight 1, or those of the point
    double       scale;
  };

  void                add_sides(const supports::Spring<dim> &spring, const SurfaceField &x);
  void                add_point(const supports::Spring<dim> &spring);
  Weights             without_hanging(const Weights &weights) const;
  std::vector<double> stiffnesses(const Group        &group,
                                  const SurfaceField &x,
                                  const SurfaceField *velocity = nullptr) const;
  void                add_stiffness_gradient(const Group               &group,
                                             const SurfaceField        &x,
                                             const std::vector<double> &factors,
                                             SurfaceField              &gradient) const;
  elasticity::FaceLoadValues<dim>     load_of(const Group &group, unsigned int face) const;
  std::vector<dealii::Tensor<1, dim>> at_face(unsigned int face, const SurfaceField &x) const;
  dealii::Tensor<1, dim>
       direction(const Group &group, const SurfaceField &normals, unsigned int node) const;
  bool is_normal(const Group &group) const;

  const mesh::BodyMesh<dim>       &mesh;
  const Model<dim>                &model;
  const elasticity::FaceLoad<dim> &face_load;
  const faces::FaceShape<dim>      shape;
  const mesh::Surface<dim>         surface;
  std::vector<Group>               groups;
  std::vector<Place>               places; ///< of the rows
};
} // namespace snug::state

#endif
