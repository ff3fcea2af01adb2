#include <snug/base/entries.h>
#include <snug/feti/feti_parameters.h>

namespace snug::feti {
void FetiParameters::declare(Entries &entries)
{
  entries.add("Factorization", factorization,
              "The package that factorizes the matrices of the subdomains.");
  entries.add("Preconditioner", preconditioner, "The preconditioner of the dual problem.");
  entries.add("Scaling", scaling, "The weights of the copies of a node in the preconditioner.");
  entries.add(
    "Soft modes", soft_modes,
    "The subdomains whose soft modes enrich the coarse space. Soft modes are deformations "
    "that would need many iterations. They are computed once for a mesh.");
  entries.add(
    "Coarse ranks", coarse_ranks,
    "The number of ranks that factorize a coarse problem together, by MUMPS. A value of 1 "
    "means that every rank factorizes it alone. A value of 0 means a number that follows "
    "from its size, which is 1 up to 20,000 unknowns.");
}
} // namespace snug::feti
