#ifndef snug_geometry_extents_h
#define snug_geometry_extents_h

#include <deal.II/base/point.h>

#include <string>

namespace snug::geometry {
/// Return the extents of a box as text, such as "x 0 to 1, y 2". Numbers that are round-off,
/// relative to the @p size of the body, are shown as 0.
template <int dim>
std::string extents(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper, double size);
} // namespace snug::geometry

#endif
