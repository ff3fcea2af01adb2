#ifndef snug_contact_matching_h
#define snug_contact_matching_h

#include <snug/contact/pair_geometry.h>

namespace snug::contact {
/// How many slave nodes within the search distance lie opposite to a master
/// node, up to a part of the master face (matching_tolerance) and to how far
/// the normals of the two sides part over the gap, and of how many.
struct Matching
{
  unsigned int n_nodes = 0, n_matching = 0;
  double       finer = 1.; ///< size of the master's faces over that of the slave's

  bool complete() const { return n_matching == n_nodes; }
};

constexpr double matching_tolerance = 0.01;

/// Of a pair of two faces.
template <int dim>
Matching matching(const PairGeometry<dim> &pair);
} // namespace snug::contact

#endif
