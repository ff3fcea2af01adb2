#ifndef snug_io_profile_h
#define snug_io_profile_h

#include <snug/mesh/surface.h>

#include <functional>
#include <string>

namespace snug::io {
/// Function that returns the name "body.boundary" of a boundary of a body.
using FaceName = std::function<std::string(unsigned int body, unsigned int boundary)>;

/**
 * Return the profile of shaped faces as CSV, for grinding and measuring. Each connected piece of a
 * boundary has one row per node, in 2D along the piece with the body on its left, in 3D in the
 * order of the nodes. Positions are those of the mesh without a load [length].
 *
 * | column                 | meaning                                                              |
 * |------------------------|----------------------------------------------------------------------|
 * | face, piece            | name of the boundary, number of the piece                            |
 * | arc_length             | 2D: length of the polyline in the reference geometry                 |
 * | x, y, z                | position in the design                                               |
 * | dx, dy, dz             | displacement from the reference geometry                             |
 * | normal_x, _y, _z       | unit outward normal n in the reference geometry                      |
 * | move                   | displacement along n                                                 |
 * | reference_drop, drop   | max_j m.x_j - m.x along the mean normal m of the piece: the depth    |
 * |                        | below the highest point of the piece. Empty for pieces that surround |
 * |                        | the body or a bore, whose normals cancel.                            |
 *
 * @p positions are those of the nodes or points of @p surface in the design. @throws TangledMesh if
 * a face has no area.
 */
template <int dim>
std::string profile_text(const mesh::Surface<dim>                 &surface,
                         const typename mesh::Surface<dim>::Field &positions,
                         unsigned int                              degree,
                         const FaceName                           &name);
} // namespace snug::io

#endif
