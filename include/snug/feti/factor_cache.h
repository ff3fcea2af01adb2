#ifndef snug_feti_factor_cache_h
#define snug_feti_factor_cache_h

#include <snug/feti/generalized_inverse.h>

namespace snug::feti {
/// This struct keeps what the matrices of subdomains share over geometries and pairings: patterns,
/// elimination orders, and unused factorizations with their symbolic part.
struct FactorCache
{
  FactorCache(const Factorization package, RunContext &the_context)
    : context(the_context)
    , inverses(MatrixKind::kplus, package, &orderings, &context.work)
    , interiors(MatrixKind::dirichlet, package, &orderings, &context.work)
  {}

  RunContext            &context;
  FillOrderings          orderings;
  mutable SharedPatterns patterns;
  FactorPool             inverses;  ///< of K + rho Q_f
  FactorPool             interiors; ///< of K_ii
};
} // namespace snug::feti

#endif
