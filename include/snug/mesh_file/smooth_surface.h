#ifndef snug_mesh_file_smooth_surface_h
#define snug_mesh_file_smooth_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace snug::mesh_file {
/**
 * Unit tangent at @p x of the curve through points @p before and @p behind it, nearest first;
 * towards the first one behind. Of two circles through x and two points each, whose tangents are
 * off by a multiple of the product of the arc lengths to these, extrapolated: exact on circles, of
 * third order else; of second order through three points.
 */
template <int dim>
dealii::Tensor<1, dim> curve_tangent(const std::vector<dealii::Point<dim>> &before,
                                     const dealii::Point<dim>              &x,
                                     const std::vector<dealii::Point<dim>> &behind);

/// Unit normal at @p x, near @p guess, of the surface through its neighbours: that of a cubic, of
/// a quadratic for fewer than 12, fitted by least squares with weights 1/distance^2.
dealii::Tensor<1, 3> surface_normal(const dealii::Point<3>              &x,
                                    const std::vector<dealii::Point<3>> &neighbours,
                                    const dealii::Tensor<1, 3>          &guess);

/// Coefficients of the Curve over @p chord with the unit tangents @p first and @p last: a cubic,
/// on circles of sixth order.
template <int dim>
std::array<dealii::Tensor<1, dim>, 2> cubic(const dealii::Tensor<1, dim> &chord,
                                            const dealii::Tensor<1, dim> &first,
                                            const dealii::Tensor<1, dim> &last);
} // namespace snug::mesh_file

#endif
