#ifndef snug_state_position_problem_h
#define snug_state_position_problem_h

#include <snug/contact/contact.h>
#include <snug/feti/loaded_problem.h>
#include <snug/state/gluing.h>
#include <snug/state/reference_points.h>
#include <snug/state/ties.h>

#include <memory>

namespace snug::state {
/**
 * This struct is the part of a StateProblem that belongs to one position of the bodies and to the
 * motions of reference points that are held: contact, the rows of B, and the dual problem on these
 * rows. Load cases with both in common share it.
 *
 * The stiffness of a body and its rigid modes are known in the frame of the body, so the position
 * does not change them. All positions share the stiffness, its factorizations and the soft modes.
 */
template <int dim>
struct PositionProblem
{
  PositionProblem(contact::Position<dim> the_position, unsigned int the_first_case)
    : position(std::move(the_position)), first_case(the_first_case)
  {}

  const contact::Position<dim>               position;
  const unsigned int                         first_case; ///< first load case of the problem
  std::unique_ptr<contact::Contact<dim>>     contact;
  std::unique_ptr<Gluing<dim>>               gluing;
  feti::ContactPairs                         pairs_of_rows;
  std::unique_ptr<const feti::DualStructure> structure;

  /// @name Data of the present geometry
  /// @{
  RowCoefficients<dim>                       rows;          ///< data of the rows of B
  std::unique_ptr<const feti::Linearization> linearization; ///< null: to be computed
  qp::FrictionCones                          cones;         ///< of the contacts with friction
  /// @}
};
} // namespace snug::state

#endif
