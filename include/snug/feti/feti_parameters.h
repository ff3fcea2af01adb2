#ifndef snug_feti_feti_parameters_h
#define snug_feti_feti_parameters_h

#include <string>

namespace snug {
class Entries;
}

namespace snug::feti {
/// Entries of `subsection Solver` that Total FETI reads.
struct FetiParameters
{
  std::string factorization  = "CHOLMOD";   ///< CHOLMOD | MUMPS
  std::string preconditioner = "Dirichlet"; ///< Dirichlet | lumped | none
  std::string scaling        = "stiffness"; ///< stiffness | multiplicity

  void declare(Entries &entries);
};
} // namespace snug::feti

#endif
