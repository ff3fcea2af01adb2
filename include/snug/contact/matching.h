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

/// A face of a pair is coarse if it is larger by more than this factor than the face opposite to
/// its centre. Above sqrt(2), so that of two faces each cannot become coarser than the other in
/// turns when the larger one is halved.
constexpr double coarser_by = 1.5;

/// The coarse faces of both sides of @p pair, which are surface indices, ascending; none where
/// there is an obstacle. Refined until there is none, the sides have faces of one size.
template <int dim>
std::vector<unsigned int> coarse_faces(const mesh::Surface<dim>                 &surface,
                                       const faces::FaceShape<dim>              &shape,
                                       const Pair                               &pair,
                                       const typename mesh::Surface<dim>::Field &positions);
} // namespace snug::contact

#endif
