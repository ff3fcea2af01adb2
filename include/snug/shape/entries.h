#ifndef snug_shape_entries_h
#define snug_shape_entries_h

#include <snug/base/values.h>
#include <snug/shape/shape_parameters.h>
#include <snug/shape/spline.h>

#include <deal.II/base/tensor.h>

namespace snug::shape {
/// Return the entry Direction or Axis as a unit vector. @throws InputError
template <int dim>
dealii::Tensor<1, dim> unit_direction(const ShapeParameters &parameters,
                                      const std::string     &entry = "Direction");

/// Return the net with the entry Control points along @p n_axes axes. @p degree 0 means
/// Bernstein polynomials. @throws InputError naming Control points, Degree or Basis.
SplineNet spline_net(const ShapeParameters               &parameters,
                     unsigned int                         n_axes,
                     unsigned int                         degree,
                     const std::vector<SplineAxis::Ends> &ends = {});

/// Check that the values of the entry Initial lie within the entry Bounds. @throws InputError
void require_bounds(const ShapeParameters &parameters);

/// Return the entries Box corner and Box size. @throws InputError
template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>> box_of(const ShapeParameters &parameters);

/// Return, for each body, whether the entry Bodies names the body. An empty entry means all
/// bodies. @throws InputError
std::vector<bool> wanted_bodies(const BodyNames &bodies, const ShapeParameters &parameters);
} // namespace snug::shape

#endif
