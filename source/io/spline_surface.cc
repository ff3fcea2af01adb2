#include <snug/io/spline_surface.h>

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

template struct SplineSurface<2>;
template struct SplineSurface<3>;
} // namespace snug::io
