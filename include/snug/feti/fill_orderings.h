#ifndef snug_feti_fill_orderings_h
#define snug_feti_fill_orderings_h

#include <snug/feti/csr_matrix.h>

#include <map>

namespace snug::feti {
/// Orders in which matrices fill in little when they are factorized, one for all of a pattern:
/// most subdomains of a grid have the same.
class FillOrderings
{
public:
  /// The rows of @p pattern, which is symmetric and has its diagonal, in the order of elimination:
  /// nested dissection by METIS, or as they are where blocks are full, which does not depend on
  /// what was asked for before. Valid as long as this object.
  const std::vector<PetscInt> &of(const CsrPattern &pattern);

private:
  std::map<Fingerprint, std::vector<PetscInt>> known;
};
} // namespace snug::feti

#endif
