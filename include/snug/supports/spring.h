#ifndef snug_supports_spring_h
#define snug_supports_spring_h

#include <snug/supports/component.h>

#include <functional>
#include <optional>
#include <string>

namespace snug::supports {
/// Spring between a boundary of a body, or a point on it, and the ground, in one direction.
template <int dim>
struct Spring
{
  unsigned int   body, boundary;
  Component<dim> component;
  /// stiffness per area as a function of the reference position [force / length^3], at a point the
  /// stiffness there [force / length]
  std::function<double(const dealii::Point<dim> &)> stiffness;
  std::optional<dealii::Point<dim>>                 place; ///< reference position of the point
  std::pair<std::string, std::string>               entry; ///< path and value, for messages
  std::string                                       face;  ///< "body.boundary", for results
};
} // namespace snug::supports

#endif
