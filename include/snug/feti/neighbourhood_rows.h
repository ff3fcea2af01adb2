#ifndef snug_feti_neighbourhood_rows_h
#define snug_feti_neighbourhood_rows_h

#include <deal.II/lac/lapack_full_matrix.h>

#include <boost/serialization/array.hpp>

#include <array>
#include <vector>

namespace snug::feti {
/// A row at one of its subdomains. It is also a message.
struct RowCopy
{
  unsigned int          row;          ///< global
  unsigned int          multiplicity; ///< number of subdomains of the row
  unsigned int          subdomain;    ///< global id
  std::array<double, 6> G;            ///< n_modes numbers of G

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & row & multiplicity & subdomain & G;
  }
};

/// This class holds, ascending, the rows of a neighbourhood of subdomains that no other subdomain
/// shares.
class NeighbourhoodRows
{
public:
  /// Take the rows from @p copies: all rows of all @p members, in any order. The members are
  /// ascending.
  NeighbourhoodRows(std::vector<RowCopy>             copies,
                    const std::vector<unsigned int> &members,
                    unsigned int                     n_modes);

  unsigned int n_rows() const { return static_cast<unsigned int>(start.size()) - 1; }

  /// Return the range of the subdomains of row i. The first is the lowest subdomain.
  const RowCopy *begin(unsigned int i) const { return inner.data() + start[i]; }
  const RowCopy *end(unsigned int i) const { return inner.data() + start[i + 1]; }

  /// Apply the change of minimum norm that brings the row forces @p c (n_rows) into equilibrium,
  /// @f$c \leftarrow c - G_L^T (G_L G_L^T)^+ G_L c@f$. @p c is set to zero if the remainder is
  /// rounding error.
  void balance(std::vector<double> &c) const;

private:
  void factorize();

  /// Return the first coarse coordinate of the subdomain of @p copy.
  unsigned int first_mode(const RowCopy *copy) const { return first[copy - inner.data()]; }

  unsigned int                     n_modes, n;
  std::vector<RowCopy>             inner;
  std::vector<unsigned int>        first; ///< first_mode() of inner
  std::vector<unsigned int>        start;
  dealii::LAPACKFullMatrix<double> gram; ///< G_L G_L' with a shift, factorized
};
} // namespace snug::feti

#endif
