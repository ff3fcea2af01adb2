#ifndef snug_state_certificate_h
#define snug_state_certificate_h

#include <snug/feti/total_feti.h>
#include <snug/state/contact_state.h>

namespace snug::state {
/// The certificate of u and lambda, from K, f, B and g alone. Collective.
Certificate
certify(const feti::TotalFeti &feti, const qp::MultiVector &lambda, const feti::PrimalVectors &u);

/**
 * Whether the forces move the bodies by less than a thousandth of what gaps
 * and supports prescribe, max_i(F_ii |lambda_i|) < 1e-3 max_i |g_i|. They
 * may then be what an iteration left of forces that are not there:
 * starting from none finds an unloaded state exactly. Collective.
 */
bool is_nearly_unloaded(const feti::TotalFeti &feti, const qp::MultiVector &lambda);
} // namespace snug::state

#endif
