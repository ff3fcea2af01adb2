#ifndef snug_mesh_file_smooth_surface_h
#define snug_mesh_file_smooth_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace snug::mesh_file {
/**
 * Return the unit tangent at @p x of the curve through the points @p before and @p behind it,
 * nearest first. It points towards the first point behind. The tangent is extrapolated from two
 * circles, each through x and two points, because the error of the tangent of a circle is
 * proportional to the product of the arc lengths to its points. The tangent is exact on circles and
 * otherwise of third order, with only two further points of second order.
 */
template <int dim>
dealii::Tensor<1, dim> curve_tangent(const std::vector<dealii::Point<dim>> &before,
                                     const dealii::Point<dim>              &x,
                                     const std::vector<dealii::Point<dim>> &behind);

/// Return the unit normal at @p x, near @p guess, of the surface through the neighbours. The
/// surface is a cubic, for fewer than 12 neighbours a quadratic, fitted by least squares with
/// weights 1/distance^2.
dealii::Tensor<1, 3> surface_normal(const dealii::Point<3>              &x,
                                    const std::vector<dealii::Point<3>> &neighbours,
                                    const dealii::Tensor<1, 3>          &guess);

/// Return the coefficients of the cubic Curve along @p chord with the unit tangents @p first and
/// @p last. The curve is of sixth order on circles.
template <int dim>
std::array<dealii::Tensor<1, dim>, 2> cubic(const dealii::Tensor<1, dim> &chord,
                                            const dealii::Tensor<1, dim> &first,
                                            const dealii::Tensor<1, dim> &last);
} // namespace snug::mesh_file

#endif
