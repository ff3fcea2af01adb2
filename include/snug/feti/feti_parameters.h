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
  return {{"Dirichlet"}, {"lumped"}, {"none"}};
}

enum class Scaling
{
  stiffness,
  multiplicity
};
inline Names names(Scaling)
{
  return {{"stiffness"}, {"multiplicity"}};
}

enum class SoftModesOf
{
  likely,
  all,
  none
};
inline Names names(SoftModesOf)
{
  return {{"auto"}, {"all"}, {"none"}};
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
