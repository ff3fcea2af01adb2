#ifndef snug_state_certificate_h
#define snug_state_certificate_h

#include <snug/feti/total_feti.h>
#include <snug/state/contact_state.h>

namespace snug
{
  namespace state
  {
    /// The certificate of u and lambda, from K, f, B and g alone. Collective.
    Certificate
    certify(const feti::TotalFeti     &feti,
            const qp::MultiVector     &lambda,
            const feti::PrimalVectors &u);
  } // namespace state
} // namespace snug

#endif
