#ifndef snug_feti_subdomain_system_h
#define snug_feti_subdomain_system_h

#include <snug/feti/csr_matrix.h>

#include <vector>

namespace snug::feti {
/// One entry of a subdomain's block of B.
struct BEntry
{
  unsigned int row; ///< local row of the RowLayout
  unsigned int dof;
  double       value;
};

/**
 * The stiffness of one floating subdomain at one geometry. The motion of a rigid body is a
 * subdomain whose unknowns are the amplitudes of its rigid modes: K = 0, and R is the identity.
 *
 * | symbol | meaning                                 | size            |
 * |--------|-----------------------------------------|-----------------|
 * | K      | stiffness, singular [force/length]      | n x n           |
 * | R      | orthonormal rigid body modes, K R = 0   | n x n_modes     |
 * | Z      | R Z = rigid modes of the whole body     | n_modes x n_modes |
 */
struct SubdomainSystem
{
  unsigned int              body    = 0;
  bool                      compact = false; ///< compact shape and cells, hence without soft modes
  CsrMatrix                 K;
  qp::MultiVector           R;
  qp::MultiVector           Z;
  std::vector<unsigned int> fixing_dofs; ///< unknowns of a few far-apart nodes
  /// unknowns with an entry in B, ascending; where the bodies have several positions, in any of
  /// them
  std::vector<unsigned int> boundary;

  unsigned int n_dofs() const { return K.n_rows(); }

  /// Return whether K = 0, which has K^+ = 0.
  bool is_rigid() const { return K.columns().empty(); }

  /// Return 1 / K_ii [length/force]; 0 for K = 0, whose copies have no weight in the
  /// preconditioner.
  double compliance(unsigned int dof) const { return is_rigid() ? 0. : 1. / K.diagonal(dof); }
};

/// B of the subdomains of this rank: gluing, support and contact rows, n_rows x n each.
using ConstraintRows = std::vector<std::vector<BEntry>>;

/// Add B x to @p y for one subdomain. y has local rows, x the unknowns as numbered in @p B.
void add_product(const std::vector<BEntry> &B, const qp::MultiVector &x, qp::MultiVector &y);

/// Add B' x to @p y for one subdomain. x has local rows, y the unknowns as numbered in @p B.
void add_transposed(const std::vector<BEntry> &B, const qp::MultiVector &x, qp::MultiVector &y);

/// One multi-vector per subdomain of this rank. All have the same number of columns, which is known
/// on ranks without subdomains as well.
class PrimalVectors
{
public:
  explicit PrimalVectors(unsigned int n_columns = 1) : columns(n_columns) {}

  /// Append a vector of zeros for the next subdomain.
  void emplace_back(unsigned int n_dofs) { vectors.emplace_back(n_dofs, columns); }

  unsigned int n_columns() const { return columns; }
  std::size_t  size() const { return vectors.size(); }
  bool         empty() const { return vectors.empty(); }

  qp::MultiVector       &operator[](std::size_t s) { return vectors[s]; }
  const qp::MultiVector &operator[](std::size_t s) const { return vectors[s]; }
  qp::MultiVector       &back() { return vectors.back(); }

  std::vector<qp::MultiVector>::const_iterator begin() const { return vectors.begin(); }
  std::vector<qp::MultiVector>::const_iterator end() const { return vectors.end(); }

  /// Return @p n columns from @p first on.
  PrimalVectors columns_from(unsigned int first, unsigned int n) const
  {
    PrimalVectors result(n);
    for (const auto &vector : vectors)
      result.vectors.push_back(vector.columns_from(first, n));
    return result;
  }

  /// Append the columns of @p other.
  void append(const PrimalVectors &other)
  {
    for (std::size_t s = 0; s < size(); ++s)
      vectors[s].append(other[s]);
    columns += other.columns;
  }

  /// Add factor times @p other.
  void add(double factor, const PrimalVectors &other)
  {
    for (std::size_t s = 0; s < size(); ++s)
      vectors[s].add(factor, other[s]);
  }

private:
  unsigned int                 columns;
  std::vector<qp::MultiVector> vectors;
};
} // namespace snug::feti

#endif
