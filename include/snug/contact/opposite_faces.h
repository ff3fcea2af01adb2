#ifndef snug_contact_opposite_faces_h
#define snug_contact_opposite_faces_h

#include <snug/contact/pair_geometry.h>
#include <snug/mortar/segment_points.h>

namespace snug::contact {
/**
 * A slave face widened by this part of its size on all sides decides which
 * master faces it is paired with: so far may they slide on each other
 * before a part of it has no partner.
 */
constexpr double pairing_margin = 0.1;

/// Faces are projected onto each other up to this angle [degrees].
constexpr double steepest_angle = 60.;

/**
 * For each slave face the master faces, ascending, that lie opposite to it:
 * their normals at the centres are opposite up to the pair's largest angle
 * (and steepest_angle), they overlap along the slave's normal, and their
 * distance is at most 1.5 times that of the closest master face plus the
 * slave face's diameter, so that nothing behind it is taken.
 */
template <int dim>
std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<dim> &pair);
} // namespace snug::contact

#endif
