#ifndef snug_contact_contact_h
#define snug_contact_contact_h

#include <snug/contact/matching.h>
#include <snug/contact/point_gaps.h>
#include <snug/contact/row_group.h>
#include <snug/geometry/formula.h>

#include <limits>

namespace snug::contact {
/// Where a row stands.
struct RowPlace
{
  unsigned int pair;
  unsigned int slave; ///< surface node
};

/// The gaps of a pair, without the motion of an obstacle.
struct PairedGaps
{
  double least   = std::numeric_limits<double>::infinity();  ///< below 0: an overlap [length]
  double largest = -std::numeric_limits<double>::infinity(); ///< [length]
  double overlap = 0.; ///< the deepest as a part of the slave node's largest face
};

/**
 * All contact rows of a scene: one group per pair, in the order of the
 * pairs, with the pair's gap formula at the slave nodes added to the gaps
 * of the group. Pairing, of nodes with faces, is done by the constructor
 * and pair() and frozen in between; see RowGroup for the meaning of the
 * functions.
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

  /// The pairs with their slaves chosen, which come first, and their methods.
  const std::vector<Pair> &pairs() const { return chosen; }
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
  std::vector<Pair>           chosen;
  std::vector<Matching>       matching_of; ///< each pair
  std::vector<Group>          groups;      ///< one per pair
  std::vector<RowPlace>       row_places;
  std::vector<SharedNode>     shared;
  Field                       paired_offsets; ///< of each row, when paired
  std::vector<PairedGaps>     gaps;           ///< of each pair, when paired

  void  collect_shared_nodes();
  void  measure_pairing(const Field &positions);
  Group make_group(const PairGeometry<dim> &geometry) const;
};
} // namespace snug::contact

#endif
