#include <snug/geometry/body_geometry.h>
#include <snug/mesh/cell_shape.h>

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

template class CellShape<2>;
template class CellShape<3>;
} // namespace snug::mesh
