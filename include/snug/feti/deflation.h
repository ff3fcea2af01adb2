#ifndef snug_feti_deflation_h
#define snug_feti_deflation_h

#include <snug/feti/coarse_space.h>
#include <snug/feti/soft_modes.h>

#include <map>
#include <memory>
#include <set>

namespace snug::feti {
/**
 * This class deflates the dual problem by directions C, which PCPG then need not find: E = C'FC is
 * factorized, and all other directions are made F-orthogonal to C. A column of C is B_D y for the
 * forces y of a soft mode, made self-equilibrated (G c = 0) by row forces of minimum norm. These
 * act on the rows of the patch that no subdomain outside the patch shares. The patch of a soft mode
 * consists of its subdomain and the neighbours of its subdomain. C is zero on contact rows, so that
 * it lies in every face.
 *
 * Each subdomain t stores, for every vector c whose patch contains t, its part of c and the values
 * of K^+ B_t'c on its boundary. F C is never assembled.
 *
 * Sources: Farhat, Chen, Risler, Roux, A simple and unified framework for accelerating the
 * convergence of iterative substructuring methods with Lagrange multipliers, Int. J. Numer. Meth.
 * Engng 42 (1998).
 */
class Deflation
{
public:
  /// Take the row forces @p raw of those subdomains of this rank that have soft modes, in ascending
  /// order of the subdomains. Systems and layout must outlive this object. E is factorized by
  /// @p coarse_ranks ranks, see coarse_team(). Collective.
  Deflation(const std::vector<SubdomainSystem> &systems,
            const RowLayout                    &layout,
            const SubdomainTable               &table,
            unsigned int                        coarse_ranks,
            std::vector<RowForces>              raw);

  /// Compute C, F C and E for the present matrices. Collective.
  void update(const std::vector<std::unique_ptr<GeneralizedInverse>> &inverses,
              const std::vector<std::unique_ptr<LocalSchur>>         &schur);

  /// Return the number of columns of C, over all ranks.
  unsigned int n_vectors() const { return n_global; }

  /// Set x <- x - C E^-1 (F C)'x. @return the square of the F-norm of the removed part, for each
  /// column. Collective.
  std::vector<double> remove_from(qp::MultiVector &x) const;

  /// Minimize over the span of C: lambda += C E^-1 C'r, r -= F C E^-1 C'r. Collective.
  void correct(qp::MultiVector &lambda, qp::MultiVector &residual) const;

private:
  /// The data that a subdomain t stores of the vectors whose patch contains t.
  struct Part
  {
    std::vector<unsigned int> ids;  ///< ids of the vectors, ascending
    std::vector<unsigned int> rows; ///< local rows that have t as their lowest subdomain
    qp::MultiVector           C;    ///< values of C on these rows
    std::vector<BEntry>       B;    ///< entries of B, numbered on the boundary
    qp::MultiVector           X;    ///< boundary values of K^+ B'C
  };

  /// Messages by subdomain (global id). For the rows, a message holds, for each equality row of the
  /// subdomain, the global row, the number of its subdomains and n_modes numbers of G. For C, a
  /// message holds, for each vector, its id, the length of its list and the list of pairs (global
  /// row, value).
  using Numbers = std::map<unsigned int, std::vector<double>>;

  Numbers         gather_rows() const;
  Numbers         balanced_vectors() const;
  qp::MultiVector take(unsigned int s, const std::vector<double> &vectors);
  void            build_pattern();
  void            scale_E();
  qp::MultiVector multiply(const qp::MultiVector &y) const;
  qp::MultiVector solve(const qp::MultiVector &b) const;

  const std::vector<SubdomainSystem> &systems;
  const RowLayout                    &layout;
  SubdomainTable                      table;
  SubdomainRanks                      rank_of;
  std::vector<RowForces>              raw;
  unsigned int                        first_id = 0, n_global = 0;
  std::vector<unsigned int>
    n_copies; ///< number of subdomains of each local equality row, 0 for contact rows
  std::vector<std::set<unsigned int>> wanted_by; ///< ranks that need the rows of each subdomain
  std::vector<Part>                   parts;
  CsrMatrix                           E;
  std::vector<double>                 scale; ///< scales the diagonal of E to 1
  std::shared_ptr<const Team>         team;  ///< ranks that hold the factor of E
  std::unique_ptr<SparseFactor>       factor;
};
} // namespace snug::feti

#endif
