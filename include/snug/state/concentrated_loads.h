#ifndef snug_state_concentrated_loads_h
#define snug_state_concentrated_loads_h

#include <snug/elasticity/face_load.h>
#include <snug/faces/face_shape.h>
#include <snug/state/model.h>

namespace snug::state {
/**
 * This class finds the faces that carry forces at points and along lines (PlacedForce), in the
 * reference geometry. A point belongs to the closest face. The shape functions of this face
 * distribute its force, so that force and moment do not depend on the mesh. A line on a boundary
 * is cut into pieces of an eighth of the smallest face, with the force of a piece at its middle.
 * The common edge of two boundaries consists of edges of faces with Gauss points.
 */
template <int dim>
class ConcentratedLoads
{
public:
  using Forces = std::vector<elasticity::ConcentratedForce<dim>>;

  /// Find the faces. @p mesh must outlive this object. Collective.
  /// @throws InputError for a place that is not on its boundary.
  ConcentratedLoads(const mesh::BodyMesh<dim> &mesh, const std::vector<LoadCase<dim>> &load_cases);

  /// Return the forces on a face of BodyMesh::boundary_faces() in a load case.
  const Forces &on_face(unsigned int load_case, unsigned int face) const;

private:
  using Boundary = std::pair<unsigned int, unsigned int>; ///< body and boundary
  using Force    = elasticity::ConcentratedForce<dim>;

  class LoadedBoundary;

  /// Add the forces on faces of this rank that a force at a point or along a line causes.
  /// @throws InputError for a place that is not on @p boundary.
  void add(const PlacedForce<dim> &placed, unsigned int load_case, const LoadedBoundary &boundary);

  const mesh::BodyMesh<dim>                  &mesh;
  const faces::FaceShape<dim>                 shape;
  std::vector<std::map<unsigned int, Forces>> forces; ///< [load case][face of this rank]
};
} // namespace snug::state

#endif
