#include <snug/mortar/integral_gradient.h>

namespace snug::mortar {
namespace {
/// Derivatives of a scalar with respect to the integrals of one pair of faces.
struct PairWeights
{
  const FaceIntegrals<double>    &whole;
  const dealii::Table<2, double> &P, &W;
};

/// A scalar f of the shape functions and offsets at one point, with its derivatives with respect to
/// the face coordinates of the point.
template <int dim>
struct Integrand
{
  double                              value = 0.;
  faces::FaceCoordinates<dim, double> to_slave{}, to_master{};
  std::array<double, dim>             to_offset{}; ///< with respect to delta

  /// Compute f = sum_j N_j (d_j + sum_l m_jl N_l + sum_k P_jk N_k + sum_c o_jc delta_c)
  ///             + sum_jk W_jk (N_j N_k)^p and its derivatives.
  Integrand(const PairWeights                    &weights,
            const faces::FaceValues<dim, double> &slave,
            const faces::FaceValues<dim, double> &master,
            const std::array<double, dim>        &delta)
  {
    const unsigned int n      = slave.n_nodes;
    const bool         linear = n == 1u << (dim - 1);
    const auto        &m      = weights.whole.slave_slave;
    for (unsigned int j = 0; j < n; ++j)
      {
        double factor = weights.whole.slave[j], slope = factor;
        for (int c = 0; c < dim; ++c)
          {
            const double o = weights.whole.offset(j, c);
            factor += o * delta[c];
            slope += o * delta[c];
            to_offset[c] += slave.value[j] * o;
          }
        for (unsigned int l = 0; l < n; ++l)
          {
            // For p = 2, the derivative of (N_j N_l)^p with respect to N_j or N_l is twice the half
            // factor.
            const double product = slave.value[j] * master.value[l];
            const double W       = weights.W(j, l) * (linear ? 1. : 2. * product);
            const double PW      = weights.P(j, l) + W;
            factor += m(j, l) * slave.value[l] +
                      (weights.P(j, l) + (linear ? W : 0.5 * W)) * master.value[l];
            slope += (m(j, l) + m(l, j)) * slave.value[l] + PW * master.value[l];
            for (int a = 0; a < dim - 1; ++a)
              to_master[a] += slave.value[j] * PW * master.gradient[l][a];
          }
        value += slave.value[j] * factor;
        for (int a = 0; a < dim - 1; ++a)
          to_slave[a] += slope * slave.gradient[j][a];
      }
  }
};

/// Return @p nodes as independent variables, the first of which has the index @p first.
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

/// Add the derivatives of a scalar with respect to the coordinates of a point and to the offsets at
/// the samples. @p to_offset is the derivative of the scalar with respect to the offset at the
/// point.
template <int dim>
void add_offset_slopes(const OffsetPoint<dim, double>      &at,
                       const std::array<double, dim>       &to_offset,
                       const double                         weight,
                       faces::FaceCoordinates<dim, double> &to_xi,
                       FaceNodes<dim, double>              &to_samples)
{
  for (int d = 0; d < dim; ++d)
    {
      for (int a = 0; a < dim - 1; ++a)
        to_xi[a] += to_offset[d] * at.slopes[a][d];
      for (unsigned int k = 0; k < to_samples.size(); ++k)
        to_samples[k][d] += to_offset[d] * weight * at.values.value[k];
    }
}

/// Return the gradient of int f of one pair of faces with respect to the positions of their nodes,
/// those of the slave face first. Add the derivatives with respect to the offsets to @p to_slave
/// and @p to_master.
template <int n, int dim>
std::array<double, n> pair_gradient(const SegmentQuadrature<dim>  &quadrature,
                                    const MortarFace<dim, double> &slave,
                                    const MortarFace<dim, double> &master,
                                    const PairWeights             &weights,
                                    FaceNodes<dim, double>        &to_slave,
                                    FaceNodes<dim, double>        &to_master)
{
  std::array<double, n> gradient{};
  for (const auto &point : quadrature.points(independent<n, dim>(slave.nodes, 0),
                                             independent<n, dim>(master.nodes, n / 2)))
    {
      faces::FaceCoordinates<dim, double> xi, eta;
      for (int a = 0; a < dim - 1; ++a)
        {
          xi[a]  = point.slave[a].value;
          eta[a] = point.master[a].value;
        }
      const OffsetPoint<dim, double> on_slave(slave.offsets, xi), on_master(master.offsets, eta);
      std::array<double, dim>        delta = on_master.offset;
      for (int d = 0; d < dim; ++d)
        delta[d] -= on_slave.offset[d];
      Integrand<dim> f(weights, quadrature.shape(xi), quadrature.shape(eta), delta);
      add_offset_slopes<dim>(on_master, f.to_offset, point.weight.value, f.to_master, to_master);
      // The offset of the slave has a minus sign in delta.
      for (double &slope : f.to_offset)
        slope = -slope;
      add_offset_slopes<dim>(on_slave, f.to_offset, point.weight.value, f.to_slave, to_slave);
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

/// Return the gradient of one slave face with all its masters. Each pair of faces has n independent
/// variables, and half of them belong to the slave.
template <int n, int dim>
FaceGradient<dim> face_gradient(const SegmentQuadrature<dim>               &quadrature,
                                const MortarFace<dim, double>              &slave,
                                const std::vector<MortarFace<dim, double>> &masters,
                                const FaceIntegrals<double>                &weights)
{
  const auto zero = [](const MortarFace<dim, double> &face) {
    return MortarFace<dim, double>{FaceNodes<dim, double>(face.nodes.size()),
                                   FaceNodes<dim, double>(face.offsets.size())};
  };
  FaceGradient<dim> result;
  result.slave = zero(slave);
  for (unsigned int f = 0; f < masters.size(); ++f)
    {
      result.masters.push_back(zero(masters[f]));
      const auto gradient =
        pair_gradient<n, dim>(quadrature, slave, masters[f],
                              {weights, weights.slave_master[f], weights.weights[f]},
                              result.slave.offsets, result.masters[f].offsets);
      for (unsigned int k = 0; k < slave.nodes.size(); ++k)
        for (int i = 0; i < dim; ++i)
          {
            result.slave.nodes[k][i] += gradient[dim * k + i];
            result.masters[f].nodes[k][i] = gradient[n / 2 + dim * k + i];
          }
    }
  return result;
}
} // namespace

template <int dim>
FaceGradient<dim> integrate_transpose(const SegmentQuadrature<dim>               &quadrature,
                                      const MortarFace<dim, double>              &slave,
                                      const std::vector<MortarFace<dim, double>> &masters,
                                      const FaceIntegrals<double>                &gradient)
{
  // The number of derivatives is a template argument. Faces of degree 1 and 2 have 2 or 3 nodes in
  // 2D and 4 or 9 nodes in 3D, with dim coordinates each, on two faces.
  const int linear = dim == 2 ? 8 : 24, quadratic = dim == 2 ? 12 : 54;
  if (2 * dim * slave.nodes.size() == linear)
    return face_gradient<linear, dim>(quadrature, slave, masters, gradient);
  return face_gradient<quadratic, dim>(quadrature, slave, masters, gradient);
}

#define SNUG_INSTANTIATE(dim)                                        \
  template FaceGradient<dim> integrate_transpose<dim>(               \
    const SegmentQuadrature<dim> &, const MortarFace<dim, double> &, \
    const std::vector<MortarFace<dim, double>> &, const FaceIntegrals<double> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
