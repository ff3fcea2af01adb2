#ifndef snug_mortar_face_arrays_h
#define snug_mortar_face_arrays_h

#include <snug/mesh/surface.h>
#include <snug/mortar/segment_points.h>

namespace snug::mortar {
/// Positions of all surface nodes.
template <int dim>
FaceNodes<dim, double> node_arrays(const typename mesh::Surface<dim>::Field &positions);

/// The same, differentiated along @p velocity.
template <int dim>
FaceNodes<dim, faces::Differential<1>>
node_arrays(const typename mesh::Surface<dim>::Field &positions,
            const typename mesh::Surface<dim>::Field &velocity);

/// Those of the nodes of surface face @p face.
template <int dim, typename Number>
FaceNodes<dim, Number> face_nodes(const mesh::Surface<dim>     &surface,
                                  unsigned int                  face,
                                  const FaceNodes<dim, Number> &nodes);
} // namespace snug::mortar

#endif
