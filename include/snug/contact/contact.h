#ifndef snug_contact_contact_h
#define snug_contact_contact_h

#include <snug/contact/joined_pairs.h>
#include <snug/contact/matching.h>
#include <snug/contact/point_gaps.h>
#include <snug/contact/row_group.h>
#include <snug/geometry/formula.h>

#include <limits>

namespace snug::contact {
/// Where a row stands.
struct RowPlace
{
  unsigned int pair;      ///< of Contact::pairs()
  unsigned int slave;     ///< surface node
  unsigned int named = 0; ///< of Contact::named_pairs(), the one with the largest share
};

/// A pair as the scene names it, and the rows that count as its own.
struct NamedPair
{
  std::string                       slave_name, master_name; ///< after the choice of the slave
  std::optional<ObstacleParameters> obstacle;
  /// ascending rows and their shares: parts of the force and of the area that belong to this pair
  std::vector<std::pair<unsigned int, double>> rows;

  /// "slave: master"
  std::string name() const { return slave_name + ": " + master_name; }
};

/// The gaps of a pair, without the motion of an obstacle.
struct PairedGaps
{
  double least   = std::numeric_limits<double>::infinity();  ///< below 0: an overlap [length]
  double largest = -std::numeric_limits<double>::infinity(); ///< [length]
  double overlap = 0.; ///< the deepest as a part of the slave node's largest face
};

/**
 * All contact rows of a scene: one group per joined pair (JoinedPair), in
 * the order of pairs(), with the pair's gap formula at the slave nodes added
 * to the gaps of the group. A slave node that touches the same surface by
 * several groups has a row in the group whose side faces that surface best.
 * Pairing, of nodes with faces, is done by the constructor and pair() and
 * frozen in between; see RowGroup for the meaning of the functions.
 */
template <int dim>
class Contact
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Pair at @p positions, where supports hold @p held. @p surface must
  /// outlive this object.
  /// @throws InputError naming a pair that is left without rows.
  Contact(const mesh::Surface<dim>         &surface,
          const std::vector<Pair>          &pairs,
          unsigned int                      degree,
          const Field                      &positions,
          const faces::HeldDirections<dim> &held);

  /// Pair anew at @p positions, with the slaves chosen before.
  /// @throws InputError as the constructor does.
  void pair(const Field &positions, const faces::HeldDirections<dim> &held);

  /// Groups refer to the shape.
  Contact(const Contact &)            = delete;
  Contact &operator=(const Contact &) = delete;

  /// The joined pairs with their slaves chosen, which come first, and their methods.
  const std::vector<Pair> &pairs() const { return chosen; }
  /// The same with the boundaries that each pair of the scene brings together.
  const std::vector<JoinedPair> &joined_pairs() const { return joined; }
  /// The pairs as the scene names them, in its order. Shares are those where contact was paired.
  const std::vector<NamedPair> &named_pairs() const { return named; }
  /// Of each pair when it was first paired; nothing of obstacles.
  const std::vector<Matching> &matchings() const { return matching_of; }
  unsigned int                 n_rows() const { return row_places.size(); }
  const std::vector<RowPlace> &places() const { return row_places; }
  /// Of all groups; rows count through.
  const std::vector<SharedNode> &shared_nodes() const { return shared; }

  std::vector<Row<dim>> rows(const Field &positions) const;
  std::vector<Row<dim>> row_derivatives(const Field &positions, const Field &velocity) const;
  /// Contact part of the energy gradient for forces of all rows.
  Field               energy_gradient(const Field               &positions,
                                      const Field               &displacement,
                                      const std::vector<double> &forces) const;
  std::vector<double> areas(const Field &positions) const;
  /// d/dX sum_i factors_i areas_i for factors of all rows.
  Field area_gradient(const Field &positions, const std::vector<double> &factors) const;

  /// The gaps of pair @p p between its rows. The arguments must outlive it.
  std::unique_ptr<PointGaps<dim>>
  point_gaps(unsigned int p, const Field &positions, const faces::HeldDirections<dim> &held) const;

  /// @name What the rows do not see, as parts of the slave node's largest
  /// face
  /// @{
  /// Displacement of the slave nodes along the master, at right angles to
  /// the normals, for @p rows at @p positions.
  std::vector<double>
  slips(const Field &positions, const std::vector<Row<dim>> &rows, const Field &displacement) const;
  /// How far slave nodes have moved along the master off the points they
  /// were paired with. Feet of nodal rows follow within their faces: of them
  /// only the way off the face counts. 0 for obstacles, whose points follow.
  std::vector<double> drifts(const Field &positions, const std::vector<Row<dim>> &rows) const;
  /// Of each pair where it was paired.
  const std::vector<PairedGaps> &paired_gaps() const { return gaps; }
  /// @}

private:
  /// The rows of a pair and what is added to their gaps, if anything.
  struct Group
  {
    std::unique_ptr<RowGroup<dim>>          rows;
    std::unique_ptr<geometry::Formula<dim>> offset;
    double                                  step; ///< of its differences
  };

  const mesh::Surface<dim>   &surface;
  const faces::FaceShape<dim> shape;
  std::vector<JoinedPair>     joined;
  std::vector<Pair>           chosen; ///< those of joined
  std::vector<NamedPair>      named;
  std::vector<Matching>       matching_of; ///< each pair
  std::vector<Group>          groups;      ///< one per pair
  std::vector<RowPlace>       row_places;
  std::vector<SharedNode>     shared;
  Field                       paired_offsets; ///< of each row, when paired
  std::vector<PairedGaps>     gaps;           ///< of each pair, when paired

  PairGeometry<dim> geometry(unsigned int                      p,
                             const Field                      &positions,
                             const faces::HeldDirections<dim> &held,
                             std::vector<bool>                 taken = {}) const;
  void              choose_slaves(const Field &positions, const faces::HeldDirections<dim> &held);
  void              make_groups(const Field &positions, const faces::HeldDirections<dim> &held);
  void              number_rows(const Field &positions, const faces::HeldDirections<dim> &held);
  std::vector<std::vector<bool>> contested_nodes(const Field &positions) const;
  void                           check_named_pairs() const;
  void  share_rows(const Field &positions, const faces::HeldDirections<dim> &held);
  void  collect_shared_nodes();
  void  measure_pairing(const Field &positions);
  Group make_group(const PairGeometry<dim> &geometry) const;
};
} // namespace snug::contact

#endif
