#include <snug/base/errors.h>
#include <snug/mesh/lagrange.h>
#include <snug/mortar/mortar_coupling.h>

namespace snug::mortar {
namespace {
template <typename Number>
using Matrix = dealii::Table<2, Number>;

/// The inverse of a symmetric positive definite matrix.
template <typename Number>
Matrix<Number> inverse(Matrix<Number> m)
{
  const unsigned int n = m.n_rows();
  Matrix<Number>     result(n, n);
  for (unsigned int i = 0; i < n; ++i)
    result(i, i) = 1.;
  for (unsigned int p = 0; p < n; ++p)
    {
      // Gauss-Jordan without pivoting is safe for the Gram matrix of shape functions. A pivot that
      // is not positive means that they are dependent on what is left of the covered part.
      if (!(faces::value_of(m(p, p)) > 0.))
        throw TangledMesh("the master side has moved away from a slave "
                          "face that it was opposite to");
      const Number pivot = 1. / m(p, p);
      for (unsigned int j = 0; j < n; ++j)
        {
          m(p, j) *= pivot;
          result(p, j) *= pivot;
        }
      for (unsigned int i = 0; i < n; ++i)
        if (i != p)
          {
            const Number factor = m(i, p);
            for (unsigned int j = 0; j < n; ++j)
              {
                m(i, j) -= factor * m(p, j);
                result(i, j) -= factor * result(p, j);
              }
          }
    }
  return result;
}

/// A with psi_j = sum_l A_jl N_l, biorthogonal.
/// Wohlmuth, SIAM J. Numer. Anal. 38, 2000: A = diag(d) m^-1 makes int psi_j N_l = delta_jl d_j, so
/// that each multiplier's row has the displacement of one slave node only.
template <typename Number>
Matrix<Number> dual_coefficients(const FaceIntegrals<Number> &integrals)
{
  Matrix<Number> A = inverse(integrals.slave_slave);
  for (unsigned int j = 0; j < A.n_rows(); ++j)
    for (unsigned int l = 0; l < A.n_cols(); ++l)
      A(j, l) *= integrals.slave[j];
  return A;
}

/// dealii::FullMatrix knows no Differential; these are small.
template <typename Number>
Matrix<Number> product(const Matrix<Number> &A, const Matrix<Number> &B)
{
  Matrix<Number> C(A.n_rows(), B.n_cols());
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    for (unsigned int j = 0; j < B.n_cols(); ++j)
      for (unsigned int k = 0; k < A.n_cols(); ++k)
        C(i, j) += A(i, k) * B(k, j);
  return C;
}

Matrix<double> transpose(const Matrix<double> &A)
{
  Matrix<double> result(A.n_cols(), A.n_rows());
  for (unsigned int i = 0; i < A.n_rows(); ++i)
    for (unsigned int j = 0; j < A.n_cols(); ++j)
      result(j, i) = A(i, j);
  return result;
}

/// Is there nothing to build dual functions on?
template <typename Number>
bool uncovered(const FaceIntegrals<Number> &integrals)
{
  for (const auto &d : integrals.slave)
    if (faces::value_of(d) != 0.)
      return false;
  return true;
}
} // namespace

template <int dim, typename Number>
std::array<Number, dim> offset_at(const FaceNodes<dim, Number>              &offsets,
                                  const faces::FaceCoordinates<dim, Number> &xi)
{
  std::array<Number, dim> result{};
  if (offsets.empty())
    return result;
  faces::FaceCoordinates<dim, double> at;
  for (int a = 0; a < dim - 1; ++a)
    at[a] = faces::value_of(xi[a]);
  constexpr unsigned int                       degree = mesh::surface_degree;
  const faces::FaceValues<dim, double, degree> values(degree, at);
  // The polynomial's value and slope carry first derivatives exactly.
  for (unsigned int k = 0; k < offsets.size(); ++k)
    {
      Number value = values.value[k];
      for (int a = 0; a < dim - 1; ++a)
        value += values.gradient[k][a] * (xi[a] - at[a]);
      for (int d = 0; d < dim; ++d)
        result[d] += value * offsets[k][d];
    }
  return result;
}

template <int dim, typename Number>
FaceIntegrals<Number> integrate(const SegmentQuadrature<dim>               &quadrature,
                                const MortarFace<dim, Number>              &slave,
                                const std::vector<MortarFace<dim, Number>> &masters)
{
  const unsigned int    n      = slave.nodes.size();
  const bool            linear = n == 1u << (dim - 1);
  FaceIntegrals<Number> result;
  result.slave.resize(n);
  result.slave_slave.reinit(n, n);
  result.offset.reinit(n, dim);
  for (const auto &master : masters)
    {
      Matrix<Number> P(n, n), W(n, n);
      const bool     curved = !slave.offsets.empty() || !master.offsets.empty();
      for (const auto &point : quadrature.points(slave.nodes, master.nodes))
        {
          const auto N_slave  = quadrature.shape(point.slave).value;
          const auto N_master = quadrature.shape(point.master).value;
          auto       delta    = offset_at<dim>(master.offsets, point.master);
          const auto of_slave = offset_at<dim>(slave.offsets, point.slave);
          for (int d = 0; d < dim; ++d)
            delta[d] -= of_slave[d];
          for (unsigned int j = 0; j < n; ++j)
            {
              const Number weighted = point.weight * N_slave[j];
              result.slave[j] += weighted;
              for (unsigned int l = 0; l < n; ++l)
                {
                  result.slave_slave(j, l) += weighted * N_slave[l];
                  P(j, l) += weighted * N_master[l];
                  if (!linear)
                    W(j, l) += weighted * N_slave[j] * N_master[l] * N_master[l];
                }
              for (int d = 0; d < dim && curved; ++d)
                result.offset(j, d) += weighted * delta[d];
            }
        }
      result.weights.push_back(linear ? P : W);
      result.slave_master.push_back(P);
    }
  return result;
}

template <typename Number>
FaceCoupling<Number> couple(const FaceIntegrals<Number> &integrals, bool biorthogonal)
{
  if (!biorthogonal || uncovered(integrals))
    return {integrals.slave, integrals.slave_slave, integrals.slave_master, integrals.offset};
  const unsigned int   n = integrals.slave.size();
  const Matrix<Number> A = dual_coefficients(integrals);
  FaceCoupling<Number> result;
  result.multiplier = integrals.slave;
  result.multiplier_slave.reinit(n, n);
  for (unsigned int j = 0; j < n; ++j)
    result.multiplier_slave(j, j) = integrals.slave[j];
  for (const auto &P : integrals.slave_master)
    result.multiplier_master.push_back(product(A, P));
  result.multiplier_offset = product(A, integrals.offset);
  return result;
}

FaceIntegrals<double> couple_transpose(const FaceIntegrals<double> &integrals,
                                       bool                         biorthogonal,
                                       const FaceCoupling<double>  &gradient)
{
  if (!biorthogonal || uncovered(integrals))
    return {gradient.multiplier,
            gradient.multiplier_slave,
            gradient.multiplier_master,
            {},
            gradient.multiplier_offset};
  // Reverse mode of couple(): a star marks the derivative of the scalar by a matrix.
  // with M = A P: P* = A' M*, A* = sum M* P', as for the offset; with A = diag(d) m^-1:
  // d* = diag(A* m^-1), m* = -A' A* m^-1
  const unsigned int    n         = integrals.slave.size();
  const Matrix<double>  m_inverse = inverse(integrals.slave_slave);
  const Matrix<double>  A         = dual_coefficients(integrals);
  const Matrix<double>  At        = transpose(A);
  Matrix<double>        A_gradient(n, n);
  FaceIntegrals<double> result;
  for (unsigned int f = 0; f < integrals.slave_master.size(); ++f)
    {
      const auto &M       = gradient.multiplier_master[f];
      const auto  of_face = product(M, transpose(integrals.slave_master[f]));
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          A_gradient(i, j) += of_face(i, j);
      result.slave_master.push_back(product(At, M));
    }
  const auto by_offset = product(gradient.multiplier_offset, transpose(integrals.offset));
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      A_gradient(i, j) += by_offset(i, j);
  result.offset      = product(At, gradient.multiplier_offset);
  const auto A_m     = product(A_gradient, m_inverse);
  result.slave_slave = product(At, A_m);
  result.slave       = gradient.multiplier;
  for (unsigned int j = 0; j < n; ++j)
    {
      result.slave[j] += gradient.multiplier_slave(j, j);
      for (unsigned int l = 0; l < n; ++l)
        {
          result.slave[j] += A_gradient(j, l) * m_inverse(l, j);
          result.slave_slave(j, l) *= -1.;
        }
    }
  return result;
}

#define SNUG_INSTANTIATE(dim, Number)                                            \
  template FaceIntegrals<Number> integrate<dim>(const SegmentQuadrature<dim> &,  \
                                                const MortarFace<dim, Number> &, \
                                                const std::vector<MortarFace<dim, Number>> &);
SNUG_INSTANTIATE(2, double)
SNUG_INSTANTIATE(2, faces::Differential<1>)
SNUG_INSTANTIATE(3, double)
SNUG_INSTANTIATE(3, faces::Differential<1>)
#undef SNUG_INSTANTIATE
template std::array<double, 2>                offset_at<2>(const FaceNodes<2, double> &,
                                            const faces::FaceCoordinates<2, double> &);
template std::array<double, 3>                offset_at<3>(const FaceNodes<3, double> &,
                                            const faces::FaceCoordinates<3, double> &);
template FaceCoupling<double>                 couple(const FaceIntegrals<double> &, bool);
template FaceCoupling<faces::Differential<1>> couple(const FaceIntegrals<faces::Differential<1>> &,
                                                     bool);
} // namespace snug::mortar
