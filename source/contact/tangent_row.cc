#include <snug/base/assertions.h>
#include <snug/contact/tangent_row.h>

#include <algorithm>
#include <cmath>

namespace snug::contact {
namespace {
/// Squared ratio of spreads below which nodes lie on a line or at a point.
const double least_spread = 1e-6;

template <int dim, typename Number>
using Vector = dealii::Tensor<1, dim, Number>;

/// Return the vector of the length of @p t that is at right angles to @p t and to @p n; zero in 2D.
template <int dim, typename Number>
Vector<dim, Number> across(const Vector<dim, Number> &n, const Vector<dim, Number> &t)
{
  if constexpr (dim == 3)
    return dealii::cross_product_3d(n, t);
  return {};
}

/// The components of the positions of nodes along two vectors t and s of the tangent
/// plane, relative to the mean of the nodes, and their sums of squares.
template <int dim, typename Number>
struct Spread
{
  std::vector<Number> along_t, along_s;
  Number              tt = 0., ts = 0., ss = 0., total = 0.; ///< total: of the positions

  Spread(const std::vector<unsigned int>      &nodes,
         const Vector<dim, Number>            &t,
         const Vector<dim, Number>            &s,
         const faces::PointField<dim, Number> &x)
  {
    // Measure positions from a node, to preserve the digits of differences.
    const auto          origin = x.values()[nodes.front()];
    Vector<dim, Number> mean;
    for (const unsigned int node : nodes)
      mean += (x[node] - origin) / double(nodes.size());
    for (const unsigned int node : nodes)
      {
        const Vector<dim, Number> y = x[node] - origin - mean;
        along_t.push_back(y * t);
        along_s.push_back(y * s);
        tt += along_t.back() * along_t.back();
        ts += along_t.back() * along_s.back();
        ss += along_s.back() * along_s.back();
        total += y * y;
      }
  }
};

/// Return the coefficient of @p node, which is added to the row if it has none.
template <int dim, typename Number>
Vector<dim, Number> &coefficient_of(const unsigned int node, Row<dim, Number> &row)
{
  auto place = std::lower_bound(row.coefficients.begin(), row.coefficients.end(), node,
                                [](const auto &entry, unsigned int n) { return entry.first < n; });
  if (place == row.coefficients.end() || place->first != node)
    place = row.coefficients.insert(place, {node, Vector<dim, Number>()});
  return place->second;
}

/// Return f_b of @p node, which must have a coefficient.
template <int dim, typename Number>
Number factor_of(const unsigned int node, const Row<dim, Number> &row)
{
  const auto place =
    std::lower_bound(row.coefficients.begin(), row.coefficients.end(), node,
                     [](const auto &entry, unsigned int n) { return entry.first < n; });
  SNUG_ASSERT(place != row.coefficients.end() && place->first == node,
              "a couple belongs to another row");
  return place->second * row.normal;
}

/// Add the couple on the nodes of a patch that has the moment of two forces along @p t at the
/// @p distance along the normal of @p row.
template <int dim, typename Number>
void add_couple(const CouplePatch                    &patch,
                const Vector<dim, Number>            &t,
                const Number                         &distance,
                const faces::PointField<dim, Number> &x,
                Row<dim, Number>                     &row)
{
  const Spread<dim, Number> spread(patch.nodes, t, across<dim>(row.normal, t), x);
  // With s = n x t, y = (y.t t + y.s s) / |t|^2, and H has the entries tt, ts and ss over |t|^2
  // in the basis of the unit vectors. The factors of y.t and y.s in beta are:
  const bool   on_line = patch.spread == 1;
  const Number by_t = on_line ? spread.tt : spread.ss, by_s = on_line ? spread.ts : -spread.ts;
  const Number divisor = on_line ? (spread.tt + spread.ss) * (spread.tt + spread.ss)
                                 : spread.tt * spread.ss - spread.ts * spread.ts;
  const Number factor  = distance * (t * t) / divisor;
  for (unsigned int k = 0; k < patch.nodes.size(); ++k)
    coefficient_of(patch.nodes[k], row) +=
      (factor * (by_t * spread.along_t[k] + by_s * spread.along_s[k])) * row.normal;
}
} // namespace

template <int dim, typename Number>
Vector<dim, Number> tangent_direction(const dealii::Tensor<1, dim> &reference,
                                      const Vector<dim, Number>    &n,
                                      const unsigned int            index)
{
  using std::sqrt;
  if constexpr (dim == 2)
    return -dealii::cross_product_2d(n);
  else
    {
      const Vector<dim, Number> part = reference - (n * reference) * n;
      const Vector<dim, Number> t    = part / sqrt(part * part);
      return index == 0 ? t : across<dim>(n, t);
    }
}

template <int dim, typename Number>
Row<dim, Number> tangent_row(const Row<dim, Number>               &row,
                             const Vector<dim, Number>            &t,
                             const TangentFrame<dim>              &frame,
                             const faces::PointField<dim, Number> &x)
{
  const auto       origin = x.values()[row.coefficients.front().first];
  Row<dim, Number> result;
  Number           g = 0.;
  for (const auto &[node, c] : row.coefficients)
    {
      const Number factor = c * row.normal;
      result.coefficients.emplace_back(node, factor * t);
      g -= factor * ((x[node] - origin) * row.normal);
    }
  result.gap    = t * frame.displacement;
  result.normal = row.normal;
  for (const auto &patches : frame.couple)
    {
      Number weights = 0.;
      for (const CouplePatch &patch : patches)
        weights += factor_of(patch.centre, row);
      for (const CouplePatch &patch : patches)
        add_couple(patch, t,
                   -g * factor_of(patch.centre, row) / (double(frame.couple.size()) * weights), x,
                   result);
    }
  return result;
}

template <int dim>
unsigned int tangential_spread(const dealii::Tensor<1, dim>             &normal,
                               const dealii::Tensor<1, dim>             &reference,
                               const std::vector<unsigned int>          &nodes,
                               const typename mesh::Surface<dim>::Field &positions)
{
  if (nodes.empty())
    return 0;
  const auto                t = tangent_direction(reference, normal, 0);
  const Spread<dim, double> spread(nodes, t, across<dim>(normal, t),
                                   faces::PointField<dim, double>(positions));
  const double              trace = spread.tt + spread.ss;
  if (!(trace > least_spread * spread.total))
    return 0;
  return spread.tt * spread.ss - spread.ts * spread.ts > least_spread * trace * trace ? 2 : 1;
}

#define SNUG_INSTANTIATE_NUMBER(dim, Number)                                               \
  template dealii::Tensor<1, dim, Number> tangent_direction(                               \
    const dealii::Tensor<1, dim> &, const dealii::Tensor<1, dim, Number> &, unsigned int); \
  template Row<dim, Number> tangent_row(const Row<dim, Number> &,                          \
                                        const dealii::Tensor<1, dim, Number> &,            \
                                        const TangentFrame<dim> &,                         \
                                        const faces::PointField<dim, Number> &);
#define SNUG_INSTANTIATE(dim)                                                \
  SNUG_INSTANTIATE_NUMBER(dim, double)                                       \
  SNUG_INSTANTIATE_NUMBER(dim, faces::Differential<1>)                       \
  SNUG_INSTANTIATE_NUMBER(dim, faces::Recorded)                              \
  template unsigned int tangential_spread(const dealii::Tensor<1, dim> &,    \
                                          const dealii::Tensor<1, dim> &,    \
                                          const std::vector<unsigned int> &, \
                                          const mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
#undef SNUG_INSTANTIATE_NUMBER
} // namespace snug::contact
