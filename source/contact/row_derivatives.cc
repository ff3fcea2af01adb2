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
void add_energy_derivatives(const Row<dim, faces::Recorded>          &row,
                            const typename mesh::Surface<dim>::Field &displacement,
                            const double                              force,
                            faces::Recording                         &recording)
{
  recording.add(row.gap, -force);
  for (const auto &[node, c] : row.coefficients)
    for (int d = 0; d < dim; ++d)
      recording.add(c[d], force * displacement[node][d]);
}

#define SNUG_INSTANTIATE(dim)                                                         \
  template Row<dim> derivative_of(const Row<dim, faces::Differential<1>> &);          \
  template void     add_energy_derivatives(const Row<dim, faces::Recorded> &,         \
                                           const mesh::Surface<dim>::Field &, double, \
                                           faces::Recording &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
