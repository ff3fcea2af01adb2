#ifndef snug_state_contact_patches_h
#define snug_state_contact_patches_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// Nodes of one slave side that carry force and are connected over its faces.
struct ContactPatch
{
  unsigned int              pair;
  std::vector<unsigned int> rows;
  /// Minimum width in faces: the extent of the nodes along the axis of minimum extent within the
  /// face, plus half a face at each end. The extent is doubled where the nodes reach a symmetry
  /// plane or another support, because the contact continues beyond it. The width is infinite where
  /// all of the side is in contact.
  double width = 0.;
  /// true if the patch carries less than light_patch of the force of its pair
  bool is_light = false;
};

/// Maximum part of the force of a pair in a light patch. Single nodes at edges and in rough gaps
/// may be light patches.
constexpr double light_patch = 0.05;

/// Return the patches of all pairs, in the order of their first rows. The result is the same on all
/// ranks. Collective.
template <int dim>
std::vector<ContactPatch> contact_patches(const StateSolver<dim>  &solver,
                                          const ContactState<dim> &state);
} // namespace snug::state

#endif
