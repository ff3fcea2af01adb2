#include <snug/base/assertions.h>
#include <snug/contact/row_derivatives.h>

namespace snug::contact {
namespace {
template <int dim>
dealii::Tensor<1, dim> slope_of(const dealii::Tensor<1, dim, faces::Differential<1>> &v)
{
  dealii::Tensor<1, dim> result;
  for (int d = 0; d < dim; ++d)
    result[d] = v[d].slope[0];
  return result;
}
} // namespace

std::vector<double> slopes_of(const std::vector<faces::Differential<1>> &numbers)
{
  std::vector<double> result;
  for (const auto &number : numbers)
    result.push_back(number.slope[0]);
  return result;
}

template <int dim>
Row<dim> derivative_of(const Row<dim, faces::Differential<1>> &row)
{
  Row<dim> result;
  for (const auto &[node, c] : row.coefficients)
    result.coefficients.emplace_back(node, slope_of(c));
  result.gap    = row.gap.slope[0];
  result.normal = slope_of(row.normal);
  return result;
}

template <int dim>
void add_slopes(const Row<dim, faces::Recorded> &row,
                const RowSlopes<dim>            &slopes,
                faces::Recording                &recording)
{
  SNUG_ASSERT_EQUAL(slopes.coefficients.size(), row.coefficients.size());
  recording.add(row.gap, slopes.gap);
  for (unsigned int k = 0; k < row.coefficients.size(); ++k)
    recording.add(row.coefficients[k].second, slopes.coefficients[k]);
  recording.add(row.normal, slopes.normal);
}

#define SNUG_INSTANTIATE(dim)                                                             \
  template Row<dim> derivative_of(const Row<dim, faces::Differential<1>> &);              \
  template void     add_slopes(const Row<dim, faces::Recorded> &, const RowSlopes<dim> &, \
                               faces::Recording &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
