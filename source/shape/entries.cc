#include <snug/base/errors.h>
#include <snug/shape/entries.h>

#include <algorithm>
#include <cmath>

namespace snug::shape {
/// The direction has unit length, so that variables and bounds are lengths.
template <int dim>
dealii::Tensor<1, dim> unit_direction(const ShapeParameters &parameters, const std::string &entry)
{
  const auto            &components = entry == "Axis" ? parameters.axis : parameters.direction;
  dealii::Tensor<1, dim> direction;
  if (components.size() == dim)
    for (unsigned int d = 0; d < dim; ++d)
      direction[d] = components[d];
  const double length = direction.norm();
  // The negated comparison rejects NaN as well.
  if (!(length > 0.) || !std::isfinite(length))
    throw bad_entry(parameters.path(entry), to_text(components),
                    "must be empty or " + std::to_string(dim) + " numbers, not all zero");
  return direction / length;
}

SplineNet spline_net(const ShapeParameters               &parameters,
                     const unsigned int                   n_axes,
                     const unsigned int                   degree,
                     const std::vector<SplineAxis::Ends> &ends)
{
  const auto &n       = parameters.control_points;
  const auto  require = [&](const bool good, const std::string &allowed) {
    if (!good)
      throw bad_entry(parameters.path("Control points"), to_text(n), allowed);
  };
  require(n.size() == n_axes, "must have " + to_text(n_axes) +
                                (n_axes == 1 ? " number" : " numbers separated by commas") +
                                ", one per edge of the face or box");
  for (const unsigned int number : n)
    {
      // Bernstein polynomials of higher degree lose all digits to round-off.
      require(degree > 0 || (number >= 1 && number <= 50), "must lie between 1 and 50 each");
      require(degree == 0 || number == 1 || number > degree,
              "must be 1 or at least one more than 'Degree' each");
    }
  for (unsigned int axis = 0; axis < ends.size(); ++axis)
    {
      const auto &[closed, smooth] = ends[axis];
      const bool is_half           = n[axis] > 1 && (smooth[0] || smooth[1]);
      if (degree == 0 && n[axis] > 1 && (closed || (smooth[0] && smooth[1])))
        throw bad_entry(parameters.path("Basis"), parameters.basis,
                        "must be B-spline patch for a closed face and for a face between two "
                        "symmetry planes, or have 1 control point there");
      require(degree > 0 || !is_half || n[axis] <= 25,
              "must be at most 25 across a symmetry plane");
      if (degree == 1 && is_half)
        throw bad_entry(parameters.path("Degree"), to_text(degree),
                        "must be at least 2 for 'Smooth across symmetry'");
    }
  return SplineNet(n, degree, ends);
}

void require_bounds(const ShapeParameters &parameters)
{
  const auto &bounds = parameters.bounds;
  if (!(bounds.size() == 2 && bounds[0] < bounds[1] && std::isfinite(bounds[1] - bounds[0])))
    throw bad_entry(parameters.path("Bounds"), to_text(bounds),
                    "must be two numbers separated by a comma, the first below the second");
  const auto &initial = parameters.initial;
  for (const double move : initial.empty() ? std::vector<double>{0.} : initial)
    if (!(move >= bounds[0] && move <= bounds[1]))
      throw bad_entry(parameters.path("Initial"), to_text(parameters.initial),
                      to_text(move) + " must lie within the bounds " + to_text(bounds));
}

template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>> box_of(const ShapeParameters &parameters)
{
  const auto read = [&](const std::string &entry, const std::vector<double> &numbers,
                        const bool positive) {
    dealii::Tensor<1, dim> result;
    bool                   good = numbers.size() == dim;
    for (unsigned int d = 0; d < dim && good; ++d)
      {
        result[d] = numbers[d];
        good      = std::isfinite(numbers[d]) && (!positive || numbers[d] > 0.);
      }
    if (!good)
      throw bad_entry(parameters.path(entry), to_text(numbers),
                      "must be " + std::to_string(dim) + (positive ? " numbers > 0" : " numbers"));
    return result;
  };
  return {read("Box corner", parameters.box_corner, false),
          read("Box size", parameters.box_size, true)};
}

/// The error message lists the names of all bodies.
std::vector<bool> wanted_bodies(const BodyNames &bodies, const ShapeParameters &parameters)
{
  std::vector<bool> result(bodies.names.size(), parameters.bodies.empty());
  for (const auto &name : parameters.bodies)
    {
      const auto found = std::find(bodies.names.begin(), bodies.names.end(), name);
      if (found == bodies.names.end())
        throw bad_entry(parameters.path("Bodies"), to_text(parameters.bodies),
                        "there is no body '" + name + "'; the bodies are " + to_text(bodies.names));
      result[found - bodies.names.begin()] = true;
    }
  return result;
}

template std::pair<dealii::Tensor<1, 2>, dealii::Tensor<1, 2>> box_of<2>(const ShapeParameters &);
template std::pair<dealii::Tensor<1, 3>, dealii::Tensor<1, 3>> box_of<3>(const ShapeParameters &);
template dealii::Tensor<1, 2> unit_direction(const ShapeParameters &, const std::string &);
template dealii::Tensor<1, 3> unit_direction(const ShapeParameters &, const std::string &);
} // namespace snug::shape
