#include <snug/io/spline_surface.h>

#include <algorithm>

namespace snug::io {
template <int dim>
std::vector<std::pair<unsigned int, double>>
SplineSurface<dim>::functions(const dealii::Tensor<1, dim - 1> &fractions) const
{
  std::vector<std::pair<unsigned int, double>> products = {{0, 1.}};
  unsigned int                                 stride   = 1;
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      const auto                                   along = axes[a].values(fractions[a]);
      std::vector<std::pair<unsigned int, double>> longer;
      for (unsigned int k = 0; k < along.second.size(); ++k)
        for (const auto &[i, value] : products)
          longer.emplace_back(i + stride * ((along.first + k) % axes[a].n()),
                              value * along.second[k]);
      products = longer;
      stride *= axes[a].n();
    }
  return products;
}

template <int dim>
dealii::Tensor<1, dim> SplineSurface<dim>::value(const dealii::Tensor<1, dim - 1> &fractions) const
{
  dealii::Tensor<1, dim> result;
  for (const auto &[i, value] : functions(fractions))
    result += value * points[i];
  return result;
}

template <int dim>
double SplineSurface<dim>::distance(const dealii::Tensor<1, dim>     &x,
                                    const dealii::Tensor<1, dim - 1> &fractions) const
{
  auto                                off = x - value(fractions);
  std::vector<dealii::Tensor<1, dim>> along;
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      auto before = fractions, after = fractions;
      before[a]    = std::max(0., fractions[a] - 1e-5);
      after[a]     = std::min(1., fractions[a] + 1e-5);
      auto tangent = value(after) - value(before);
      for (const auto &other : along)
        tangent -= (tangent * other) * other;
      if (tangent.norm() > 0.)
        along.push_back(tangent / tangent.norm());
    }
  for (const auto &tangent : along)
    off -= (off * tangent) * tangent;
  return off.norm();
}

template <int dim>
unsigned int SplineSurface<dim>::n_points() const
{
  unsigned int result = 1;
  for (const auto &axis : axes)
    result *= axis.n();
  return result;
}

template <int dim>
typename SplineSurface<dim>::Rows SplineSurface<dim>::second_differences() const
{
  Rows         rows;
  unsigned int stride = 1;
  for (const auto &axis : axes)
    {
      const unsigned int n = axis.n();
      for (unsigned int i = 0; i < n_points(); ++i)
        {
          const unsigned int own = i / stride % n;
          if (!axis.is_closed() && (own == 0 || own + 1 == n))
            continue;
          const unsigned int before = (own + n - 1) % n, after = (own + 1) % n;
          const auto         step = [&](const unsigned int from, const unsigned int to) {
            const double difference = axis.greville(to) - axis.greville(from);
            return difference > 0. ? difference : difference + 1.;
          };
          const double       left = step(before, own), right = step(own, after);
          const unsigned int first = i - own * stride;
          rows.push_back({{i, -1.},
                          {first + before * stride, right / (left + right)},
                          {first + after * stride, left / (left + right)}});
        }
      stride *= n;
    }
  return rows;
}

template <int dim>
CoordinatePoints<dim> points_of(const shape::FaceChart<dim>               &chart,
                                const std::vector<dealii::Tensor<1, dim>> &positions)
{
  CoordinatePoints<dim> result;
  result.range = chart.range();
  for (unsigned int a = 0; a < dim - 1; ++a)
    result.closed[a] = chart.is_closed(a);
  result.point = [&](const auto &at) -> std::optional<dealii::Tensor<1, dim>> {
    const auto place = chart.find(at);
    if (!place)
      return {};
    return place->value(positions);
  };
  return result;
}

#define SNUG_INSTANTIATE(dim)                                             \
  template struct SplineSurface<dim>;                                     \
  template CoordinatePoints<dim> points_of(const shape::FaceChart<dim> &, \
                                           const std::vector<dealii::Tensor<1, dim>> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::io
