#ifndef snug_feti_jump_operator_h
#define snug_feti_jump_operator_h

#include <snug/feti/coarse_space.h>
#include <snug/feti/row_gram.h>
#include <snug/feti/subdomain_ranks.h>

namespace snug::feti {
/**
 * This struct is the column of one unknown i of a subdomain in the jump operator P_D: the jumps at
 * gluing and supports that a motion of the unknown causes, and the row forces that these jumps
 * cause. With B of the equality rows alone,
 * @f[ B_D = (B D^{-1} B^T)^{-1} B D^{-1}, \qquad P_D = B_D^T B, \f]
 * and the columns are @f$B_D e_i@f$ and @f$P_D e_i@f$. For m plain
 * copies of an unknown, of stiffnesses D, @f$P_D e_i@f$ is @f$1 - D_i / \sum D@f$ at i and
 * @f$-D_i / \sum D@f$ at the other copies.
 */
struct JumpColumn
{
  struct Force
  {
    unsigned int row; ///< global
    double       value;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive & row & value;
    }
  };

  struct Copy
  {
    unsigned int subdomain; ///< global
    unsigned int dof;
    double       value;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive & subdomain & dof & value;
    }
  };

  unsigned int       subdomain; ///< global
  unsigned int       dof;       ///< unknown i, which has an equality row
  std::vector<Force> forces;    ///< B_D e_i
  std::vector<Copy>  copies;    ///< P_D e_i, by subdomain and unknown

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive & subdomain & dof & forces & copies;
  }
};

/// Columns of one subdomain, by unknown.
using JumpColumns = std::vector<JumpColumn>;

/// Return the columns of the jump operator for the @p n_subdomains subdomains of this rank, which
/// are those of @p table. @p entries are B and 1/D as in RowGram, @p stride numbers apart.
/// Of B only the node rows count. Ties would connect all unknowns of a boundary.
/// Collective.
std::vector<JumpColumns> jump_operator(const RowLayout           &layout,
                                       const RowGram             &gram,
                                       const std::vector<double> &entries,
                                       unsigned int               stride,
                                       const SubdomainTable      &table,
                                       unsigned int               n_subdomains);
} // namespace snug::feti

#endif
