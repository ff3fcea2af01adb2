#include <snug/base/assertions.h>
#include <snug/base/values.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/rigid_motion.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <stdexcept>

namespace snug::geometry {
namespace {
/// Return @p dim finite numbers from @p begin to @p end. @throws std::invalid_argument
template <int dim>
dealii::Tensor<1, dim> vector_of(const std::vector<std::string> &words, const std::size_t begin)
{
  if (words.size() != begin + dim)
    throw std::invalid_argument("'" + words.front() + "' needs " + std::to_string(dim) +
                                " numbers after '" + words[begin - 1] + "'");
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    from_text(words[begin + d], result[d]);
  return result;
}

/// Return the rotation that @p words describe: "rotate AXIS DEGREES" and perhaps "about POINT".
template <int dim>
RigidMotion<dim> rotation_about_axis(const std::vector<std::string> &words)
{
  const unsigned int axis = words.size() < 3 ? 3 : axis_called(words[1]);
  if (axis == 3 || (dim == 2 && axis != 2))
    throw std::invalid_argument(dim == 2 ? "'rotate' needs the axis z and an angle in degrees"
                                         : "'rotate' needs an axis (x, y, z) and an angle in "
                                           "degrees");
  double degrees;
  from_text(words[2], degrees);
  RigidMotion<dim> result;
  result.Q = rotation<dim>(axis, degrees);
  if (words.size() == 3)
    return result;
  if (words[3] != "about")
    throw std::invalid_argument("'" + words[3] + "' is not 'about'");
  const auto centre = vector_of<dim>(words, 4);
  // A turn by zero leaves every point exactly where it is.
  result.t = centre - result.Q * centre;
  return result;
}
} // namespace

template <int dim>
dealii::Tensor<2, dim> rotation(const unsigned int axis, const double degrees)
{
  SNUG_ASSERT_BELOW(axis, 3);
  const double       turn  = std::remainder(degrees, 360.);
  const double       angle = turn * dealii::numbers::PI / 180.;
  const bool         right = std::remainder(turn, 90.) == 0.;
  const double       c     = right ? std::round(std::cos(angle)) : std::cos(angle);
  const double       s     = right ? std::round(std::sin(angle)) : std::sin(angle);
  const unsigned int a = (axis + 1) % 3, b = (axis + 2) % 3;
  // About z the block of x and y is the complete rotation.
  auto result  = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  result[a][a] = c;
  result[b][b] = c;
  result[a][b] = -s;
  result[b][a] = s;
  return result;
}

template <int dim>
RigidMotion<dim> rigid_motion(const std::string &text)
{
  RigidMotion<dim> result;
  for (const auto &part : split(text, ','))
    {
      const auto       words = components(part);
      RigidMotion<dim> next;
      if (words.empty())
        throw std::invalid_argument("a motion is missing");
      if (words.front() == "rotate")
        next = rotation_about_axis<dim>(words);
      else if (words.front() == "shift")
        next.t = vector_of<dim>(words, 1);
      else
        throw std::invalid_argument("'" + words.front() + "' is neither 'rotate' nor 'shift'");
      result = {next.Q * result.Q, next.point(result.t)};
    }
  return result;
}

template dealii::Tensor<2, 2> rotation<2>(unsigned int, double);
template dealii::Tensor<2, 3> rotation<3>(unsigned int, double);
template RigidMotion<2>       rigid_motion(const std::string &);
template RigidMotion<3>       rigid_motion(const std::string &);
} // namespace snug::geometry
