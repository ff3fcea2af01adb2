#ifndef snug_supports_dirichlet_constraints_h
#define snug_supports_dirichlet_constraints_h

#include <snug/faces/held_directions.h>
#include <snug/faces/nodal_normals.h>
#include <snug/supports/constraint_frame.h>
#include <snug/supports/support.h>

namespace snug::supports {
/**
 * The nodes that supports hold and the directions held there, as functions
 * of the node positions: axes, and the nodal normals of faces held along
 * their normal. In axisymmetric models the axis holds u_r. Each node's
 * constraints are made orthonormal, axes before normals, each in the order
 * of the supports; one whose direction the others hold already is left
 * out. Hanging nodes follow their masters and are not held themselves.
 *
 * A nodal normal belongs to a *side*, a smooth patch of faces: two faces
 * that share a node belong to one side if their normals there are less
 * than 40 degrees apart, unless they lie on different boundaries that are
 * both flat. A node where sides meet is held along the normals of all.
 *
 * Sides and what is left out are decided at the positions given to the
 * constructor. Everything is replicated on all ranks.
 */
template <int dim>
class DirichletConstraints
{
public:
  using Field  = typename mesh::BodyMesh<dim>::Field;
  using Frames = std::vector<ConstraintFrame<dim>>; ///< per held node

  /// @p mesh must outlive this object. Collective.
  /// @throws InputError naming two supports that hold a node in one
  ///   direction at different displacements.
  DirichletConstraints(const mesh::BodyMesh<dim>       &mesh,
                       const std::vector<Support<dim>> &supports,
                       unsigned int                     n_load_cases,
                       const Field                     &positions);

  /// Held nodes, ascending by global node.
  unsigned int n_nodes() const { return nodes.size(); }
  /// The held node with this global node, or n_nodes().
  unsigned int find(unsigned int global_node) const;

  /// Whether a node's directions follow the positions (normals are held).
  bool follows_positions(unsigned int held_node) const { return nodes[held_node].follows; }
  /// Whether any node's directions do.
  bool follow_positions() const { return !sides.empty(); }

  /// Orthonormal constraints at @p positions. Collective.
  /// @throws TangledMesh where held directions have become dependent.
  Frames frames(const Field &positions) const;

  /// What is held at each node of @p surface, at @p positions. Collective.
  faces::HeldDirections<dim> directions(const mesh::Surface<dim> &surface,
                                        const Field              &positions) const;

  /// Derivatives of frames() along @p velocity, exact; empty at nodes whose
  /// directions do not follow the positions. Collective.
  Frames frame_derivatives(const Field &positions, const Field &velocity) const;

  /**
   * gradient += d/dX sum_k reactions_k (q_k . u - s_k) at fixed u, where
   * q_k . u = s_k: the share of this rank's own nodes. Collective.
   * @param[in] reactions per held node and direction [force].
   */
  void add_energy_gradient(const Field                            &positions,
                           const Field                            &displacement,
                           const std::vector<std::vector<double>> &reactions,
                           Field                                  &gradient) const;

  /// A force of a support on a node.
  struct Force
  {
    std::string            face; ///< of the support
    dealii::Tensor<1, dim> position, value;
  };

  /// Forces on the bodies that make the @p reactions, as above; equal on all
  /// ranks. Collective.
  std::vector<Force> forces(const Field                            &positions,
                            const std::vector<std::vector<double>> &reactions) const;

private:
  using SurfaceField = typename mesh::Surface<dim>::Field;
  using Normals      = std::vector<faces::NodalNormals<dim>>; ///< of sides

  /// One constraint of a node.
  struct Hold
  {
    std::string         name;      ///< of its support
    std::string         face;      ///< of the support, "" of the axis
    unsigned int        component; ///< axis, or Support::normal
    unsigned int        side;      ///< whose normal
    std::vector<double> values;    ///< per load case [length]
  };

  struct Node
  {
    unsigned int      surface_node;
    std::vector<Hold> holds;
    bool              follows = false;
  };

  void    collect_holds(const std::vector<Support<dim>> &supports, const SurfaceField &reference);
  void    leave_out_dependent(const SurfaceField &positions);
  double  largest_value() const;
  Normals normals(const SurfaceField &positions) const;
  ConstraintFrame<dim> given_frame(const Node &node, const Normals &normals) const;

  const mesh::BodyMesh<dim>             &mesh;
  const faces::FaceShape<dim>            shape;
  const unsigned int                     n_load_cases;
  mesh::Surface<dim>                     surface;
  std::vector<std::vector<unsigned int>> sides; ///< surface faces of each
  std::vector<unsigned int>              side_of_face;
  std::vector<Node>                      nodes;
  Frames                                 constant_frames;
};
} // namespace snug::supports

#endif
