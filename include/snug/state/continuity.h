#ifndef snug_state_continuity_h
#define snug_state_continuity_h

#include <snug/feti/loaded_problem.h>

namespace snug::state {
/**
 * Make the displacements in the columns of @p u continuous between subdomains and exact at
 * supports. The smallest change with that effect is
 *   -B_E'(B_E u - g_E),
 * where the rows B_E of gluing and supports are orthonormal, so copies of a node become their mean.
 * @param g right-hand side of all owned rows; null: zero. Collective.
 */
void make_continuous(const feti::LoadedProblem &feti,
                     const qp::MultiVector     *g,
                     feti::PrimalVectors       &u);

/// Return the energy norms (u'Ku)^(1/2) of the columns of @p u [(force length)^(1/2)], empty
/// without columns. Collective.
std::vector<double> energy_norms(const feti::LoadedProblem &feti, const feti::PrimalVectors &u);
} // namespace snug::state

#endif
