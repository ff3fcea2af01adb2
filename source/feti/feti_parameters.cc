#include <snug/base/entries.h>
#include <snug/feti/feti_parameters.h>

namespace snug::feti {
void FetiParameters::declare(Entries &entries)
{
  entries.add("Factorization", factorization, choice("CHOLMOD|MUMPS"),
              "Package that factorizes the subdomains.");
  entries.add("Preconditioner", preconditioner, choice("Dirichlet|lumped|none"),
              "Dirichlet: fewest iterations; lumped: cheaper ones; none: for comparison.");
  entries.add("Scaling", scaling, choice("stiffness|multiplicity"),
              "How the preconditioner weighs the copies of a node: by their stiffness, for bodies "
              "of different moduli, or by their number.");
}
} // namespace snug::feti
