#include <snug/mortar/integral_gradient.h>

namespace snug::mortar {
namespace {
/// A scalar f of the shape functions at one point and its derivatives
/// with respect to the point's face coordinates.
template <int dim>
struct Integrand
{
  double                              value = 0.;
  faces::FaceCoordinates<dim, double> to_slave{}, to_master{};

  /// f = sum_j N_j (d_j + sum_l m_jl N_l + sum_k P_jk N_k)
  Integrand(const FaceIntegrals<double>          &weights,
            const dealii::Table<2, double>       &P,
            const faces::FaceValues<dim, double> &slave,
            const faces::FaceValues<dim, double> &master)
  {
    for (unsigned int j = 0; j < slave.n_nodes; ++j)
      {
        double factor = weights.slave[j], slope = factor;
        for (unsigned int l = 0; l < slave.n_nodes; ++l)
          {
            const auto &m = weights.slave_slave;
            factor += m(j, l) * slave.value[l] + P(j, l) * master.value[l];
            slope += (m(j, l) + m(l, j)) * slave.value[l] + P(j, l) * master.value[l];
            for (int a = 0; a < dim - 1; ++a)
              to_master[a] += slave.value[j] * P(j, l) * master.gradient[l][a];
          }
        value += slave.value[j] * factor;
        for (int a = 0; a < dim - 1; ++a)
          to_slave[a] += slope * slave.gradient[j][a];
      }
  }
};

/// @p nodes as independent variables, the first of which is @p first.
template <int n, int dim>
FaceNodes<dim, faces::Differential<n>> independent(const FaceNodes<dim, double> &nodes,
                                                   unsigned int                  first)
{
  FaceNodes<dim, faces::Differential<n>> result(nodes.size());
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < dim; ++i)
      {
        result[k][i]                            = nodes[k][i];
        result[k][i].slope[first + dim * k + i] = 1.;
      }
  return result;
}

/// int f of one pair of faces, differentiated by the positions of their
/// nodes, those of the slave face first.
template <int n, int dim>
std::array<double, n> pair_gradient(const SegmentQuadrature<dim>   &quadrature,
                                    const FaceNodes<dim, double>   &slave,
                                    const FaceNodes<dim, double>   &master,
                                    const FaceIntegrals<double>    &weights,
                                    const dealii::Table<2, double> &P)
{
  std::array<double, n> gradient{};
  for (const auto &point :
       quadrature.points(independent<n, dim>(slave, 0), independent<n, dim>(master, n / 2)))
    {
      faces::FaceCoordinates<dim, double> xi, eta;
      for (int a = 0; a < dim - 1; ++a)
        {
          xi[a]  = point.slave[a].value;
          eta[a] = point.master[a].value;
        }
      const Integrand<dim> f(weights, P, quadrature.shape(xi), quadrature.shape(eta));
      for (int v = 0; v < n; ++v)
        {
          double slope = 0.;
          for (int a = 0; a < dim - 1; ++a)
            slope +=
              f.to_slave[a] * point.slave[a].slope[v] + f.to_master[a] * point.master[a].slope[v];
          gradient[v] += f.value * point.weight.slope[v] + point.weight.value * slope;
        }
    }
  return gradient;
}

/// The gradient of one slave face with all its masters; n independent variables per pair of faces,
/// half of them the slave's.
template <int n, int dim>
FaceGradient<dim> face_gradient(const SegmentQuadrature<dim>              &quadrature,
                                const FaceNodes<dim, double>              &slave,
                                const std::vector<FaceNodes<dim, double>> &masters,
                                const FaceIntegrals<double>               &weights)
{
  const FaceNodes<dim, double> zero(slave.size());
  FaceGradient<dim>            result;
  result.slave = zero;
  for (unsigned int f = 0; f < masters.size(); ++f)
    {
      const auto gradient =
        pair_gradient<n, dim>(quadrature, slave, masters[f], weights, weights.slave_master[f]);
      result.masters.push_back(zero);
      for (unsigned int k = 0; k < slave.size(); ++k)
        for (int i = 0; i < dim; ++i)
          {
            result.slave[k][i] += gradient[dim * k + i];
            result.masters[f][k][i] = gradient[n / 2 + dim * k + i];
          }
    }
  return result;
}
} // namespace

template <int dim>
FaceGradient<dim> integrate_transpose(const SegmentQuadrature<dim>              &quadrature,
                                      const FaceNodes<dim, double>              &slave,
                                      const std::vector<FaceNodes<dim, double>> &masters,
                                      const FaceIntegrals<double>               &gradient)
{
  // The number of derivatives is a template argument: faces of degree 1 and 2 have 2 or 3 nodes in
  // 2D, 4 or 9 in 3D, dim coordinates each, on two faces.
  const int linear = dim == 2 ? 8 : 24, quadratic = dim == 2 ? 12 : 54;
  if (2 * dim * slave.size() == linear)
    return face_gradient<linear, dim>(quadrature, slave, masters, gradient);
  return face_gradient<quadratic, dim>(quadrature, slave, masters, gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                      \
  template FaceGradient<dim> integrate_transpose<dim>(const SegmentQuadrature<dim> &,              \
                                                      const FaceNodes<dim, double> &,              \
                                                      const std::vector<FaceNodes<dim, double>> &, \
                                                      const FaceIntegrals<double> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
