#ifndef snug_qp_free_rows_h
#define snug_qp_free_rows_h

#include <snug/qp/multi_vector.h>

#include <array>
#include <optional>
#include <vector>

namespace snug::qp {
/// One flag per row of the dual problem owned by this rank.
using RowSet = std::vector<unsigned char>;

/**
 * Friction cone of one contact, on the rows that this rank owns. The multipliers of the tangential
 * rows are limited by
 * @f[ |\lambda_T| \le b = \mu \max(\lambda_N, 0) + \beta @f]
 * while the contact is closed, and are zero while it is open. Coulomb friction has beta = 0,
 * Tresca friction has mu = 0.
 */
struct FrictionCone
{
  unsigned int                normal;           ///< owned row of lambda_N
  std::array<unsigned int, 2> tangents    = {}; ///< owned rows of lambda_T
  unsigned int                n_tangents  = 0;  ///< 1 or 2
  double                      coefficient = 0.; ///< mu
  double                      bound       = 0.; ///< beta [force]
  /// Owned row of lambda_N of another rigid obstacle at the same node. While both contacts are
  /// closed, they hold the node, and friction acts along both obstacles only.
  std::optional<unsigned int> other_normal = {};
  /// number of tangential rows along both obstacles, 0 or 1, which come first
  unsigned int n_along_both = 0;
  /// owned tangential row of the other contact along both obstacles, if that has friction
  std::optional<unsigned int> other_tangent = {};

  /// Return whether this contact and the other one at its node are closed on a set.
  bool is_cornered(const RowSet &rows) const
  {
    return other_normal && rows[normal] && rows[*other_normal];
  }
  /// Return this cone with the tangential rows in which friction acts for the multipliers @p
  /// lambda.
  FrictionCone acting(const MultiVector &lambda) const;
  /// Return how many tangential rows may be free on a set. The normal rows of two obstacles at a
  /// node and all tangential rows would depend on each other, as would the tangential rows of both
  /// contacts along both obstacles.
  unsigned int n_free_tangents(const RowSet &rows) const
  {
    if (!is_cornered(rows))
      return rows[normal] ? n_tangents : 0;
    return other_tangent && rows[*other_tangent] ? 0 : n_along_both;
  }

  /// Return b for the multipliers @p lambda; 0 where lambda_N is not positive.
  double limit(const MultiVector &lambda) const;
  /// Return the greater of the estimates F_ii of the tangential rows [displacement / force].
  double compliance(const std::vector<double> &diagonal) const;
  /// Return lambda_T + w_T / @p compliance for the slip w_T. The contact sticks if it lies within
  /// the cone.
  std::array<double, 2>
  trial_force(double compliance, const MultiVector &lambda, const MultiVector &w) const;
};

/// The places of objects in a list by the owned rows lambda_N of their contacts.
class PlaceOfRow
{
public:
  void insert(unsigned int row, unsigned int place)
  {
    if (row >= places.size())
      places.resize(row + 1, none);
    places[row] = place;
  }

  template <typename T>
  const T *find(unsigned int row, const std::vector<T> &list) const
  {
    return row < places.size() && places[row] != none ? &list[places[row]] : nullptr;
  }

private:
  static constexpr unsigned int none = -1;
  std::vector<unsigned int>     places;
};

/// The friction cones of the owned rows, ascending by their contacts and found by their normal
/// rows.
class FrictionCones
{
public:
  FrictionCones(std::vector<FrictionCone> cones = {});

  bool                                      empty() const { return cones.empty(); }
  std::size_t                               size() const { return cones.size(); }
  std::vector<FrictionCone>::const_iterator begin() const { return cones.begin(); }
  std::vector<FrictionCone>::const_iterator end() const { return cones.end(); }

  /// Return the cone of the contact with the owned row @p normal; nullptr without friction.
  const FrictionCone *find(unsigned int normal) const { return place.find(normal, cones); }

private:
  std::vector<FrictionCone> cones;
  PlaceOfRow                place;
};

/// Let all tangential rows be free that may be free, see FrictionCone::n_free_tangents().
void free_tangents(const FrictionCones &cones, RowSet &rows);

/// A closed contact that slips along the unit vector n^ of its tangential rows.
struct Slip
{
  FrictionCone          cone;
  std::array<double, 2> direction  = {}; ///< n^; with one tangent 1 or -1
  double                compliance = 0.; ///< D of FreeRows [displacement / force]

  /// Return the unit vector across n^, for two tangents.
  std::array<double, 2> across() const { return {{-direction[1], direction[0]}}; }
};

/**
 * This class describes the multipliers that are free to change in a linear problem of the dual:
 * the flagged rows, and contacts that slip. Friction forces of slipping contacts are eliminated.
 * With the values y of the other free multipliers,
 * @f[ \lambda = Z y + \beta\text{-part}, \qquad
 *     Z = Z_0 + \mu \hat n \text{ in the tangential rows of the column of } \lambda_N, @f]
 * where the columns of Z_0 are unit vectors of flagged rows and, for slipping contacts with two
 * tangential rows, the direction across n^. Their equations are
 * @f[ Z_0^T (d - F \lambda + G^T \alpha) = D y, @f]
 * where D is zero except across n^, where D = |s| / b: a force across n^ turns the slip s.
 * Derivatives by the adjoint method need the transposed system, in which Z_0 and Z change places.
 *
 * The values y are stored as vectors with all owned rows, Z_0 y.
 */
class FreeRows
{
public:
  /// The rows of slipping contacts: the normal row is flagged, tangential rows are not.
  FreeRows(RowSet rows = {}, std::vector<Slip> slips = {}, bool transposed = false);

  const RowSet            &rows() const { return flags; }
  const std::vector<Slip> &slips() const { return slipping; }
  /// Return the slip of the contact with the owned row @p normal; nullptr if it does not slip.
  const Slip *slip(unsigned int normal) const { return place.find(normal, slipping); }
  bool        is_transposed() const { return transposed; }

  /// Return the same free rows with Z_0 and Z exchanged.
  FreeRows transpose() const { return {flags, slipping, !transposed}; }

  /// Set x <- Z_0 Z_0' x.
  void restrict(MultiVector &x) const;

  /// Set y <- Z y for y = Z_0 Z_0' y; in the transposed system y does not change.
  void expand(MultiVector &y) const;

  /// Set r <- Z_0 Z_0' r; in the transposed system r <- Z_0 Z' r.
  void reduce(MultiVector &r) const;

  /// Add factor D y to @p r, for y = Z_0 Z_0' y.
  void add_compliance(double factor, const MultiVector &y, MultiVector &r) const;

  /// Return reduce(residual) - D y, where y is the free part of @p lambda.
  MultiVector reduced_residual(const MultiVector &lambda, MultiVector residual) const;

private:
  RowSet            flags;
  std::vector<Slip> slipping;
  PlaceOfRow        place; ///< of slips
  bool              transposed;
};
} // namespace snug::qp

#endif
