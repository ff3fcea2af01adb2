#ifndef snug_io_profile_h
#define snug_io_profile_h

#include <snug/io/surface_pieces.h>
#include <snug/state/symmetry_planes.h>

#include <array>
#include <functional>
#include <string>

namespace snug::io {
/// Function that returns the name "body.boundary" of a boundary of a body.
using FaceName = std::function<std::string(unsigned int body, unsigned int boundary)>;

/// Function that returns the number of a node of the surface in mesh files.
using NodeNumber = std::function<unsigned int(unsigned int surface_node)>;

/// Function that returns numbers by which the nodes of a piece are sorted.
using PlaceOfNode =
  std::function<std::array<unsigned int, 2>(const SurfacePiece &piece, unsigned int surface_node)>;

/// The names and the planes of symmetry that a profile needs beside a surface.
template <int dim>
struct ProfileModel
{
  FaceName                               name;
  NodeNumber                             node_number;
  std::vector<state::SymmetryPlane<dim>> planes = {};
  PlaceOfNode                            place  = {}; ///< used in 3D; empty: no sorting
};

/// Return the unit mean normal of a piece and of its mirror images, or zero if the normals cancel.
/// @p degree is that of the mesh.
template <int dim>
dealii::Tensor<1, dim> mean_normal(const mesh::Surface<dim>                     &surface,
                                   const SurfacePiece                           &piece,
                                   unsigned int                                  degree,
                                   const std::vector<state::SymmetryPlane<dim>> &planes);

/**
 * Return the profile of shaped faces as CSV, for grinding and measuring. Each connected piece of a
 * boundary has one row per node, in 2D along the piece with the body on its left, in 3D in the
 * order of ProfileModel::place. Positions are those of the mesh without a load [length]. Numbers
 * have 9 digits, and numbers below 1e-12 of the size of the piece are 0.
 *
 * | column                 | meaning                                                              |
 * |------------------------|----------------------------------------------------------------------|
 * | face, piece            | name of the boundary, number of the piece                            |
 * | node                   | number of the node in bodies.msh and bodies.inp                      |
 * | arc_length             | 2D: length of the polyline in the reference geometry                 |
 * | reference_x, _y, _z    | position in the reference geometry                                   |
 * | x, y, z                | position in the design                                               |
 * | normal_x, _y, _z       | unit outward normal n in the reference geometry                      |
 * | move                   | displacement from the reference geometry along n                     |
 * | reference_drop, drop   | max_x m.x - m.x along the mean normal m of the piece: the depth      |
 * |                        | below the highest point of its true surface. The planes of symmetry  |
 * |                        | that meet the piece contain m, as that of the whole face. Empty for  |
 * |                        | pieces that, with their mirror images, surround the body or a bore,  |
 * |                        | whose normals cancel.                                                |
 * | deviation              | maximum distance of the mesh faces at the node from the true surface |
 * |                        | of the design                                                        |
 *
 * @p positions are those of the nodes or points of @p surface in the design. @throws TangledMesh if
 * a face has no area.
 */
template <int dim>
std::string profile_text(const mesh::Surface<dim>                 &surface,
                         const typename mesh::Surface<dim>::Field &positions,
                         unsigned int                              degree,
                         const ProfileModel<dim>                  &model);
} // namespace snug::io

#endif
