#ifndef snug_feti_deflation_h
#define snug_feti_deflation_h

#include <snug/feti/coarse_space.h>
#include <snug/feti/soft_modes.h>

#include <map>
#include <memory>
#include <set>

namespace snug::feti {
/**
 * Directions C of the dual problem that PCPG need not find, as E = C'FC is
 * factorized and all others are made F-orthogonal to them. Each is B_D y of a
 * soft mode's forces y, made self-equilibrated (G c = 0) by the least forces on
 * the rows of its patch, the subdomain and its neighbours, that no other
 * subdomain shares. C has no contact rows, so that it lies in every face.
 *
 * Of a vector's patch each subdomain t has its part of C and the values of
 * K^+ B_t'c on its boundary: F C is never assembled.
 *
 * Sources: Farhat, Chen, Risler, Roux, A simple and unified framework for
 * accelerating the convergence of iterative substructuring methods with
 * Lagrange multipliers, Int. J. Numer. Meth. Engng 42 (1998).
 */
class Deflation
{
public:
  /// @p raw of this rank's subdomains that have modes, ascending. Systems and layout must outlive
  /// this object. E is factorized by @p coarse_ranks, see coarse_team(). Collective.
  Deflation(const std::vector<SubdomainSystem> &systems,
            const RowLayout                    &layout,
            const SubdomainTable               &table,
            unsigned int                        coarse_ranks,
            std::vector<RowForces>              raw);

  /// C, F C and E for the present matrices. Collective.
  void update(const std::vector<std::unique_ptr<GeneralizedInverse>> &inverses,
              const std::vector<std::unique_ptr<LocalSchur>>         &schur);

  /// Of all ranks.
  unsigned int n_vectors() const { return n_global; }

  /// x <- x - C E^-1 (F C)'x. @return for each column the square of the F-norm of what was removed.
  /// Collective.
  std::vector<double> remove_from(qp::MultiVector &x) const;

  /// Minimize over the span of C: lambda += C E^-1 C'r, r -= F C E^-1 C'r. Collective.
  void correct(qp::MultiVector &lambda, qp::MultiVector &residual) const;

private:
  /// What a subdomain has of the vectors in whose patch it is.
  struct Part
  {
    std::vector<unsigned int> ids;  ///< of the vectors, ascending
    std::vector<unsigned int> rows; ///< local; those of which it is the lowest subdomain
    qp::MultiVector           C;    ///< on these
    std::vector<BEntry>       B;    ///< on the boundary
    qp::MultiVector           X;    ///< boundary part of K^+ B'C
  };

  /// Per subdomain (global id) for each of its equality rows the global row, the number of its
  /// subdomains and n_modes numbers of G; or, of C, (id, number of rows, (global row, value) of
  /// each) for each vector.
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
  std::vector<unsigned int>           n_copies;  ///< subdomains of each local equality row, or 0
  std::vector<std::set<unsigned int>> wanted_by; ///< ranks, of the rows of each subdomain
  std::vector<Part>                   parts;
  CsrMatrix                           E;
  std::vector<double>                 scale; ///< makes its diagonal 1
  std::shared_ptr<const Team>         team;  ///< of the factor of E
  std::unique_ptr<SparseFactor>       factor;
};
} // namespace snug::feti

#endif
