#ifndef snug_shape_shaped_face_h
#define snug_shape_shaped_face_h

#include <snug/mesh/surface.h>
#include <snug/shape/shape_parameters.h>

namespace snug::shape {
/**
 * The shaped face of a body in the reference geometry. This class holds the nodes, normals,
 * tributary areas and border nodes of the face, equal on all ranks.
 */
template <int dim>
class ShapedFace
{
public:
  using Field = typename mesh::Surface<dim>::Field; ///< per surface node or point

  /// Find the face of the entry Face. Collective. @throws InputError naming the entry Face. The
  /// mesh must outlive this object.
  ShapedFace(const mesh::BodyMesh<dim> &mesh,
             const BodyNames           &bodies,
             const ShapeParameters     &parameters);

  const mesh::BodyMesh<dim> &mesh() const { return body_mesh; }
  unsigned int               body() const { return places.front().first; }
  /// Return the boundaries of the body that make the face, in the order of the entry.
  const std::vector<unsigned int> &boundaries() const { return own_boundaries; }
  /// Return whether a boundary of the body belongs to the face.
  bool                      has(unsigned int boundary) const;
  const mesh::Surface<dim> &surface() const { return nodes; }

  /// Return the reference positions of the surface points [length].
  const Field &positions() const { return nodes.reference_positions(); }
  /// Return the unit outward normals at the surface points. Where the face meets a plane boundary
  /// of the body and the angle between normal and plane is less than 25 degrees, the normal is
  /// projected onto the plane, so that shapes stay in symmetry planes.
  const Field &normals() const { return unit_normals; }
  /// Return the unit outward normals without this projection.
  const Field &free_normals() const { return surface_normals; }
  /// Return the tributary areas of the surface points [length^(dim-1)]. The areas of hanging nodes
  /// and samples are zero.
  const std::vector<double> &areas() const { return node_areas; }
  /// Return, for each surface node, whether other boundaries of the body share the node.
  const std::vector<bool> &border() const { return on_border; }

  bool is_hanging(unsigned int surface_node) const { return !nodes.masters(surface_node).empty(); }

  /// Return the surface points whose moves this rank needs: all nodes of the face, then the samples
  /// of this rank in the order of surface().samples().
  std::vector<unsigned int> needed_points() const;

private:
  /// Add the values at hanging nodes to their masters, then set the values at hanging nodes to
  /// zero.
  void distribute_hanging(Field &field) const;
  void measure();
  void find_border();
  void keep_to_planes();

  const mesh::BodyMesh<dim>                         &body_mesh;
  std::vector<std::pair<unsigned int, unsigned int>> places; ///< body, boundary
  std::vector<unsigned int>                          own_boundaries;
  mesh::Surface<dim>                                 nodes;
  Field                                              unit_normals, surface_normals;
  std::vector<double>                                node_areas;
  std::vector<bool>                                  on_border;
};

/// Return (body, boundary) of the parts of the entry Face, "body.boundary + ...". All parts are
/// boundaries of one body. @throws InputError
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> find_faces(const mesh::BodyMesh<dim> &mesh,
                                                              const BodyNames           &bodies,
                                                              const ShapeParameters &parameters);

/// Return the unit vector of the entry Direction at the points of the face, or the normals if the
/// entry is empty. @throws InputError
template <int dim>
typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &face,
                                                const ShapeParameters &parameters);
} // namespace snug::shape

#endif
