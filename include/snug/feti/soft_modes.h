#ifndef snug_feti_soft_modes_h
#define snug_feti_soft_modes_h

#include <snug/feti/jump_operator.h>
#include <snug/feti/subdomain_factors.h>

namespace snug::feti {
/// Entry (i, j) of a matrix on the unknowns of a subdomain. Several entries of one place are
/// summed.
struct JumpStiffness
{
  unsigned int i, j;
  double       value;
};

/**
 * Return the stiffness with which the neighbours t resist a motion of a subdomain s, by the jumps
 * that the motion causes: @f$\sum_{t \ne s} P_t^T K_t P_t@f$ as entries (i, j) of unknowns of s.
 * @f$P_t@f$ are the columns of s in @f$P_D@f$ at the unknowns of t. The block of K_t at unknowns
 * shared with s, with all other unknowns of t held, replaces the Schur complement of t and is an
 * upper bound of it. @p columns and @p systems are those of this rank, and @p first is the global
 * id of its first subdomain. Collective.
 */
std::vector<std::vector<JumpStiffness>>
stiffness_of_neighbours(const std::vector<SubdomainSystem> &systems,
                        const std::vector<JumpColumns>     &columns,
                        unsigned int                        first,
                        MPI_Comm                            comm);

/// The soft modes of one subdomain.
struct SoftModes
{
  qp::MultiVector     forces; ///< y per unknown of the subdomain; the row forces are B_D y
  std::vector<double> mu;     ///< descending
};

/**
 * Return the soft modes of a subdomain, with at most 24 modes. Soft modes are motions v whose jumps
 * are much stiffer than the subdomain itself,
 * @f[ A v = \mu S v, \quad \mu > c, \qquad
 *     A = P_s^T S P_s + \sum_{t \ne s} P_t^T K_t P_t. \f]
 * They cause eigenvalues as large as mu of the preconditioned dual operator. Examples are bending
 * of flat parts and hinges at narrow necks. The modes are computed by Rayleigh-Ritz on a block
 * Krylov space of K^+ A. It starts from fixed pseudo-random motions, so that the same subdomain has
 * the same modes on every rank.
 * @return for each mode the forces y with @f$B_s^T B_D y = A v@f$.
 *
 * Source: Spillane, Rixen, Automatic spectral coarse spaces for robust FETI and BDD algorithms,
 * Int. J. Numer. Meth. Engng 95 (2013).
 */
SoftModes soft_modes(const SubdomainSystem            &system,
                     const SubdomainFactors           &factors,
                     const JumpColumns                &columns,
                     const std::vector<JumpStiffness> &neighbours,
                     unsigned int                      subdomain);

/// Row forces B_D y of the soft modes of one subdomain, before they are brought into equilibrium.
struct RowForces
{
  unsigned int              subdomain;     ///< global id
  std::vector<unsigned int> neighbourhood; ///< the subdomain and its neighbours, ascending
  std::vector<unsigned int> rows;          ///< global rows, ascending
  qp::MultiVector           values;        ///< rows x modes
};

/// Return the row forces B_D y of @p modes, with the neighbourhood of @p subdomain (global id).
RowForces row_forces(const SoftModes &modes, const JumpColumns &columns, unsigned int subdomain);
} // namespace snug::feti

#endif
