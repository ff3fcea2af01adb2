#ifndef snug_state_certificate_h
#define snug_state_certificate_h

#include <snug/feti/loaded_problem.h>
#include <snug/state/contact_state.h>

namespace snug::state {
/// Return the certificate of u and lambda, computed from K, f, B and g alone. Collective.
Certificate certify(const feti::LoadedProblem &feti,
                    const qp::MultiVector     &lambda,
                    const feti::PrimalVectors &u);

/**
 * Return whether the forces move the bodies by less than a thousandth of the lengths that gaps and
 * supports prescribe, max_i(F_ii |lambda_i|) < 1e-3 max_i |g_i|. In this case the forces may be
 * iteration errors of forces that are zero in the exact solution. A start from zero forces finds an
 * unloaded state exactly. Collective.
 */
bool is_nearly_unloaded(const feti::LoadedProblem &feti, const qp::MultiVector &lambda);
} // namespace snug::state

#endif
