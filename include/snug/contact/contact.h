#ifndef snug_contact_contact_h
#define snug_contact_contact_h

#include <snug/contact/joined_pairs.h>
#include <snug/contact/matching.h>
#include <snug/contact/placed_surface.h>
#include <snug/contact/point_gaps.h>
#include <snug/contact/row_group.h>
#include <snug/contact/tangent_row.h>
#include <snug/geometry/formula.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace snug::contact {
/// Place of a contact row: its pair, its slave node and its named pair.
struct RowPlace
{
  unsigned int pair;      ///< index into Contact::pairs()
  unsigned int slave;     ///< surface node of the slave side
  unsigned int named = 0; ///< index into Contact::named_pairs() of the pair with the largest share
};

/// A pair as the scene names it, with the rows that belong to it.
struct NamedPair
{
  Side                              slave, master;           ///< after the choice of the slave
  std::string                       slave_name, master_name; ///< after the choice of the slave
  std::optional<ObstacleParameters> obstacle;
  /// ascending row indices with shares: the parts of the force and of the area of each row that
  /// belong to this pair
  std::vector<std::pair<unsigned int, double>> rows;
  bool           master_is_first; ///< the scene names the master side first
  PairParameters parameters;      ///< entries of the scene

  /// Return "slave: master".
  std::string name() const { return slave_name + ": " + master_name; }
};

/// Law of the friction of a contact row, with its formulas evaluated at the slave node. Rows that
/// belong to several pairs have the mean of their laws, weighted by their shares.
struct RowFriction
{
  double coefficient = 0.; ///< of Coulomb: tangential over normal force
  double bound       = 0.; ///< of Tresca: tangential traction [force/length^2]

  /// Return whether there may be tangential forces.
  bool resists() const { return coefficient > 0. || bound > 0.; }
};

/// Place of a tangential row.
struct Tangent
{
  unsigned int row;   ///< index of the contact row
  unsigned int index; ///< of the direction in the row's frame, see tangent_direction()
  /// Supports hold the direction at the slave node and at the nodes opposite to it.
  bool is_held = false;
};

/// Contact of the slave node of a row with another obstacle.
struct OtherObstacle
{
  unsigned int row;                  ///< its contact row
  bool         shares_first_tangent; ///< the first tangent is along both obstacles, in 3D
};

/// Forces of all contact rows.
template <int dim>
struct ContactForces
{
  std::vector<double> normal;
  /// vectors in space at right angles to the normals of the rows, zero for rows without friction;
  /// empty: none
  std::vector<dealii::Tensor<1, dim>> tangential = {};
};

/// Gaps of a pair at its pairing, without the motion of an obstacle.
struct PairedGaps
{
  double least   = std::numeric_limits<double>::infinity();  ///< minimum; below 0: overlap [length]
  double largest = -std::numeric_limits<double>::infinity(); ///< maximum [length]
  /// maximum overlap over the size of the largest face at the slave node, of pairs without
  /// intended overlap
  double overlap = 0.;
};

/**
 * This class holds all contact rows of a scene in one position of the bodies. Positions,
 * velocities, displacements, held directions and coefficients of rows are in the frames of the
 * bodies, see PlacedSurface; normals of rows are in space. There is one group of rows per joined
 * pair (JoinedPair), in the order of pairs(). The gap formula of a pair of the scene, evaluated at
 * the slave nodes, is added to the gaps of its rows; rows that belong to several pairs have the
 * mean of their formulas, weighted by their shares. If several groups connect a slave node to the
 * same surface, the node has a row only in the group whose side faces that surface best. The
 * constructor and pair() pair nodes with faces, and the pairing is frozen between these calls. See
 * RowGroup for the meaning of the functions.
 */
template <int dim>
class Contact
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Pair at @p positions, where the supports hold the directions @p held. @p surface must outlive
  /// this object. @p position is where the bodies and obstacles are.
  /// @throws InputError naming a pair that is left without rows, or whose friction is negative or
  ///   not finite at a slave node. In a position other than that of the scene, a pair may have no
  ///   rows if another pair has some.
  Contact(const mesh::Surface<dim>         &surface,
          const std::vector<Pair>          &pairs,
          unsigned int                      degree,
          const Field                      &positions,
          const faces::HeldDirections<dim> &held,
          const Position<dim>              &position = {});

  /// Pair again at @p positions, with the slave sides that the constructor has chosen.
  /// @throws InputError like the constructor.
  void pair(const Field &positions, const faces::HeldDirections<dim> &held);

  /// Disable copying, because the groups refer to the member shape.
  Contact(const Contact &)            = delete;
  Contact &operator=(const Contact &) = delete;

  /// Return the joined pairs with the chosen methods and slave sides. The slave side comes first.
  const std::vector<Pair> &pairs() const { return chosen; }
  /// Return the joined pairs with the boundaries that each pair of the scene brings together.
  const std::vector<JoinedPair> &joined_pairs() const { return joined; }
  /// Return the pairs as the scene names them, in the order of the scene. The shares are those at
  /// the positions of the pairing.
  const std::vector<NamedPair> &named_pairs() const { return named; }
  /// Return the matching of each pair at its first pairing; an empty Matching for obstacles.
  const std::vector<Matching> &matchings() const { return matching_of; }
  unsigned int                 n_rows() const { return row_places.size(); }
  const std::vector<RowPlace> &places() const { return row_places; }
  /// Return the slave nodes without a row of their own, with the rows that act for them. Row
  /// indices count through all groups.
  const std::vector<DependentMultiplier> &dependent_multipliers() const { return shared; }

  std::vector<Row<dim>> rows(const Field &positions) const;
  std::vector<Row<dim>> row_derivatives(const Field &positions, const Field &velocity) const;
  /**
   * Return the contact part of the energy gradient for the forces of all rows,
   *   d/dX (sum_i p_i (sum_b c_ib . u_b - gap_i) + sum_i (sum_b C_ib(q_i) . u_b - gap_i(q_i))),
   * with the normal forces p_i and the tangential row C_i, gap_i along the tangential force q_i.
   * The tangential forces follow the normals without a spin, q' = -(n' . q) n.
   */
  Field energy_gradient(const Field              &positions,
                        const Field              &displacement,
                        const ContactForces<dim> &forces) const;
  /// Return the energy gradient at fixed @p displacement without the gaps.
  Field               coefficient_gradient(const Field              &positions,
                                           const Field              &displacement,
                                           const ContactForces<dim> &forces) const;
  std::vector<double> areas(const Field &positions) const;
  std::vector<double> area_derivatives(const Field &positions, const Field &velocity) const;
  /// Return d/dX sum_i factors_i areas_i for the factors of all rows.
  Field area_gradient(const Field &positions, const std::vector<double> &factors) const;

  /// @name Friction
  /// @{
  /// Return the law of the friction of contact row @p i. Its numbers are those of the slave node's
  /// reference position at the contact search. They belong to the material, so that they do not
  /// depend on the positions.
  const RowFriction &friction(unsigned int i) const { return frictions[i]; }
  /// Return the places of all tangential rows, ascending by contact row. A row with friction has
  /// tangential rows, up to dim - 1, in the directions in which the supports let the slave node or
  /// the face opposite to it move; none at a node of three obstacles. Against an obstacle, a
  /// tangential row must also be independent of the normal row where the supports let the slave
  /// node move.
  const std::vector<Tangent> &tangents() const { return tangent_places; }
  /// Return the contact of the slave node of row @p i with another obstacle; none for bodies.
  const std::optional<OtherObstacle> &other_obstacle(unsigned int i) const { return others[i]; }
  /// Return whether there are tangential rows.
  bool has_friction() const { return !tangent_places.empty(); }
  /// Return the directions in space of the tangential rows, from the rows() at any positions.
  std::vector<dealii::Tensor<1, dim>> tangent_directions(const std::vector<Row<dim>> &rows) const;
  /// Return the forces of all contact rows and then all tangential rows as vectors, from the rows()
  /// at the same positions.
  ContactForces<dim> forces(const std::vector<Row<dim>> &rows,
                            const std::vector<double>   &of_rows) const;
  /// Return the tangential rows, see tangent_row(), from the rows() at the same positions.
  std::vector<Row<dim>> tangent_rows(const Field                 &positions,
                                     const std::vector<Row<dim>> &rows) const;
  /// Return the exact derivatives of the tangential rows along @p velocity from the rows() and
  /// row_derivatives() at the same positions. The tangents follow the normals without a spin, t' =
  /// -(n' . t) n, which is another derivative than that of the frame of tangent_rows().
  std::vector<Row<dim>> tangent_row_derivatives(const Field                 &positions,
                                                const Field                 &velocity,
                                                const std::vector<Row<dim>> &rows,
                                                const std::vector<Row<dim>> &derivatives) const;
  /// @}

  /// Return the motions of bodies and obstacles to their places.
  const Position<dim> &placement() const { return position; }

  /// Return the surface in space, with the transformations to space.
  const PlacedSurface<dim> &placed_surface() const { return placed; }

  /// Return the gaps of pair @p p at points between its rows. @p positions and @p held are in
  /// space, like the points and normals of the result, which the arguments must outlive.
  std::unique_ptr<PointGaps<dim>>
  point_gaps(unsigned int p, const Field &positions, const faces::HeldDirections<dim> &held) const;

  /// Return the gaps of each joined pair at the contact search.
  const std::vector<PairedGaps> &paired_gaps() const { return gaps; }

  /// @name Motions along the master that the rows do not constrain, as fractions of the size of the
  /// slave node's largest face
  /// @{
  /// Return the displacement of the slave nodes along the master, at right angles to the normals,
  /// for @p rows at @p positions.
  std::vector<double> tangential_slips(const Field                 &positions,
                                       const std::vector<Row<dim>> &rows,
                                       const Field                 &displacement) const;
  /// Return how far the slave nodes have moved along the master off the points they were paired
  /// with. The foot points of nodal rows follow the nodes within their faces, so only the distance
  /// off the face counts for these rows. Mortar rows integrate over the master faces found by the
  /// contact search, and their value is the motion along these faces. For obstacles the value is 0,
  /// because the closest point follows the node.
  std::vector<double> pairing_drifts(const Field                 &positions,
                                     const std::vector<Row<dim>> &rows) const;
  /// @}

private:
  struct Group
  {
    std::unique_ptr<RowGroup<dim>> rows;
    double step; ///< step of the difference quotients of gap formulas [length]
  };

  /// Named pairs with shares of a row.
  using Shares = std::vector<std::pair<unsigned int, double>>;

  const PlacedSurface<dim>    placed;
  const mesh::Surface<dim>   &surface; ///< in space
  const Position<dim>         position;
  const faces::FaceShape<dim> shape;
  std::vector<JoinedPair>     joined;
  std::vector<Pair>           chosen; ///< the pairs of joined
  std::vector<NamedPair>      named;
  std::vector<Matching>       matching_of; ///< one per pair
  std::vector<Group>          groups;      ///< one per pair
  std::vector<RowPlace>       row_places;
  /// one per named pair; nullptr: no formula
  std::vector<std::shared_ptr<const geometry::Formula<dim>>> gap_formulas;
  std::vector<Shares>              gap_shares; ///< one per row; empty: no formula
  std::vector<DependentMultiplier> shared;
  std::vector<Row<dim>>            paired_rows;    ///< of mortar pairs, at the pairing; else empty
  Field                            paired_offsets; ///< one per row, at the pairing
  std::vector<PairedGaps>          gaps;           ///< one per pair, at the pairing
  /// nodes of each row, in the order of the coefficients
  std::vector<std::vector<unsigned int>>    row_nodes;
  std::vector<RowFriction>                  frictions; ///< one per row
  std::vector<TangentFrame<dim>>            frames;    ///< one per row; used if it has friction
  std::vector<std::optional<OtherObstacle>> others;    ///< one per row
  std::vector<Tangent>                      tangent_places;

  PairGeometry<dim>      geometry(unsigned int                      p,
                                  const Field                      &positions,
                                  const faces::HeldDirections<dim> &held,
                                  std::vector<bool>                 taken = {}) const;
  dealii::Tensor<1, dim> slave_minus_master(const Row<dim> &row, const Field &in_space) const;

  void choose_slaves(const Field &positions, const faces::HeldDirections<dim> &held);
  void make_groups(const Field &positions, const faces::HeldDirections<dim> &held);
  void number_rows(const Field &positions, const faces::HeldDirections<dim> &held);
  std::vector<std::vector<bool>> contested_nodes(const Field &positions) const;
  void                           check_named_pairs(const Field &positions) const;
  void share_rows(const Field &positions, const faces::HeldDirections<dim> &held);
  void collect_dependent_multipliers();
  void measure_pairing(const Field &positions, const std::vector<Row<dim>> &paired);
  void make_frictions();
  void make_tangents(const Field                      &positions,
                     const faces::HeldDirections<dim> &held,
                     const std::vector<Row<dim>>      &paired);
  void add_tangential_slopes(const Field                               &positions,
                             const Field                               &moved,
                             const std::vector<dealii::Tensor<1, dim>> &forces,
                             std::vector<RowSlopes<dim>>               &slopes,
                             Field                                     &gradient) const;
  std::vector<RowSlopes<dim>> energy_slopes(const Field               &moved,
                                            const std::vector<double> &forces) const;
  Group                       make_group(const PairGeometry<dim> &geometry) const;
  /// Return the named pairs of each row with their shares. Pairs with equal entries, by their
  /// @p key, count as one pair. If all are equal, the share is exactly 1.
  template <typename Key>
  std::vector<Shares> shares_of_rows(const Key &key) const
  {
    std::vector<Shares> result(n_rows());
    for (unsigned int pair = 0; pair < named.size(); ++pair)
      for (const auto &[row, share] : named[pair].rows)
        {
          auto      &shares   = result[row];
          const auto is_equal = [&](const auto &of) {
            return key(named[of.first].parameters) == key(named[pair].parameters);
          };
          const auto equal = std::find_if(shares.begin(), shares.end(), is_equal);
          if (equal == shares.end())
            shares.emplace_back(pair, share);
          else
            equal->second += share;
        }
    for (Shares &shares : result)
      if (shares.size() == 1)
        shares.front().second = 1.;
    return result;
  }
  double                 gap_offset(unsigned int row, const Field &positions) const;
  dealii::Tensor<1, dim> gap_offset_gradient(unsigned int row, const Field &positions) const;
};
} // namespace snug::contact

#endif
