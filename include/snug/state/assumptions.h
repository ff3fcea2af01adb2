#ifndef snug_state_assumptions_h
#define snug_state_assumptions_h

#include <snug/state/state_solver.h>

namespace snug::state {
/// @name From where on the answer of a linear model is doubtful
/// @{
constexpr double large_rotation = 0.1; ///< [rad]: lengths change by 0.5 %
constexpr double large_strain   = 0.1;
constexpr double large_slip     = 0.5;   ///< of a face
constexpr double large_drift    = 0.5;   ///< of a face
constexpr double least_width    = 3.;    ///< of a contact, in faces
constexpr double large_overlap  = 0.1;   ///< of a face
constexpr double finer_slave    = 1.5;   ///< times, of mortar
constexpr double least_motion   = 1e-13; ///< of nodes: below it is rounding
constexpr double large_facets   = 0.05;  ///< height of facets, of the gaps closed
/// @}

/// An overlap of more faces is not a rough mesh but a wrong pair.
constexpr double absurd_overlap = 2.;

/**
 * What a state does to the assumptions it rests on. Rotation and strain
 * are Frobenius norms over sqrt(2) and 1 of the two parts of the
 * displacement gradient that fits a cell's nodes best. See
 * contact::Contact for slip and drift. The largest gap or overlap of rows
 * with a force is how far facets that contact sees as they are may be high.
 * Collective.
 */
template <int dim>
Assumptions assess(const StateSolver<dim>               &solver,
                   const std::vector<contact::Row<dim>> &contact_rows,
                   const ContactState<dim>              &state);

/// Whether nothing moves but by the rounding of gaps: no load does work, and no prescribed
/// displacement or overlap drives. Loads that are small, however small, do.
template <int dim>
bool is_at_rest(const ContactState<dim> &state)
{
  return state.compliance == 0. && state.assumptions.displacement < least_motion;
}

/// One line for each number that is doubtful.
std::vector<std::string> warnings(const Assumptions &assumptions);

/// @throws InputError if slave nodes of a pair overlap the master by more
/// than absurd_overlap where they were paired and that is not wanted.
void check_overlaps(const std::vector<contact::Pair>       &pairs,
                    const std::vector<contact::PairedGaps> &gaps);

/// One line for each pair whose slave nodes overlap the master by more
/// than large_overlap where they were paired, if that is not wanted.
std::vector<std::string> overlap_warnings(const std::vector<contact::Pair>       &pairs,
                                          const std::vector<contact::PairedGaps> &gaps);

/// One line for each nodal pair of faces whose meshes do not match, and for each
/// mortar pair whose slave faces are finer by more than finer_slave.
std::vector<std::string> matching_warnings(const std::vector<contact::Pair>     &pairs,
                                           const std::vector<contact::Matching> &matchings);
} // namespace snug::state

#endif
