#ifndef snug_feti_deflation_h
#define snug_feti_deflation_h

#include <snug/feti/coarse_space.h>
#include <snug/feti/neighbourhood_rows.h>
#include <snug/feti/soft_modes.h>
#include <snug/feti/subdomain_factors.h>

#include <map>
#include <memory>
#include <set>

namespace snug::feti {
/// This struct is the part of a Deflation that belongs to a pairing: the row forces of the soft
/// modes, the subdomains that they reach, and the pattern of E.
struct DeflationStructure
{
  /// Take the row forces @p the_raw of those subdomains of this rank that have soft modes, in
  /// ascending order of the subdomains. @p the_coarse must outlive this object. E is factorized by
  /// @p coarse_ranks ranks, see coarse_group(). The vectors are zero on owned rows that are not in
  /// @p rows. Collective.
  DeflationStructure(const CoarseStructure &the_coarse,
                     unsigned int           n_subdomains,
                     std::vector<RowForces> the_raw,
                     unsigned int           coarse_ranks,
                     const qp::RowSet      &rows = {});

  /// The part of a subdomain t in the vectors whose neighbourhood contains t.
  struct Part
  {
    std::vector<unsigned int> ids;       ///< ids of the vectors, ascending
    std::vector<unsigned int> rows;      ///< local rows that have t as their lowest subdomain
    std::set<unsigned int>    wanted_by; ///< ranks of the vectors, which need the rows of t
  };

  const CoarseStructure            &coarse;
  SubdomainRanks                    rank_of;
  std::vector<RowForces>            raw;
  unsigned int                      first_id = 0, n_vectors = 0; ///< of this rank; over all ranks
  std::vector<unsigned int>         multiplicity; ///< subdomains of each local equality row, or 0
  std::vector<Part>                 parts;        ///< of the subdomains of this rank
  std::shared_ptr<const CsrPattern> E;            ///< pattern of E
  FactorPool                        factors{MatrixKind::soft_modes}; ///< factorizations of E

private:
  void count_subdomains(const qp::RowSet &rows);
  void find_parts();
  void build_pattern();
};

/**
 * This class holds the directions C of a Deflation, and F C. A column of C is B_D y for the forces
 * y of a soft mode, made self-equilibrated (G c = 0) by row forces of minimum norm. These act on
 * the rows of the neighbourhood that no subdomain outside the neighbourhood shares. The
 * neighbourhood of a soft mode consists of its subdomain and the neighbours of its subdomain. C is
 * zero on contact rows, so that it lies in every face, and all positions of the bodies share it.
 *
 * Each subdomain t stores, for every vector c whose neighbourhood contains t, its part of c and the
 * values of K^+ B_t'c on its boundary. F C is never assembled.
 */
class DeflationVectors
{
public:
  /// Compute C, F C and E. @p structure must outlive this object. The other arguments are those of
  /// a Linearization. Collective.
  DeflationVectors(const DeflationStructure           &structure,
                   const std::vector<SubdomainSystem> &systems,
                   const ConstraintRows               &B,
                   const FactorsOfSubdomains          &factors);

  /// The data that a subdomain t stores of the vectors whose neighbourhood contains t.
  struct Part
  {
    qp::MultiVector C; ///< values of C on the rows of the part
    qp::MultiVector X; ///< boundary values of K^+ B'C
  };

  const DeflationStructure &structure;
  std::vector<Part>         parts; ///< of the subdomains of this rank

  /// Return E^-1 b.
  qp::MultiVector solve(const qp::MultiVector &b) const;

private:
  /// The value of a vector on a row, as a message to one of the row's subdomains.
  struct Value
  {
    unsigned int subdomain, id, row; ///< global
    double       value;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive & subdomain & id & row & value;
    }
  };

  using Values = std::map<unsigned int, std::vector<Value>>;
  using Copies = std::map<unsigned int, std::vector<RowCopy>>;

  Copies gather_rows(const std::vector<SubdomainSystem> &systems, const ConstraintRows &B) const;
  Values balanced_vectors(const Copies &copies) const;
  qp::MultiVector store(unsigned int               s,
                        unsigned int               n_dofs,
                        const std::vector<BEntry> &B,
                        const std::vector<Value>  &values);
  void            factorize(const std::vector<qp::MultiVector> &products);

  std::vector<double>                 scale; ///< scales the diagonal of E to 1
  std::shared_ptr<const SparseFactor> E;
};

/**
 * This class deflates the dual problem by the directions C, which PCPG then need not find: E = C'FC
 * is factorized, and all other directions are made F-orthogonal to C.
 *
 * Sources: Farhat, Chen, Risler, Roux, A simple and unified framework for accelerating the
 * convergence of iterative substructuring methods with Lagrange multipliers, Int. J. Numer. Meth.
 * Engng 42 (1998).
 */
class Deflation
{
public:
  /// Take the directions for a linearization with @p B, whose layout has the equality rows of the
  /// layout of @p vectors. @p layout must outlive this object.
  Deflation(const RowLayout                        &layout,
            std::shared_ptr<const DeflationVectors> vectors,
            const ConstraintRows                   &B,
            const FactorsOfSubdomains              &factors);

  /// Set x <- x - C E^-1 (F C)'x. @return the square of the F-norm of the removed part, for each
  /// column. Collective.
  std::vector<double> orthogonalize(qp::MultiVector &x) const;

  /// Minimize over the span of C: lambda += C E^-1 C'r, r -= F C E^-1 C'r. Collective.
  void coarse_correction(qp::MultiVector &lambda, qp::MultiVector &residual) const;

private:
  qp::MultiVector multiply(const qp::MultiVector &y) const;

  const RowLayout                        &layout;
  std::shared_ptr<const DeflationVectors> vectors;
  const DeflationStructure               &structure;
  ConstraintRows                          rows; ///< entries of B, numbered on the boundary
};
} // namespace snug::feti

#endif
