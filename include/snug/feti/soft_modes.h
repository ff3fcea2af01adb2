#ifndef snug_feti_soft_modes_h
#define snug_feti_soft_modes_h

#include <snug/feti/generalized_inverse.h>
#include <snug/feti/jump_columns.h>
#include <snug/feti/local_schur.h>

namespace snug::feti {
/// Entry (i, j) of a matrix on the unknowns of a subdomain; several add up.
struct JumpStiffness
{
  unsigned int i, j;
  double       value;
};

/**
 * What a motion of a subdomain s costs its neighbours t by the jumps that it
 * causes, @f$\sum_{t \ne s} P_t^T K_t P_t@f$ with @f$P_t@f$ the columns of s in
 * @f$P_D@f$ at the unknowns of t: entries (i, j) of unknowns of s. The stiffness
 * of t's unknowns at s with all others held stands for its Schur complement,
 * and is an upper bound of it. @p columns and @p systems are those of this
 * rank. Collective.
 */
std::vector<std::vector<JumpStiffness>>
stiffness_of_neighbours(const std::vector<SubdomainSystem> &systems,
                        const std::vector<JumpColumns>     &columns,
                        unsigned int                        first,
                        MPI_Comm                            comm);

/// The soft modes of one subdomain.
struct SoftModes
{
  qp::MultiVector     forces; ///< per unknown of the subdomain, B_D of which is the row forces
  std::vector<double> mu;     ///< descending
};

/**
 * Motions v of a subdomain that jumps make much stiffer than the subdomain
 * is itself,
 * @f[ A v = \mu S v, \quad \mu > c, \qquad
 *     A = P_s^T S P_s + \sum_{t \ne s} P_t^T K_t P_t, \f]
 * of which the preconditioned dual operator has eigenvalues as large as mu:
 * bending of flat parts, hinges at narrow necks. Found by Rayleigh-Ritz on a
 * block Krylov space of K^+ A from fixed pseudo-random motions, so that the
 * same subdomain has the same modes on every rank. At most 24.
 * @return for each the forces y with @f$B_s^T B_D y = A v@f$.
 *
 * Source: Spillane, Rixen, Automatic spectral coarse spaces for robust FETI
 * and BDD algorithms, Int. J. Numer. Meth. Engng 95 (2013).
 */
SoftModes soft_modes(const SubdomainSystem            &system,
                     const GeneralizedInverse         &inverse,
                     const LocalSchur                 &schur,
                     const JumpColumns                &columns,
                     const std::vector<JumpStiffness> &neighbours,
                     unsigned int                      subdomain);

/// Row forces B_D y of the soft modes of one subdomain, before they are in equilibrium.
struct RowForces
{
  unsigned int              subdomain; ///< global id
  std::vector<unsigned int> patch;     ///< it and its neighbours, ascending
  std::vector<unsigned int> rows;      ///< global, ascending
  qp::MultiVector           values;    ///< rows x modes
};

RowForces row_forces(const SoftModes &modes, const JumpColumns &columns, unsigned int subdomain);
} // namespace snug::feti

#endif
