#include <snug/base/errors.h>
#include <snug/mesh/lagrange.h>
#include <snug/mortar/mortar_coupling.h>

namespace snug::mortar {
namespace {
template <typename Number>
using Matrix = dealii::Table<2, Number>;

/// Return the inverse of a symmetric positive definite matrix.
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
      // is not positive means that the shape functions are dependent on the remaining covered part.
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

/// Return A with psi_j = sum_l A_jl N_l, biorthogonal. A = diag(d) m^-1 makes
/// int psi_j N_l = delta_jl d_j (Wohlmuth, SIAM J. Numer. Anal. 38, 2000). So the row of each
/// multiplier has the displacement of one slave node only.
template <typename Number>
Matrix<Number> dual_coefficients(const FaceIntegrals<Number> &integrals)
{
  Matrix<Number> A = inverse(integrals.slave_slave);
  for (unsigned int j = 0; j < A.n_rows(); ++j)
    for (unsigned int l = 0; l < A.n_cols(); ++l)
      A(j, l) *= integrals.slave[j];
  return A;
}

/// Return A B of small matrices, because dealii::FullMatrix does not support Differential.
template <typename NumberA, typename NumberB>
auto product(const Matrix<NumberA> &A, const Matrix<NumberB> &B)
{
  Matrix<decltype(NumberA() * NumberB())> C(A.n_rows(), B.n_cols());
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

/// Return the offset at @p xi. Value and slopes of the point carry the first derivatives exactly.
template <int dim, typename Number>
std::array<Number, dim> offset_at(const FaceNodes<dim, Number>              &offsets,
                                  const faces::FaceCoordinates<dim, Number> &xi)
{
  if (offsets.empty())
    return {};
  faces::FaceCoordinates<dim, double> at;
  for (int a = 0; a < dim - 1; ++a)
    at[a] = faces::value_of(xi[a]);
  const OffsetPoint<dim, Number> point(offsets, at);
  auto                           result = point.offset;
  for (int d = 0; d < dim; ++d)
    for (int a = 0; a < dim - 1; ++a)
      result[d] += point.slopes[a][d] * (xi[a] - at[a]);
  return result;
}

/// Return whether the covered part is empty, so that there are no dual functions.
template <typename Number>
bool uncovered(const FaceIntegrals<Number> &integrals)
{
  for (const auto &d : integrals.slave)
    if (faces::value_of(d) != 0.)
      return false;
  return true;
}
} // namespace

template <int dim>
MultiplierFunctions
functions_on(CoverBox<dim> box, const unsigned int degree, const double tolerance)
{
  bool whole = true;
  for (int a = 0; a < dim - 1; ++a)
    {
      box.lower[a] = box.lower[a] <= tolerance ? 0. : box.lower[a];
      box.upper[a] = box.upper[a] >= 1. - tolerance ? 1. : box.upper[a];
      whole        = whole && box.lower[a] == 0. && box.upper[a] == 1.;
    }
  MultiplierFunctions functions;
  if (whole)
    return functions;
  const auto         nodes = mesh::lagrange_nodes<dim - 1>(degree);
  const unsigned int n     = nodes.size();
  functions.at.reinit(n, n);
  functions.box.reinit(n, n);
  for (unsigned int k = 0; k < n; ++k)
    {
      dealii::Point<dim - 1> on_face, scaled;
      for (int a = 0; a < dim - 1; ++a)
        {
          const double length = box.upper[a] - box.lower[a];
          on_face[a]          = box.lower[a] + length * nodes[k].point[a];
          scaled[a]           = (nodes[k].point[a] - box.lower[a]) / length;
        }
      const auto at = mesh::lagrange_point<dim - 1>(degree, on_face).value;
      const auto of = mesh::lagrange_point<dim - 1>(degree, scaled).value;
      for (unsigned int j = 0; j < n; ++j)
        {
          functions.at(k, j)  = at[j];
          functions.box(j, k) = of[j];
        }
    }
  return functions;
}

template <typename Number>
FaceIntegrals<Number> in_box(const FaceIntegrals<Number> &integrals,
                             const MultiplierFunctions   &functions)
{
  if (functions.box.empty())
    return integrals;
  const auto           &C = functions.box;
  const unsigned int    n = integrals.slave.size();
  FaceIntegrals<Number> result;
  result.slave.resize(n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int l = 0; l < n; ++l)
      result.slave[j] += C(j, l) * integrals.slave[l];
  result.slave_slave = product(product(C, integrals.slave_slave), transpose(C));
  for (const auto &P : integrals.slave_master)
    result.slave_master.push_back(product(C, P));
  result.offset = product(C, integrals.offset);
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
FaceCoupling<Number> couple(const FaceIntegrals<Number> &of_nodes,
                            const MultiplierFunctions   &functions)
{
  if (!functions.biorthogonal || uncovered(of_nodes))
    return {of_nodes.slave, of_nodes.slave_slave, of_nodes.slave_master, of_nodes.offset};
  const auto           integrals = in_box(of_nodes, functions);
  const unsigned int   n         = integrals.slave.size();
  const Matrix<Number> A         = dual_coefficients(integrals);
  FaceCoupling<Number> result;
  result.multiplier = integrals.slave;
  result.multiplier_slave.reinit(n, n);
  for (unsigned int j = 0; j < n; ++j)
    {
      if (functions.are_nodal())
        result.multiplier_slave(j, j) = integrals.slave[j];
      else
        for (unsigned int l = 0; l < n; ++l)
          result.multiplier_slave(j, l) = functions.at(j, l) * integrals.slave[j];
    }
  for (const auto &P : integrals.slave_master)
    result.multiplier_master.push_back(product(A, P));
  result.multiplier_offset = product(A, integrals.offset);
  return result;
}

namespace {
/// Apply the reverse mode of couple() for biorthogonal functions. A star marks the derivative of
/// the scalar with respect to a matrix. With M = A P: P* = A' M*, A* = sum M* P', and the offset
/// likewise. With A = diag(d) m^-1: d* = diag(A* m^-1), m* = -A' A* m^-1.
FaceIntegrals<double> dual_transpose(const FaceIntegrals<double> &integrals,
                                     const MultiplierFunctions   &functions,
                                     const FaceCoupling<double>  &gradient)
{
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
    for (unsigned int l = 0; l < n; ++l)
      {
        const double at = functions.are_nodal() ? j == l : functions.at(j, l);
        result.slave[j] +=
          at * gradient.multiplier_slave(j, l) + A_gradient(j, l) * m_inverse(l, j);
        result.slave_slave(j, l) *= -1.;
      }
  return result;
}
} // namespace

FaceIntegrals<double> couple_transpose(const FaceIntegrals<double> &integrals,
                                       const MultiplierFunctions   &functions,
                                       const FaceCoupling<double>  &gradient)
{
  if (!functions.biorthogonal || uncovered(integrals))
    return {gradient.multiplier,
            gradient.multiplier_slave,
            gradient.multiplier_master,
            {},
            gradient.multiplier_offset};
  auto to_box = dual_transpose(in_box(integrals, functions), functions, gradient);
  if (functions.are_nodal())
    return to_box;
  // in_box() is linear with the matrix C, so its transpose is in_box() with the matrix C'.
  MultiplierFunctions backwards;
  backwards.box = transpose(functions.box);
  return in_box(to_box, backwards);
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
#define SNUG_INSTANTIATE_NUMBER(Number)                                \
  template FaceIntegrals<Number> in_box(const FaceIntegrals<Number> &, \
                                        const MultiplierFunctions &);  \
  template FaceCoupling<Number>  couple(const FaceIntegrals<Number> &, const MultiplierFunctions &);
SNUG_INSTANTIATE_NUMBER(double)
SNUG_INSTANTIATE_NUMBER(faces::Differential<1>)
#undef SNUG_INSTANTIATE_NUMBER
template MultiplierFunctions functions_on<2>(CoverBox<2>, unsigned int, double);
template MultiplierFunctions functions_on<3>(CoverBox<3>, unsigned int, double);
} // namespace snug::mortar
