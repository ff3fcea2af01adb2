#ifndef snug_state_ties_h
#define snug_state_ties_h

#include <snug/contact/contact.h>

#include <memory>

namespace snug::state {
/**
 * This class provides the rows of tied pairs (contact::Law::tied): the coefficients of the normal
 * and tangential rows that a contact of the pair with friction has,
 *   c_i . u = 0,
 * which are equations instead of bounds. A gap between the sides stays, without strain: the
 * right-hand side is zero, and the couples of tangential rows transmit moments across the gap. The
 * bodies of a pair have one position, so the rows are those of the reference position. All data are
 * replicated.
 */
template <int dim>
class Ties
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Pair the nodes of tied @p pairs at @p positions, where the supports hold the directions
  /// @p held. @p surface must outlive this object. @throws InputError naming a pair without rows.
  Ties(const mesh::Surface<dim>         &surface,
       std::vector<contact::Pair>        pairs,
       unsigned int                      degree,
       const Field                      &positions,
       const faces::HeldDirections<dim> &held);

  /// Pair again at @p positions.
  void pair(const Field &positions, const faces::HeldDirections<dim> &held);

  bool empty() const { return !contact; }

  /// Return the tied pairs after the choice of their slave sides.
  std::vector<contact::NamedPair> named_pairs() const
  {
    return contact ? contact->named_pairs() : std::vector<contact::NamedPair>();
  }

  /// Return the rows at @p positions: normal rows, then tangential rows.
  std::vector<contact::Row<dim>> rows(const Field &positions) const;

  /// Return the exact derivatives of the rows along @p velocity.
  std::vector<contact::Row<dim>> row_derivatives(const Field &positions,
                                                 const Field &velocity) const;

  /// Return d/dX sum_i forces_i c_i . u at fixed @p displacement, for the forces of rows().
  Field energy_gradient(const Field               &positions,
                        const Field               &displacement,
                        const std::vector<double> &forces) const;

  /// Return the tractions on the slave sides at the slave nodes of the normal rows, for the forces
  /// of rows() at @p positions [force / length^2]. Rows without an area have none.
  std::vector<dealii::Tensor<1, dim>> tractions(const Field               &positions,
                                                const std::vector<double> &forces) const;

  /// Part of a tied pair that a displacement parts.
  struct Parting
  {
    double      distance = 0.; ///< maximum [length]
    std::string pair;          ///< "slave: master"
  };
  /// Return where a @p displacement parts the sides most. Supports that hold both sides differently
  /// part them, because their rows are left out.
  Parting parting(const Field &positions, const Field &displacement) const;

  /// Return the pairing of the nodes, with the normal rows, the places of tangential rows, and the
  /// areas; nullptr: there are no tied pairs.
  const contact::Contact<dim> *paired() const { return contact.get(); }

private:
  std::vector<double> with_held(const std::vector<double> &forces) const;

  std::vector<contact::Row<dim>> joined(std::vector<contact::Row<dim>>        rows,
                                        const std::vector<contact::Row<dim>> &tangents) const;

  std::unique_ptr<contact::Contact<dim>> contact; ///< of the tied pairs; null: there are none
};
} // namespace snug::state

#endif
