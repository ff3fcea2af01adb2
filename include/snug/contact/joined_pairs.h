#ifndef snug_contact_joined_pairs_h
#define snug_contact_joined_pairs_h

#include <snug/contact/pair_geometry.h>
#include <snug/contact/row_group.h>

#include <map>

namespace snug::contact {
/// Boundaries of a body that share nodes belong to one surface if their nodal normals at one of
/// these differ by less than this angle [degrees].
constexpr double smooth_meeting = 30.;

/**
 * Pairs of the scene that are one contact: their slave sides are the same boundaries or share
 * nodes and meet smoothly (smooth_meeting), their masters are the same obstacle or belong to one
 * smooth surface, and their parameters are equal. The contact rows are those of the union of the
 * sides, as if all boundaries of a side had one name.
 */
struct JoinedPair
{
  /// Boundaries that a pair of the scene brings together.
  struct Part
  {
    Boundary     slave, master; ///< the master is {} where it is an obstacle
    unsigned int pair;          ///< index of the pair of the scene
  };

  Pair              pair; ///< the union of the sides
  std::vector<Part> parts;
  /// Smooth surfaces of the sides, as their first boundary; {}: an obstacle.
  Boundary slave_surface, master_surface;

  /// The pair of the scene that names both boundaries; where none does, the first one that names
  /// the slave's, else the master's.
  unsigned int pair_of(const Boundary &slave, const Boundary &master) const;
  void         exchange_sides();
};

/// Join the pairs of a scene at the given positions. Each side that has several boundaries stands
/// for all pairs of one boundary of each side. Pairs whose slave is not chosen yet (Slave::finer)
/// are exchanged where they can be joined so with an earlier one.
/// @throws TangledMesh if faces have no normal.
template <int dim>
std::vector<JoinedPair> join_pairs(const mesh::Surface<dim>                 &surface,
                                   const faces::FaceShape<dim>              &shape,
                                   std::vector<Pair>                         pairs,
                                   const typename mesh::Surface<dim>::Field &positions);

/// Shares of pairs of the scene by their index, which sum to 1.
using PairShares = std::map<unsigned int, double>;

/// Return the shares of the pairs of the scene in each row of @p group: the part of the row's
/// tributary area on their own slave boundary and opposite to their own master boundary.
/// Collective where a slave boundary has several masters.
template <int dim>
std::vector<PairShares>
row_shares(const JoinedPair &joined, const PairGeometry<dim> &geometry, const RowGroup<dim> &group);
} // namespace snug::contact

#endif
