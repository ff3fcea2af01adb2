#ifndef snug_feti_jump_columns_h
#define snug_feti_jump_columns_h

#include <snug/feti/coarse_space.h>
#include <snug/feti/row_gram.h>

namespace snug::feti {
/**
 * What a motion of one subdomain's unknowns does to the jumps of gluing and
 * supports and to the forces that these cause, with B of the equality rows
 * alone:
 * @f[ B_D = (B D^{-1} B^T)^{-1} B D^{-1}, \qquad P_D = B_D^T B, \f]
 * of which an unknown i of the subdomain has the columns @f$B_D e_i@f$ and
 * @f$P_D e_i@f$. For m plain copies of an unknown, of stiffnesses D,
 * @f$P_D e_i@f$ is @f$1 - D_i / \sum D@f$ at i and @f$-D_i / \sum D@f$ at the
 * other copies.
 */
struct JumpColumns
{
  struct Force
  {
    unsigned int row; ///< global
    double       value;
  };

  struct Copy
  {
    unsigned int subdomain; ///< global
    unsigned int dof;
    double       value;
  };

  std::vector<unsigned int>       dofs;   ///< with an equality row, ascending
  std::vector<std::vector<Force>> forces; ///< B_D e_i of each
  std::vector<std::vector<Copy>>  copies; ///< P_D e_i of each, by subdomain and unknown
};

/// Ranks by their first subdomains.
class SubdomainRanks
{
public:
  /// @p first global id of this rank's first. Collective.
  SubdomainRanks(unsigned int first, MPI_Comm comm);

  /// The rank that has a subdomain.
  unsigned int operator()(unsigned int subdomain) const;

private:
  std::vector<unsigned int> first_of_rank;
};

/// Of each of the @p n_subdomains of this rank, which begin at the global id @p first. @p entries
/// are B and 1/D as RowGram has them, @p stride apart. Collective.
std::vector<JumpColumns> jump_columns(const RowLayout           &layout,
                                      const RowGram             &gram,
                                      const std::vector<double> &entries,
                                      unsigned int               stride,
                                      unsigned int               first,
                                      unsigned int               n_subdomains);
} // namespace snug::feti

#endif
