#ifndef snug_feti_subdomain_factors_h
#define snug_feti_subdomain_factors_h

#include <snug/feti/feti_parameters.h>
#include <snug/feti/generalized_inverse.h>
#include <snug/feti/local_schur.h>

#include <memory>
#include <vector>

namespace snug::feti {
/// This struct holds the factorizations of one subdomain. They depend on K and on the unknowns that
/// have an entry in B, but not on B itself.
struct SubdomainFactors
{
  /// Factorize the matrices. Error messages call them @p what. The context of @p cache must outlive
  /// this object.
  SubdomainFactors(const SubdomainSystem &system,
                   const Preconditioner   preconditioner,
                   const FactorCache     &cache,
                   const std::string     &what)
    : inverse(system, cache.inverses, cache.context, what)
  {
    if (preconditioner != Preconditioner::none)
      schur =
        std::make_unique<LocalSchur>(system, preconditioner == Preconditioner::lumped, cache, what);
  }

  GeneralizedInverse                inverse; ///< K^+
  std::unique_ptr<const LocalSchur> schur;   ///< S; null without a preconditioner
};

/// Factorizations of the subdomains of this rank. Linearizations share those of equal K.
using FactorsOfSubdomains = std::vector<std::shared_ptr<const SubdomainFactors>>;
} // namespace snug::feti

#endif
