#ifndef snug_shape_shaped_face_h
#define snug_shape_shaped_face_h

#include <snug/mesh/surface.h>
#include <snug/shape/shape_parameters.h>

namespace snug::shape {
/**
 * The face of a body that is shaped, in its reference geometry and on all
 * ranks alike: nodes, normals, tributary areas and rim.
 */
template <int dim>
class ShapedFace
{
public:
  using Field = typename mesh::Surface<dim>::Field; ///< per surface node or point

  /// Collective. @throws InputError naming the entry Face. The mesh must
  /// outlive this object.
  ShapedFace(const mesh::BodyMesh<dim> &mesh,
             const BodyNames           &bodies,
             const ShapeParameters     &parameters);

  const mesh::BodyMesh<dim> &mesh() const { return body_mesh; }
  unsigned int               body() const { return place.first; }
  unsigned int               boundary() const { return place.second; }
  const mesh::Surface<dim>  &surface() const { return nodes; }

  /// Reference positions of the surface points [length].
  const Field &positions() const { return nodes.reference_positions(); }
  /// Unit outward normals at the surface points. Where the face meets a
  /// plane boundary of the body that they leave by less than 25 degrees,
  /// they lie in that plane, so that shapes stay in symmetry planes.
  const Field &normals() const { return unit_normals; }
  /// The face's area spread over its nodes, hanging ones and samples have
  /// none [length^(dim-1)].
  const std::vector<double> &areas() const { return node_areas; }
  /// Nodes that other boundaries of the body share.
  const std::vector<bool> &border() const { return on_border; }

  bool is_hanging(unsigned int surface_node) const { return !nodes.masters(surface_node).empty(); }
  /// values at hanging nodes <- interpolation of their masters
  void interpolate_hanging(Field &field) const;
  /// Transpose: add values at hanging nodes to their masters, then zero.
  void distribute_hanging(Field &field) const;

private:
  void measure();
  void find_border();
  void keep_to_planes();

  const mesh::BodyMesh<dim>            &body_mesh;
  std::pair<unsigned int, unsigned int> place; ///< body, boundary
  mesh::Surface<dim>                    nodes;
  Field                                 unit_normals;
  std::vector<double>                   node_areas;
  std::vector<bool>                     on_border;
};

/// (body, boundary) of "body.boundary", the entry Face. @throws InputError
template <int dim>
std::pair<unsigned int, unsigned int> find_face(const mesh::BodyMesh<dim> &mesh,
                                                const BodyNames           &bodies,
                                                const ShapeParameters     &parameters);

/// Unit vectors of the entry Direction, or the normals, at the face's
/// nodes. @throws InputError
template <int dim>
typename ShapedFace<dim>::Field face_directions(const ShapedFace<dim> &face,
                                                const ShapeParameters &parameters);
} // namespace snug::shape

#endif
