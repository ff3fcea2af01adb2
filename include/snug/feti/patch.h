#ifndef snug_feti_patch_h
#define snug_feti_patch_h

#include <deal.II/lac/lapack_full_matrix.h>

#include <vector>

namespace snug::feti {
/// This class holds, ascending, the rows of a patch of subdomains that no other subdomain shares.
class Patch
{
public:
  /// A row of one member of the patch.
  struct Touch
  {
    unsigned int  row;    ///< global
    unsigned int  copies; ///< number of subdomains of the row
    unsigned int  member; ///< index of the subdomain in the patch
    const double *G;      ///< n_modes numbers of G
  };

  /// Take the patch's rows from @p touches: all rows of all @p n_members subdomains, in any order.
  Patch(std::vector<Touch> touches, unsigned int n_members, unsigned int n_modes);

  unsigned int n_rows() const { return static_cast<unsigned int>(start.size()) - 1; }

  /// Return the range of the subdomains of row i. The first is the lowest subdomain.
  const Touch *begin(unsigned int i) const { return &inner[start[i]]; }
  const Touch *end(unsigned int i) const { return &inner[0] + start[i + 1]; }

  /// Apply the change of minimum norm that brings the row forces @p c (n_rows) into equilibrium,
  /// @f$c \leftarrow c - G_L^T (G_L G_L^T)^+ G_L c@f$. @p c is set to zero if the remainder is
  /// rounding error.
  void balance(std::vector<double> &c) const;

private:
  void factorize();

  unsigned int                     n_modes, n;
  std::vector<Touch>               inner;
  std::vector<unsigned int>        start;
  dealii::LAPACKFullMatrix<double> gram; ///< G_L G_L' with a shift, factorized
};
} // namespace snug::feti

#endif
