#ifndef snug_feti_fill_orderings_h
#define snug_feti_fill_orderings_h

#include <snug/feti/csr_matrix.h>

#include <map>

namespace snug::feti {
/// This class provides elimination orders with little fill-in, one for each pattern. Most
/// subdomains of a grid have the same pattern and share its order.
class FillOrderings
{
public:
  /// Return the rows of @p pattern in the order of elimination. The pattern is symmetric and has
  /// its diagonal. The order is nested dissection by METIS, or the given order of the rows if the
  /// matrix consists of full diagonal blocks. The result does not depend on earlier calls. The
  /// reference is valid as long as this object.
  const std::vector<PetscInt> &of(const CsrPattern &pattern);

private:
  std::map<Fingerprint, std::vector<PetscInt>> known;
};
} // namespace snug::feti

#endif
