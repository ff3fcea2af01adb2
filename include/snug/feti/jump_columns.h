#ifndef snug_feti_jump_columns_h
#define snug_feti_jump_columns_h

#include <snug/feti/coarse_space.h>
#include <snug/feti/row_gram.h>

namespace snug::feti {
/**
 * This struct describes the jumps at gluing and supports that a motion of the unknowns of one
 * subdomain causes, and the row forces that these jumps cause. With B of the equality rows alone,
 * @f[ B_D = (B D^{-1} B^T)^{-1} B D^{-1}, \qquad P_D = B_D^T B, \f]
 * and an unknown i of the subdomain has the columns @f$B_D e_i@f$ and @f$P_D e_i@f$. For m plain
 * copies of an unknown, of stiffnesses D, @f$P_D e_i@f$ is @f$1 - D_i / \sum D@f$ at i and
 * @f$-D_i / \sum D@f$ at the other copies.
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

  std::vector<unsigned int>       dofs;   ///< unknowns with an equality row, ascending
  std::vector<std::vector<Force>> forces; ///< B_D e_i of each unknown i of dofs
  std::vector<std::vector<Copy>>  copies; ///< P_D e_i of each unknown i, by subdomain and unknown
};

/// This class finds the rank of a subdomain from the first subdomains of all ranks.
class SubdomainRanks
{
public:
  /// Gather @p first, the global id of the first subdomain of this rank. Collective.
  SubdomainRanks(unsigned int first, MPI_Comm comm);

  /// Return the rank that holds @p subdomain (global id).
  unsigned int operator()(unsigned int subdomain) const;

private:
  std::vector<unsigned int> first_of_rank;
};

/// Return the jump columns of the @p n_subdomains subdomains of this rank. Their global ids begin
/// at @p first. @p entries are B and 1/D as in RowGram::update(), @p stride numbers apart.
/// Collective.
std::vector<JumpColumns> jump_columns(const RowLayout           &layout,
                                      const RowGram             &gram,
                                      const std::vector<double> &entries,
                                      unsigned int               stride,
                                      unsigned int               first,
                                      unsigned int               n_subdomains);
} // namespace snug::feti

#endif
