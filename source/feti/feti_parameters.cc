#include <snug/base/entries.h>
#include <snug/feti/feti_parameters.h>

namespace snug::feti {
void FetiParameters::declare(Entries &entries)
{
  entries.add("Factorization", factorization, "Package that factorizes the subdomains.");
  entries.add("Preconditioner", preconditioner,
              "Dirichlet: fewest iterations; lumped: cheaper ones; none: for comparison.");
  entries.add("Scaling", scaling,
              "How the preconditioner weighs the copies of a node: by their stiffness, for bodies "
              "of different moduli, or by their number.");
  entries.add("Soft modes", soft_modes,
              "Subdomains of which motions that would take many iterations are found beforehand, "
              "once for a mesh: auto: all but compact ones of compact cells.");
  entries.add("Coarse ranks", coarse_ranks,
              "Ranks that factorize a coarse problem in common, by MUMPS: 0: by its size; 1: every "
              "rank for itself, as all do by default where it has at most 20,000 unknowns.");
}
} // namespace snug::feti
