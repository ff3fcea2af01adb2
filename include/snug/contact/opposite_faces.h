#ifndef snug_contact_opposite_faces_h
#define snug_contact_opposite_faces_h

#include <snug/contact/mortar_normals.h>
#include <snug/mortar/segment_points.h>

namespace snug::contact {
/**
 * A slave face is widened by this fraction of its size on all sides before the search for opposite
 * master faces. The two sides may slide on each other by this distance before a part of the slave
 * face has no partner.
 */
constexpr double pairing_margin = 0.1;

/// Maximum angle between faces that are projected onto each other [degrees].
constexpr double steepest_angle = 60.;

/**
 * Return, for each slave face, the opposite master faces in ascending order. Faces are opposite
 * under three conditions. Their normals at the centres are opposite up to the pair's largest angle
 * (and steepest_angle). The faces overlap along the slave's normal, or along the mean of @p normals
 * at its nodes if these are means. Their distance is at most 1.5 times that of the closest master
 * face plus the slave face's diameter, which excludes faces behind the closest one.
 */
template <int dim>
std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<dim>  &pair,
                                                      const MortarNormals<dim> &normals);
} // namespace snug::contact

#endif
