#ifndef snug_state_axis_checks_h
#define snug_state_axis_checks_h

#include <snug/state/body_boxes.h>

#include <string>
#include <vector>

namespace snug::state {
/// Check that bodies of an axisymmetric model do not reach negative radii. Collective.
/// @throws InputError on all ranks.
template <int dim>
void check_radii(const mesh::BodyMesh<dim> &mesh, const std::vector<std::string> &body_names);

/// Check that nodes on the axis stay there, because they are held there.
/// @throws TangledMesh, on this rank, if a design moves a node away from the axis.
template <int dim>
void check_axis(const mesh::BodyMesh<dim>                 &mesh,
                const typename mesh::BodyMesh<dim>::Field &positions,
                const std::vector<BodyBox<dim>>           &boxes);
} // namespace snug::state

#endif
