#ifndef snug_contact_placed_surface_h
#define snug_contact_placed_surface_h

#include <snug/contact/row_group.h>
#include <snug/faces/held_directions.h>
#include <snug/geometry/rigid_motion.h>

#include <map>
#include <memory>
#include <string>

namespace snug::contact {
/// Position of the bodies and obstacles: motions of those that are not where the scene places them.
template <int dim>
struct Position
{
  std::map<unsigned int, geometry::RigidMotion<dim>> bodies; ///< by index
  std::map<std::string, geometry::RigidMotion<dim>>  obstacles;

  bool operator==(const Position &other) const
  {
    return bodies == other.bodies && obstacles == other.obstacles;
  }

  /// Return the motion of a body; the identity if the body does not move.
  geometry::RigidMotion<dim> of_body(unsigned int body) const;
  /// Return the motion of an obstacle.
  geometry::RigidMotion<dim> of_obstacle(const std::string &name) const;
};

/**
 * This class is a surface whose bodies are in a position. Positions and displacements of nodes are
 * known in the frame of their body, in which stiffness, supports and loads do not depend on the
 * position. Contact needs them in space:
 * @f[ x = Q X + t, \quad u_{space} = Q u, \quad c_{body} = Q^T c_{space}. @f]
 * All functions return their argument if no body moves.
 */
template <int dim>
class PlacedSurface
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Move @p surface, which must outlive this object.
  PlacedSurface(const mesh::Surface<dim> &surface, const Position<dim> &position);

  const mesh::Surface<dim> &surface() const { return placed ? *placed : original; }
  bool                      is_moved() const { return placed != nullptr; }
  /// Return the surface with the bodies where the scene places them.
  const mesh::Surface<dim> &unmoved() const { return original; }

  /// Return positions of points or nodes in space.
  Field to_space(Field positions) const;
  /// Return vectors at points or nodes, such as displacements, in space.
  Field turned(Field vectors) const;
  /// Return vectors in space in the frames of the bodies.
  Field turned_back(Field vectors) const;
  /// Return held directions of the nodes in space.
  faces::HeldDirections<dim> turned(faces::HeldDirections<dim> held) const;
  /// Return the vector of @p node, of its body, in space.
  dealii::Tensor<1, dim> turned(unsigned int node, const dealii::Tensor<1, dim> &vector) const
  {
    return placed ? motions[body[node]].vector(vector) : vector;
  }
  /// Return a row with the coefficients of the frames of the bodies with those in space.
  Row<dim> turned(Row<dim> row) const;
  /// Return rows with the coefficients of the frames of the bodies. Normals remain in space.
  std::vector<Row<dim>> turned_back(std::vector<Row<dim>> rows) const;

private:
  const mesh::Surface<dim>                 &original;
  std::vector<unsigned int>                 body; ///< per point; empty if no body moves
  std::vector<geometry::RigidMotion<dim>>   motions;
  std::unique_ptr<const mesh::Surface<dim>> placed; ///< null: no body moves
};
} // namespace snug::contact

#endif
