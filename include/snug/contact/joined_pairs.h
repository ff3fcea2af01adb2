#ifndef snug_contact_joined_pairs_h
#define snug_contact_joined_pairs_h

#include <snug/contact/pair_geometry.h>
#include <snug/contact/row_group.h>

#include <map>

namespace snug::contact {
/// Boundaries of a body that share nodes belong to one surface if their nodal normals at one of the
/// shared nodes differ by less than this angle [degrees].
constexpr double smooth_meeting = 30.;

/**
 * Pairs of the scene that form one contact. Their slave sides are the same boundaries, or share
 * nodes and meet smoothly (smooth_meeting). Their masters are the same obstacle or belong to one
 * smooth surface. The contact rows are those of the union of the sides, as if all boundaries of a
 * side had one name. Where the entries of the pairs differ, the union has all of their rows
 * (joined_parameters()), and gaps and friction are those of each pair (NamedPair::parameters).
 */
struct JoinedPair
{
  /// Boundaries that a pair of the scene brings together.
  struct Part
  {
    Boundary     slave, master; ///< master is {} for an obstacle
    unsigned int pair;          ///< index of the pair of the scene
  };

  Pair              pair; ///< the union of the sides
  std::vector<Part> parts;
  /// Smooth surfaces of the sides, each given by its first boundary; {} for an obstacle.
  Boundary slave_surface, master_surface;

  /// Return the pair of the scene that names both boundaries. If no pair names both, return the
  /// first pair that names @p slave, else the first that names @p master.
  unsigned int pair_of(const Boundary &slave, const Boundary &master) const;
  void         swap_slave_master();
};

/// Return the parameters of the union of two pairs: mortar rows if one of them has these, the fixed
/// slave side if one has it, the larger search distance and angle, and friction if one has it.
PairParameters joined_parameters(const PairParameters &a, const PairParameters &b);

/// Join the pairs of a scene at the given positions. A side with several boundaries stands for all
/// pairs of one boundary of each side. The sides of a pair whose slave is not chosen yet
/// (Slave::finer) are exchanged if the pair can be joined with an earlier pair only in this way.
/// @throws TangledMesh if faces have no normal, InputError if two pairs with different entries
/// bring together the same boundaries.
template <int dim>
std::vector<JoinedPair> join_pairs(const mesh::Surface<dim>                 &surface,
                                   const faces::FaceShape<dim>              &shape,
                                   std::vector<Pair>                         pairs,
                                   const typename mesh::Surface<dim>::Field &positions);

/// Shares of pairs of the scene, by the index of the pair. The shares sum to 1.
using PairShares = std::map<unsigned int, double>;

/// Return the shares of the pairs of the scene in each row of @p group. The share of a pair is the
/// part of the row's tributary area on the slave boundary of the pair and opposite to the master
/// boundary of the pair. Collective where a slave boundary has several masters.
template <int dim>
std::vector<PairShares>
row_shares(const JoinedPair &joined, const PairGeometry<dim> &geometry, const RowGroup<dim> &group);
} // namespace snug::contact

#endif
