#ifndef snug_tests_unit_feti_truss_block_h
#define snug_tests_unit_feti_truss_block_h

#include <snug/feti/subdomain_system.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::test {
using Matrix = dealii::FullMatrix<double>;
using Node   = std::vector<int>; ///< grid coordinates, 2 or 3

inline Matrix product(const Matrix &A, const Matrix &B)
{
  Matrix C(A.m(), B.n());
  A.mmult(C, B);
  return C;
}

inline Matrix transposed(const Matrix &A)
{
  Matrix T(A.n(), A.m());
  T.copy_transposed(A);
  return T;
}

/// A block of a pin-jointed truss: grid nodes first..last, bars to all
/// neighbours of the same cell. Rigid but for its 3 or 6 motions.
struct Block
{
  unsigned int      body;
  Node              first, last;
  std::vector<Node> nodes;
  double            height; ///< of a cell; flat ones bend easily

  Block(unsigned int body, const Node &first, const Node &last, double height = 1.);

  unsigned int        slot(const Node &node) const;
  std::vector<double> position(const Node &node) const;
};

inline Block::Block(unsigned int body, const Node &first, const Node &last, double height)
  : body(body), first(first), last(last), height(height)
{
  nodes = {first};
  for (unsigned int d = 0; d < first.size(); ++d)
    {
      const auto start = nodes;
      for (int i = first[d] + 1; i <= last[d]; ++i)
        for (auto node : start)
          {
            node[d] = i;
            nodes.push_back(node);
          }
    }
}

inline unsigned int Block::slot(const Node &node) const
{
  return std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
}

/// Slightly bent, so that nothing is symmetric by chance.
inline std::vector<double> Block::position(const Node &node) const
{
  std::vector<double> x(node.begin(), node.end());
  for (unsigned int d = 0; d < x.size(); ++d)
    x[d] += 0.1 * std::sin(1.3 * node[0] + 0.7 * node[1] + d);
  x.back() *= height;
  return x;
}

inline Matrix dense_stiffness(const Block &block)
{
  const unsigned int dim = block.first.size();
  Matrix             K(dim * block.nodes.size(), dim * block.nodes.size());
  for (unsigned int a = 0; a < block.nodes.size(); ++a)
    for (unsigned int b = 0; b < a; ++b)
      {
        bool same_cell = true;
        for (unsigned int d = 0; d < dim; ++d)
          same_cell = same_cell && std::abs(block.nodes[a][d] - block.nodes[b][d]) <= 1;
        if (!same_cell)
          continue;
        const auto x      = block.position(block.nodes[a]);
        const auto y      = block.position(block.nodes[b]);
        double     square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += (x[d] - y[d]) * (x[d] - y[d]);
        const double stiffness = (100. + 10. * block.body) / square;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              const double k = stiffness * (x[i] - y[i]) * (x[j] - y[j]) / square;
              K(dim * a + i, dim * a + j) += k;
              K(dim * b + i, dim * b + j) += k;
              K(dim * a + i, dim * b + j) -= k;
              K(dim * b + i, dim * a + j) -= k;
            }
      }
  return K;
}

/// Translations and rotations about @p centre, column by column.
inline qp::MultiVector rigid_motions(const Block &block, const std::vector<double> &centre)
{
  const unsigned int dim = centre.size();
  qp::MultiVector    R(dim * block.nodes.size(), dim == 2 ? 3 : 6);
  for (unsigned int a = 0; a < block.nodes.size(); ++a)
    {
      auto x = block.position(block.nodes[a]);
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[d] -= centre[d];
          R(dim * a + d, d) = 1.;
        }
      for (unsigned int r = 0; r < (dim == 2 ? 1u : 3u); ++r)
        {
          const unsigned int i    = dim == 2 ? 0 : (r + 1) % 3;
          const unsigned int j    = dim == 2 ? 1 : (r + 2) % 3;
          R(dim * a + i, dim + r) = -x[j];
          R(dim * a + j, dim + r) = x[i];
        }
    }
  return R;
}

inline void orthonormalise(qp::MultiVector &R)
{
  for (unsigned int j = 0; j < 2 * R.n_columns(); ++j)
    {
      const unsigned int column = j % R.n_columns();
      for (unsigned int k = 0; k <= column; ++k)
        {
          double product = 0.;
          for (unsigned int i = 0; i < R.n_rows(); ++i)
            product += R(i, column) * R(i, k);
          for (unsigned int i = 0; i < R.n_rows(); ++i)
            R(i, column) =
              k < column ? R(i, column) - product * R(i, k) : R(i, column) / std::sqrt(product);
        }
    }
}

/// The system of one block without rows of B; the punch (body 1) has
/// weight.
inline feti::SubdomainSystem truss_system(const Block               &block,
                                          const std::vector<double> &centre_of_body)
{
  const unsigned int    dim = centre_of_body.size();
  const Matrix          K   = dense_stiffness(block);
  feti::SubdomainSystem system;
  system.body = block.body;
  std::vector<std::vector<PetscInt>> columns(K.m());
  for (unsigned int i = 0; i < K.m(); ++i)
    for (unsigned int j = 0; j < K.m(); ++j)
      if (K(i, j) != 0.)
        columns[i].push_back(j);
  system.K = feti::CsrMatrix::from_rows(columns, K.m());
  for (unsigned int i = 0; i < K.m(); ++i)
    for (const PetscInt j : columns[i])
      system.K.values[system.K.position(i, j)] = K(i, j);
  system.R = rigid_motions(block, block.position(block.nodes[0]));
  orthonormalise(system.R);
  system.Z = qp::transpose_times(system.R, rigid_motions(block, centre_of_body));
  const std::set<unsigned int> corners = {0, block.slot(block.last), block.slot([&]() {
                                            Node corner = block.first;
                                            corner[0]   = block.last[0];
                                            return corner;
                                          }()),
                                          block.slot([&]() {
                                            Node corner = block.last;
                                            corner[0]   = block.first[0];
                                            return corner;
                                          }())};
  for (const unsigned int corner : corners)
    for (unsigned int d = 0; d < dim; ++d)
      system.fixing_dofs.push_back(dim * corner + d);
  return system;
}

/// Loads of the punch.
inline qp::MultiVector truss_loads(const Block &block, const unsigned int dim)
{
  qp::MultiVector f(dim * block.nodes.size());
  for (unsigned int a = 0; a < block.nodes.size(); ++a)
    if (block.body == 1)
      f(dim * a + dim - 1) = -1. - 0.1 * (a % 3);
  return f;
}
} // namespace snug::test

#endif
