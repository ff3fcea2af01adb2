#ifndef snug_contact_matching_h
#define snug_contact_matching_h

#include <snug/contact/pair_geometry.h>

namespace snug::contact {
/// Number of slave nodes within the search distance, and number of these nodes that lie opposite to
/// a master node. The tolerance is a fraction of the master face (matching_tolerance) plus the
/// offset that the angle between the normals of the two sides causes over the gap.
struct Matching
{
  unsigned int n_nodes = 0, n_matching = 0;
  double       finer = 1.; ///< size of the master's faces over that of the slave's faces

  bool complete() const { return n_matching == n_nodes; }
};

constexpr double matching_tolerance = 0.01;

/// Return the matching of a pair of two faces.
template <int dim>
Matching matching(const PairGeometry<dim> &pair);

/// Return where the sides of a pair without rows are, for messages: their distance, whether they
/// look away from each other, and their boxes.
template <int dim>
std::string places_of_sides(const mesh::Surface<dim>                 &surface,
                            const faces::FaceShape<dim>              &shape,
                            const Pair                               &pair,
                            const typename mesh::Surface<dim>::Field &positions);

/// A face of a pair is coarse if it is larger by more than this factor than the face opposite to
/// its centre. The factor is above sqrt(2), because otherwise halving the larger of two faces could
/// make the other face coarse, and the two faces would be refined in turns.
constexpr double coarser_by = 1.5;

/// Return the coarse faces of both sides of @p pair as ascending surface indices; none for an
/// obstacle. After refinement until no face is coarse, the sides have faces of one size.
template <int dim>
std::vector<unsigned int> coarse_faces(const mesh::Surface<dim>                 &surface,
                                       const faces::FaceShape<dim>              &shape,
                                       const Pair                               &pair,
                                       const typename mesh::Surface<dim>::Field &positions);
} // namespace snug::contact

#endif
