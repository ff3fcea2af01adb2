#ifndef snug_shape_entries_h
#define snug_shape_entries_h

#include <snug/shape/shape_parameters.h>
#include <snug/shape/spline.h>

#include <deal.II/base/tensor.h>

#include <sstream>
#include <string>
#include <vector>

namespace snug::shape {
/// "a, b, c" as users write lists, for messages.
template <typename T>
std::string listed(const std::vector<T> &values)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text << (i == 0 ? "" : ", ") << values[i];
  return text.str();
}

/// The entry Direction as a unit vector. @throws InputError
template <int dim>
dealii::Tensor<1, dim> unit_direction(const ShapeParameters &parameters);

/// The net of the entry Control points along @p n_axes axes. @p degree 0:
/// Bernstein polynomials. @throws InputError naming Control points or
/// Degree.
SplineNet spline_net(const ShapeParameters &parameters, unsigned int n_axes, unsigned int degree);

/// Whether each body is in the entry Bodies; an empty one means all.
/// @throws InputError
std::vector<bool> wanted_bodies(const BodyNames &bodies, const ShapeParameters &parameters);
} // namespace snug::shape

#endif
