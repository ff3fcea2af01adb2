#ifndef snug_feti_patch_h
#define snug_feti_patch_h

#include <deal.II/lac/lapack_full_matrix.h>

#include <vector>

namespace snug::feti {
/// The rows of one patch of subdomains that no other subdomain shares, ascending.
class Patch
{
public:
  /// A row of one of its subdomains.
  struct Touch
  {
    unsigned int  row;    ///< global
    unsigned int  copies; ///< subdomains of the row
    unsigned int  member; ///< of the patch
    const double *G;      ///< n_modes numbers
  };

  /// @p touches all rows of all @p n_members subdomains, in any order.
  Patch(std::vector<Touch> touches, unsigned int n_members, unsigned int n_modes);

  unsigned int n_rows() const { return static_cast<unsigned int>(start.size()) - 1; }

  /// Subdomains of row i; the first is the lowest.
  const Touch *begin(unsigned int i) const { return &inner[start[i]]; }
  const Touch *end(unsigned int i) const { return &inner[0] + start[i + 1]; }

  /// The least change that brings the row forces @p c (n_rows) into equilibrium,
  /// @f$c \leftarrow c - G_L^T (G_L G_L^T)^+ G_L c@f$; zero where that leaves nothing but rounding.
  void balance(std::vector<double> &c) const;

private:
  void factorize();

  unsigned int                     n_modes, n;
  std::vector<Touch>               inner;
  std::vector<unsigned int>        start;
  dealii::LAPACKFullMatrix<double> gram; ///< factorized
};
} // namespace snug::feti

#endif
