#ifndef snug_supports_dirichlet_constraints_h
#define snug_supports_dirichlet_constraints_h

#include <snug/faces/held_directions.h>
#include <snug/faces/nodal_normals.h>
#include <snug/supports/constraint_frame.h>
#include <snug/supports/support.h>

#include <functional>
#include <optional>

namespace snug::supports {
/**
 * This class collects the nodes that supports hold and the directions held there, as functions of
 * the node positions. Directions are those of components (Component), where the normal is the nodal
 * normal of the held face. In axisymmetric models the axis holds u_r. The constraints of each node
 * are made orthonormal, constant directions before those that follow the positions, each in the
 * order of the supports. A constraint whose direction the others hold already is left out. Hanging
 * nodes follow their masters and are not held themselves.
 *
 * A nodal normal belongs to a *side*, a smooth patch of faces. Two faces that share a node belong
 * to one side if their normals there are less than 40 degrees apart, unless they lie on different
 * boundaries that are both flat. A node where sides meet is held along the normals of all sides.
 *
 * The constructor determines the sides and the constraints that are left out, at the positions
 * given to it. All data are replicated on all ranks.
 */
template <int dim>
class DirichletConstraints
{
public:
  using Field  = mesh::Field<dim>;
  using Frames = ConstraintFrames<dim>; ///< per held node

  /// Collect the constraints. @p mesh must outlive this object. Collective.
  /// @throws InputError naming two supports that hold a node in one direction at different
  /// displacements, a point support without a node, or a support that holds a node on the axis of
  /// its radial or tangential component.
  DirichletConstraints(const mesh::BodyMesh<dim>            &mesh,
                       const std::vector<Support<dim>>      &supports,
                       unsigned int                          n_load_cases,
                       const Field                          &positions,
                       const std::vector<PointSupport<dim>> &points = {});

  /// Return the number of held nodes, which are ascending by global node.
  unsigned int n_nodes() const { return static_cast<unsigned int>(surface_nodes.size()); }
  /// Return the held node with this global node, or n_nodes() if the node is not held.
  unsigned int find(unsigned int global_node) const;

  /// Return whether the directions of a node follow the positions (normals, radial or
  /// tangential components are held).
  bool follows_positions(unsigned int held_node) const
  {
    return n_constant(held_node) < first_hold[held_node + 1] - first_hold[held_node];
  }
  /// Return whether the directions of any node follow the positions.
  bool follow_positions() const { return any_follows; }

  /// Return the orthonormal constraints at @p positions. Collective.
  /// @throws TangledMesh where held directions have become dependent.
  Frames frames(const Field &positions) const;

  /// Return the directions held at each node of @p surface, at @p positions. Collective.
  faces::HeldDirections<dim> directions(const mesh::Surface<dim> &surface,
                                        const Field              &positions) const;

  /// Return the exact derivatives of frames() along @p velocity; empty at nodes whose directions do
  /// not follow the positions. Collective.
  Frames frame_derivatives(const Field &positions, const Field &velocity) const;

  /**
   * Add d/dX sum_k reactions_k (q_k . u - s_k) at fixed u, where q_k . u = s_k, to @p gradient.
   * Each rank adds the share of its own nodes. Collective.
   * @param[in] reactions per held node and direction [force].
   */
  void add_energy_gradient(const Field                            &positions,
                           const Field                            &displacement,
                           const std::vector<std::vector<double>> &reactions,
                           Field                                  &gradient) const;

  /// Return the projection to the directions of a node in which its reaction is that of the
  /// supports of a @p boundary (body, boundary): zero if they do not hold the node, otherwise all
  /// directions but the constant ones that supports of other boundaries hold. If several boundaries
  /// hold directions that follow the positions, the first one has the reaction.
  dealii::Tensor<2, dim>
  reaction_directions(unsigned int                                 global_node,
                      const std::pair<unsigned int, unsigned int> &boundary) const;

  /// Force of a support on a node.
  struct Force
  {
    std::string            face; ///< name of the face of the support
    unsigned int           body;
    dealii::Tensor<1, dim> position, value;
  };

  /// Return the forces on the bodies that cause the @p reactions, which are defined as in
  /// add_energy_gradient(). The forces are equal on all ranks. Collective.
  std::vector<Force> forces(const Field                            &positions,
                            const std::vector<std::vector<double>> &reactions) const;

private:
  using SurfaceField = typename mesh::Surface<dim>::Field;
  using Normals      = std::vector<faces::NodalNormals<dim>>; ///< one per side

  /// A support, a support of one node, or the axis, which hold nodes.
  struct Holder
  {
    std::string    name; ///< name of the support
    std::string    face; ///< face of the support; "" for the axis
    Component<dim> component;
    /// body and boundary of the support; none for the axis
    std::optional<std::pair<unsigned int, unsigned int>> boundary;
  };

  /// One constraint of a node.
  struct Hold
  {
    unsigned int holder, side; ///< side to which the normal belongs
  };

  struct Found
  {
    unsigned int surface_node;
    Hold         hold;
  };

  /// Prescribed displacements of each holder per load case [length]. Missing and empty functions
  /// are zero.
  using Displacements = std::vector<std::vector<std::function<double(const dealii::Point<dim> &)>>>;

  void    collect_holds(const std::vector<Support<dim>> &supports,
                        Displacements                   &displacements,
                        std::vector<Found>              &found);
  void    collect_points(const std::vector<PointSupport<dim>> &points,
                         Displacements                        &displacements,
                         std::vector<Found>                   &found);
  void    store(std::vector<Found> found, const Displacements &displacements);
  bool    is_equal(const Hold &a, const Hold &b) const;
  void    leave_out_dependent(const SurfaceField &positions);
  Normals normals(const SurfaceField &positions) const;

  const Component<dim> &component(const std::size_t hold) const
  {
    return holders[holds[hold].holder].component;
  }
  /// Return the number of constraints of a node that do not follow the positions. They come first.
  unsigned int n_constant(unsigned int held_node) const;

  /// Return the given constraints @p first to @p end, which belong to one node.
  ConstraintFrame<dim> given_frame(unsigned int        surface_node,
                                   std::size_t         first,
                                   std::size_t         end,
                                   const SurfaceField &positions,
                                   const Normals      &normals) const;
  ConstraintFrame<dim>
  given_frame(unsigned int held_node, const SurfaceField &positions, const Normals &normals) const
  {
    return given_frame(surface_nodes[held_node], first_hold[held_node], first_hold[held_node + 1],
                       positions, normals);
  }

  const mesh::BodyMesh<dim>             &mesh;
  const faces::FaceShape<dim>            shape;
  const unsigned int                     n_load_cases;
  mesh::Surface<dim>                     surface;
  std::vector<std::vector<unsigned int>> sides; ///< surface faces per side
  std::vector<unsigned int>              side_of_face;
  std::vector<Holder>                    holders;
  std::vector<unsigned int>              surface_nodes; ///< of the held nodes, ascending
  std::vector<unsigned int>              first_hold;    ///< of each held node, and the end
  std::vector<Hold>                      holds;
  std::vector<double>                    values; ///< n_load_cases per hold [length]
  bool                                   any_follows = false;
};
} // namespace snug::supports

#endif
