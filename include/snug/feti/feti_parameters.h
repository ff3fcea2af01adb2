#ifndef snug_feti_feti_parameters_h
#define snug_feti_feti_parameters_h

#include <snug/base/values.h>

namespace snug {
class Entries;
}

namespace snug::feti {
enum class Factorization
{
  CHOLMOD,
  MUMPS
};
inline Names names(Factorization)
{
  return {{"CHOLMOD"}, {"MUMPS"}};
}

enum class Preconditioner
{
  Dirichlet,
  lumped,
  none
};
inline Names names(Preconditioner)
{
  return {{"Dirichlet", "Schur complements of the subdomains, with the fewest iterations"},
          {"lumped", "stiffness of the interface nodes, with cheaper iterations"},
          {"none", "identity, for comparison"}};
}

enum class Scaling
{
  stiffness,
  multiplicity
};
inline Names names(Scaling)
{
  return {{"stiffness", "stiffness of each copy, for bodies of different moduli"},
          {"multiplicity", "reciprocal of the number of copies"}};
}

enum class SoftModesOf
{
  likely,
  all,
  none
};
inline Names names(SoftModesOf)
{
  return {{"auto", "all subdomains if a subdomain or its cells are stretched, otherwise none"},
          {"all", "all subdomains"},
          {"none", "no subdomains"}};
}

/// Entries of `subsection Solver` that Total FETI reads.
struct FetiParameters
{
  Factorization  factorization  = Factorization::CHOLMOD;
  Preconditioner preconditioner = Preconditioner::Dirichlet;
  Scaling        scaling        = Scaling::stiffness;
  SoftModesOf    soft_modes     = SoftModesOf::likely;
  unsigned int   coarse_ranks   = 0; ///< see coarse_group()

  void declare(Entries &entries);
};
} // namespace snug::feti

#endif
