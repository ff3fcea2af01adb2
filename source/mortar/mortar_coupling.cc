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

/// Return the offset at @p xi, from the @p offsets at the samples. Shape functions and their slopes
/// at the value of xi carry the first derivatives exactly.
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
  const faces::FaceValues<dim, double, mesh::surface_degree> values(mesh::surface_degree, at);
  for (int d = 0; d < dim; ++d)
    {
      result[d] = faces::combination<Number>(
        offsets.size(), [&](unsigned int k) { return values.value[k]; },
        [&](unsigned int k) -> const Number & { return offsets[k][d]; });
      for (int a = 0; a < dim - 1 && !std::is_same<Number, double>::value; ++a)
        result[d] +=
          (xi[a] - at[a]) * faces::combination<double>(
                              offsets.size(), [&](unsigned int k) { return values.gradient[k][a]; },
                              [&](unsigned int k) { return faces::value_of(offsets[k][d]); });
    }
  return result;
}

/// Visit the parts of all integrals over the master face @p f at one point: call add(number,
/// entry), where entry(integrals) is the integral to which the number belongs.
template <int dim, typename Number, typename Add>
void for_each_part(const SegmentQuadrature<dim>    &quadrature,
                   const MortarFace<dim, Number>   &slave,
                   const MortarFace<dim, Number>   &master,
                   const unsigned int               f,
                   const SegmentPoint<dim, Number> &point,
                   const Add                       &add)
{
  const unsigned int n        = slave.nodes.size();
  const bool         linear   = n == 1u << (dim - 1);
  const bool         curved   = !slave.offsets.empty() || !master.offsets.empty();
  const auto        &N_slave  = point.slave_shape.value;
  const auto         N_master = quadrature.shape(point.master).value;
  auto               delta    = offset_at<dim>(master.offsets, point.master);
  const auto         of_slave = offset_at<dim>(slave.offsets, point.slave);
  for (int d = 0; d < dim; ++d)
    delta[d] -= of_slave[d];
  for (unsigned int j = 0; j < n; ++j)
    {
      const Number weighted = point.weight * N_slave[j];
      add(weighted, [&](auto &integrals) -> auto & { return integrals.slave[j]; });
      for (unsigned int l = 0; l < n; ++l)
        {
          const auto weight = [&](auto &integrals) -> auto & { return integrals.weights[f](j, l); };
          const Number both = weighted * N_master[l];
          add(weighted * N_slave[l],
              [&](auto &integrals) -> auto & { return integrals.slave_slave(j, l); });
          add(both, [&](auto &integrals) -> auto & { return integrals.slave_master[f](j, l); });
          add(linear ? both : weighted * N_slave[j] * N_master[l] * N_master[l], weight);
        }
      for (int d = 0; d < dim && curved; ++d)
        add(weighted * delta[d], [&](auto &integrals) -> auto & { return integrals.offset(j, d); });
    }
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
  functions.values.reinit(n, n);
  functions.coefficients.reinit(n, n);
  for (unsigned int k = 0; k < n; ++k)
    {
      dealii::Point<dim - 1> on_face, scaled;
      for (int a = 0; a < dim - 1; ++a)
        {
          const double length = box.upper[a] - box.lower[a];
          on_face[a]          = box.lower[a] + length * nodes[k].point[a];
          scaled[a]           = (nodes[k].point[a] - box.lower[a]) / length;
        }
      const auto of_face = mesh::lagrange_point<dim - 1>(degree, on_face).value;
      const auto of_box  = mesh::lagrange_point<dim - 1>(degree, scaled).value;
      for (unsigned int j = 0; j < n; ++j)
        {
          functions.values(k, j)       = of_face[j];
          functions.coefficients(j, k) = of_box[j];
        }
    }
  return functions;
}

template <typename Number>
FaceIntegrals<Number> in_box(const FaceIntegrals<Number> &integrals,
                             const MultiplierFunctions   &functions)
{
  if (functions.coefficients.empty())
    return integrals;
  const auto           &C = functions.coefficients;
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
  auto result = zero_integrals<dim, Number>(slave.nodes.size(), masters.size());
  for (unsigned int f = 0; f < masters.size(); ++f)
    quadrature.template for_each_point<Number>(slave, masters[f], [&](const auto &compute) {
      for_each_part(quadrature, slave, masters[f], f, compute(),
                    [&](const Number &part, const auto &entry) { entry(result) += part; });
    });
  return result;
}

template <int dim>
void add_integral_derivatives(const SegmentQuadrature<dim>                        &quadrature,
                              const MortarFace<dim, faces::Recorded>              &slave,
                              const std::vector<MortarFace<dim, faces::Recorded>> &masters,
                              const FaceIntegrals<double>                         &slopes,
                              faces::Recording                                    &recording)
{
  for (unsigned int f = 0; f < masters.size(); ++f)
    quadrature.template for_each_point<faces::Recorded>(
      slave, masters[f], [&](const auto &compute) {
        const std::size_t begin = recording.size();
        for_each_part(quadrature, slave, masters[f], f, compute(),
                      [&](const faces::Recorded &part, const auto &entry) {
                        recording.add(part, entry(slopes));
                      });
        recording.sweep_to(begin);
      });
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
          result.multiplier_slave(j, l) = functions.values(j, l) * integrals.slave[j];
    }
  for (const auto &P : integrals.slave_master)
    result.multiplier_master.push_back(product(A, P));
  result.multiplier_offset = product(A, integrals.offset);
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
#define SNUG_INSTANTIATE(dim)                                                                                  \
  template void                add_integral_derivatives(const SegmentQuadrature<dim> &,                        \
                                                        const MortarFace<dim, faces::Recorded> &,              \
                                                        const std::vector<MortarFace<dim, faces::Recorded>> &, \
                                                        const FaceIntegrals<double> &, faces::Recording &);    \
  template MultiplierFunctions functions_on<dim>(CoverBox<dim>, unsigned int, double);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
#define SNUG_INSTANTIATE_NUMBER(Number)                                \
  template FaceIntegrals<Number> in_box(const FaceIntegrals<Number> &, \
                                        const MultiplierFunctions &);  \
  template FaceCoupling<Number>  couple(const FaceIntegrals<Number> &, const MultiplierFunctions &);
SNUG_INSTANTIATE_NUMBER(double)
SNUG_INSTANTIATE_NUMBER(faces::Differential<1>)
SNUG_INSTANTIATE_NUMBER(faces::Recorded)
#undef SNUG_INSTANTIATE_NUMBER
} // namespace snug::mortar
