#ifndef snug_state_contact_patches_h
#define snug_state_contact_patches_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Nodes of one slave side that carry force and hang together over its faces.
struct ContactPatch
{
  unsigned int              pair;
  std::vector<unsigned int> rows;
  /// across, where it is narrowest, in faces: the extent of the nodes along the axis of least
  /// extent within the face, and half a face at each end. Where they reach a symmetry plane or
  /// another support, as much lies beyond it. Infinite where all of the side is in contact.
  double width = 0.;
  /// carries less than light_patch of the force of its pair
  bool is_light = false;
};

/// As single nodes at edges and in rough gaps may.
constexpr double light_patch = 0.05;

/// Of all pairs, in the order of their first rows; the same on all ranks. Collective.
template <int dim>
std::vector<ContactPatch> contact_patches(const StateSolver<dim>  &solver,
                                          const ContactState<dim> &state);
} // namespace snug::state

#endif
