#ifndef snug_state_validity_checks_h
#define snug_state_validity_checks_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// @name Limits beyond which the result of the linear model is doubtful
/// @{
constexpr double large_rotation = 0.1; ///< [rad]: lengths change by 0.5 %
constexpr double large_strain   = 0.1;
constexpr double wrong_rotation = 0.5;   ///< [rad]: lengths change by 12 %
constexpr double wrong_effect   = 0.2;   ///< of geometric_effects() on forces
constexpr double large_effect   = 0.02;  ///< of geometric_effects() on forces
constexpr double large_slip     = 0.5;   ///< in faces
constexpr double large_drift    = 0.5;   ///< in faces
constexpr double least_width    = 3.;    ///< minimum width of a contact, in faces
constexpr double large_overlap  = 0.1;   ///< in faces
constexpr double finer_slave    = 1.5;   ///< size ratio of master to slave faces, for mortar
constexpr double least_motion   = 1e-13; ///< of nodes; smaller motions are round-off
constexpr double large_facets   = 0.05;  ///< height of facets over the closed gap
constexpr double large_friction = 1.5;   ///< coefficient: more is rather a mistake, as of units
/// @}

/// Overlap, in faces, beyond which the cause is not a rough mesh but a wrong pair.
constexpr double absurd_overlap = 2.;

/**
 * Return the quantities of a state that show whether its assumptions hold. Rotation and strain are
 * Frobenius norms, over sqrt(2) and 1, of the two parts of the displacement gradient that fits the
 * nodes of a cell best. See contact::Contact for slip and drift. Facets that contact does not
 * smooth are compared with the maximum gap or overlap of rows with a force. Collective.
 */
template <int dim>
ValidityChecks check_validity(const StateSolver<dim>               &solver,
                              const std::vector<contact::Row<dim>> &contact_rows,
                              const ContactState<dim>              &state);

/// Return whether nothing moves except by the round-off of gaps. In this case no load does work,
/// and no prescribed displacement or overlap moves a body. Loads that are small, however small, do
/// work.
template <int dim>
bool is_at_rest(const ContactState<dim> &state)
{
  return state.compliance == 0. && state.validity.displacement < least_motion;
}

/// Return a warning for each number beyond its limit.
std::vector<Warning> warnings(const ValidityChecks &validity);

/// Return why large displacements make a result wrong; empty if they do not.
std::string why_not_valid(const ValidityChecks &validity);

/// Return the warning about facets among them; nothing if the facets are below their limit.
std::optional<Warning> facet_warning(const ValidityChecks &validity);

/// Check the overlaps of the pairs. Messages contain @p place, see place_of().
/// @throws InputError if slave nodes of a pair overlap the master by more than absurd_overlap where
/// they were paired and the overlap is not intended.
void check_overlaps(const std::vector<contact::Pair>       &pairs,
                    const std::vector<contact::PairedGaps> &gaps,
                    const std::string                      &place = "");

/// Return a warning for each pair whose slave nodes overlap the master by more than large_overlap
/// where they were paired, if the overlap is not intended.
std::vector<Warning> overlap_warnings(const std::vector<contact::Pair>       &pairs,
                                      const std::vector<contact::PairedGaps> &gaps,
                                      const std::string                      &place = "");

/// Return a warning for each pair of the scene with a friction coefficient above large_friction.
template <int dim>
std::vector<Warning> friction_warnings(const contact::Contact<dim> &contact);

/// Return a warning for each nodal pair of faces whose meshes do not match, and for each mortar
/// pair whose slave faces are finer by more than the factor finer_slave.
std::vector<Warning> matching_warnings(const std::vector<contact::Pair>     &pairs,
                                       const std::vector<contact::Matching> &matchings);
} // namespace snug::state

#endif
