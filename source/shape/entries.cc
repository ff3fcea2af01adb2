#include <snug/base/errors.h>
#include <snug/shape/entries.h>

#include <algorithm>
#include <cmath>

namespace snug::shape {
/// Of unit length, so that variables and bounds are lengths.
template <int dim>
dealii::Tensor<1, dim> unit_direction(const ShapeParameters &parameters)
{
  const auto            &components = parameters.direction;
  dealii::Tensor<1, dim> direction;
  if (components.size() == dim)
    for (unsigned int d = 0; d < dim; ++d)
      direction[d] = components[d];
  const double length = direction.norm();
  // Written so that NaN is refused as well.
  if (!(length > 0.) || !std::isfinite(length))
    throw bad_entry(parameters.path("Direction"), listed(components),
                    "must be empty or " + std::to_string(dim) + " numbers, not all zero");
  return direction / length;
}

SplineNet
spline_net(const ShapeParameters &parameters, const unsigned int n_axes, const unsigned int degree)
{
  // Bernstein polynomials of higher degree lose all digits.
  const unsigned int least = degree == 0 ? 1 : degree + 1;
  const unsigned int most  = degree == 0 ? 50 : 1000000;
  const auto        &n     = parameters.control_points;
  bool               good  = n.size() == n_axes;
  for (const unsigned int number : n)
    good = good && number >= least && number <= most;
  if (!good)
    throw bad_entry(parameters.path("Control points"), listed(n),
                    "must be " + std::to_string(n_axes) +
                      (n_axes == 1 ? " number" : " numbers, each") + " from " +
                      std::to_string(least) + " to " + std::to_string(most) +
                      (degree == 0 ? "" : ": at least one more than 'Degree'"));
  return SplineNet(n, degree);
}

/// The error lists the bodies there are.
std::vector<bool> wanted_bodies(const BodyNames &bodies, const ShapeParameters &parameters)
{
  std::vector<bool> result(bodies.names.size(), parameters.bodies.empty());
  for (const auto &name : parameters.bodies)
    {
      const auto found = std::find(bodies.names.begin(), bodies.names.end(), name);
      if (found == bodies.names.end())
        throw bad_entry(parameters.path("Bodies"), listed(parameters.bodies),
                        "there is no body '" + name + "', there are " + listed(bodies.names));
      result[found - bodies.names.begin()] = true;
    }
  return result;
}

template dealii::Tensor<1, 2> unit_direction(const ShapeParameters &);
template dealii::Tensor<1, 3> unit_direction(const ShapeParameters &);
} // namespace snug::shape
