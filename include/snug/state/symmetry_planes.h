#ifndef snug_state_symmetry_planes_h
#define snug_state_symmetry_planes_h

#include <snug/contact/pair.h>
#include <snug/mesh/body_mesh.h>
#include <snug/supports/support.h>

namespace snug::state {
/// A plane of symmetry of a body, in the reference geometry.
template <int dim>
struct SymmetryPlane
{
  unsigned int           body;
  dealii::Tensor<1, dim> normal; ///< unit normal
  dealii::Point<dim>     point;
};

/**
 * Return the planes of symmetry of all bodies: plane boundaries that are held along their normal
 * alone, at a displacement of zero, and the axis of an axisymmetric model. Collective.
 */
template <int dim>
std::vector<SymmetryPlane<dim>>
symmetry_planes(const mesh::BodyMesh<dim>                 &mesh,
                const std::vector<supports::Support<dim>> &supports);

/**
 * Return one line for each contact side on a sphere, a cylinder or another known surface that does
 * not meet a plane of symmetry at a right angle. A plane of symmetry is a plane boundary held along
 * its normal alone, at a displacement of zero, unless an opposite boundary is such a plane as well.
 * The axis of an axisymmetric model is also a plane of symmetry. Collective.
 */
template <int dim>
std::vector<std::string> symmetry_warnings(const mesh::BodyMesh<dim>                 &mesh,
                                           const std::vector<supports::Support<dim>> &supports,
                                           const std::vector<contact::Pair>          &pairs);
} // namespace snug::state

#endif
