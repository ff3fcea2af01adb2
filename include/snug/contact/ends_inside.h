#ifndef snug_contact_ends_inside_h
#define snug_contact_ends_inside_h

#include <snug/contact/pair_geometry.h>

namespace snug::contact {
/**
 * Return whether the slave side of a pair of bodies ends inside the master side where both may
 * touch: a node of its outer edges is projected to the inside of the master side, and the gap
 * there, with the formula of the pair, exceeds the minimum gap of all slave nodes by at most a
 * tenth of the mean face size of the side.
 */
template <int dim>
bool ends_inside(const PairGeometry<dim> &pair);
} // namespace snug::contact

#endif
