#include <snug/base/run_context.h>
#include <snug/geometry/body_geometry.h>
#include <snug/mesh/cell_shape.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::mesh {
template <int dim>
CellShape<dim>::CellShape(
  const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &position)
{
  for (unsigned int d = 0; d < dim; ++d)
    {
      auto low = geometry::unit_centre<dim>(), high = low;
      low[d]  = 0.;
      high[d] = 1.;
      axes[d] = position(high) - position(low);
    }
}

template <>
double CellShape<2>::section(const unsigned int axis) const
{
  return axes[1 - axis].norm();
}

template <>
double CellShape<3>::section(const unsigned int axis) const
{
  return dealii::cross_product_3d(axes[(axis + 1) % 3], axes[(axis + 2) % 3]).norm();
}

template <int dim>
bool CellShape<dim>::is_slender() const
{
  std::array<double, dim> lengths;
  std::transform(axes.begin(), axes.end(), lengths.begin(),
                 [](const auto &axis) { return axis.norm(); });
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  return *longest > compact_aspect * *shortest;
}

template <int dim>
std::vector<std::vector<CellShape<dim>>>
shapes_of_bodies(const std::size_t                                               n_bodies,
                 const MPI_Comm                                                  communicator,
                 const std::function<std::vector<CellShape<dim>>(unsigned int)> &of_body)
{
  std::vector<std::vector<CellShape<dim>>> result;
  throw_collectively(communicator, [&]() {
    for (unsigned int body = 0; body < n_bodies; ++body)
      result.push_back(of_body(body));
  });
  return result;
}

template <int dim>
unsigned long count_slender(const std::vector<CellShape<dim>> &shapes, const MPI_Comm communicator)
{
  const unsigned long n = std::count_if(shapes.begin(), shapes.end(),
                                        [](const auto &shape) { return shape.is_slender(); });
  return dealii::Utilities::MPI::sum(n, communicator);
}

#define SNUG_INSTANTIATE(dim)                                                                 \
  template class CellShape<dim>;                                                              \
  template std::vector<std::vector<CellShape<dim>>> shapes_of_bodies(                         \
    std::size_t, MPI_Comm, const std::function<std::vector<CellShape<dim>>(unsigned int)> &); \
  template unsigned long count_slender(const std::vector<CellShape<dim>> &, MPI_Comm);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::mesh
