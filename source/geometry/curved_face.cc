#include <snug/geometry/curved_face.h>
#include <snug/geometry/entry_values.h>

namespace snug::geometry {
namespace {
const std::string curved_entry = "Curved faces";
} // namespace

unsigned int curved_boundary(const std::vector<std::string> &names,
                             const std::string              &name,
                             const std::string              &value)
{
  const unsigned int index = index_of(names, name);
  if (index == names.size())
    throw bad_entry(curved_entry, name + ": " + value, "the faces are " + to_text(names));
  return index;
}

template <int dim>
CurvedFace<dim>::CurvedFace(const FlatFace<dim> &flat, const std::string &value)
  : flat(flat), apex(flat.centre)
{
  const std::size_t              at    = value.find(" at ");
  const std::vector<std::string> word  = words(value.substr(0, at));
  const std::string              shape = word.empty() ? "" : word[0];
  // No formula begins with these words, because muParser knows neither word.
  if (shape != "sphere" && shape != "cylinder")
    {
      formula = std::make_unique<Formula<dim>>(curved_entry, value);
      return;
    }
  if (word.size() != (shape == "sphere" ? 2 : 3))
    throw bad_entry(
      curved_entry, flat.name + ": " + value,
      "must be 'sphere R', 'cylinder AXIS R', either with 'at' and the coordinates of "
      "the apex, or a formula");
  if (shape == "cylinder")
    set_axis(word[1], value);
  if (at != std::string::npos)
    set_apex(value.substr(at + 4), value);
  set_radius(word.back(), value);
}

template <int dim>
void CurvedFace<dim>::set_axis(const std::string &axis, const std::string &value)
{
  const unsigned int index = axis_called(axis);
  // In 2D the axis z is no coordinate, so squared_distance() omits no coordinate for the axis.
  const bool tangent = dim == 2 ? index == 2 : index < 3 && index != flat.boundary / 2;
  if (!tangent)
    throw bad_entry(curved_entry, flat.name + ": " + value,
                    dim == 2 ? "the axis of a cylinder must be z in 2D"
                             : "the axis must be x, y or z and tangent to the face");
  straight_axis = index;
}

template <int dim>
void CurvedFace<dim>::set_apex(const std::string &coordinates, const std::string &value)
{
  std::string axes;
  for (unsigned int d = 0; d < dim; ++d)
    if (is_across(d))
      axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[d]);
  std::vector<double> numbers;
  bool                good = true;
  try
    {
      from_text(coordinates, numbers);
    }
  catch (const std::invalid_argument &)
    {
      good = false;
    }
  auto next = numbers.begin();
  for (unsigned int d = 0; d < dim && good; ++d)
    if (is_across(d))
      {
        good = next != numbers.end() && std::isfinite(*next);
        if (good)
          apex[d] = *next++;
      }
  if (!good || next != numbers.end())
    throw bad_entry(curved_entry, flat.name + ": " + value,
                    "'at' must be followed by the coordinates " + axes + " of the apex");
}

template <int dim>
void CurvedFace<dim>::set_radius(const std::string &number, const std::string &value)
{
  std::istringstream stream(number);
  // The radius must exceed the distance of the farthest corner from the apex, because otherwise
  // R^2 - r^2 <= 0.
  dealii::Point<dim> farthest = flat.half_size;
  for (unsigned int d = 0; d < dim; ++d)
    farthest[d] += std::abs(apex[d] - flat.centre[d]);
  const double least = std::sqrt(squared_distance(farthest));
  if (!(stream >> radius) || !stream.eof() || !std::isfinite(radius) || std::abs(radius) <= least)
    {
      std::ostringstream allowed;
      allowed << "the radius must be a number R with |R| > " << least
              << ", the largest distance of the face from the apex";
      throw bad_entry(curved_entry, flat.name + ": " + value, allowed.str());
    }
}

/// Return whether the surface is curved along @p axis, which is neither the face normal nor the
/// axis of a cylinder.
template <int dim>
bool CurvedFace<dim>::is_across(const unsigned int axis) const
{
  return axis != flat.boundary / 2 && axis != straight_axis;
}

/// Return r^2, without the components along the face normal and the axis of a cylinder.
template <int dim>
double CurvedFace<dim>::squared_distance(const dealii::Point<dim> &offset) const
{
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    if (is_across(d))
      sum += offset[d] * offset[d];
  return sum;
}

template <int dim>
double CurvedFace<dim>::displacement(const dealii::Point<dim> &point) const
{
  if (formula)
    {
      // All points below a point of the face have the same displacement, so that lines normal to
      // the face stay straight.
      dealii::Point<dim> on_face = point;
      on_face[flat.boundary / 2] = flat.centre[flat.boundary / 2];
      return formula->value(on_face);
    }
  const double r2 = squared_distance(dealii::Point<dim>(point - apex));
  // This form of |R| - sqrt(R^2 - r^2) has no cancellation for r << |R|.
  const double R      = std::abs(radius);
  const double recede = r2 / (R + std::sqrt(R * R - r2));
  // The curved face touches the flat face at the apex, and a convex face recedes elsewhere.
  return radius > 0. ? -recede : recede;
}

template <int dim>
std::optional<KnownSurface<dim>> CurvedFace<dim>::known() const
{
  if (formula)
    return {};
  KnownSurface<dim> result;
  result.centre = apex;
  // For R > 0 the centre is inside of the body.
  result.centre[flat.boundary / 2] -= (flat.boundary % 2 == 1 ? 1. : -1.) * radius;
  result.radius        = std::abs(radius);
  result.encloses_body = radius > 0.;
  if (straight_axis < dim)
    {
      result.kind                = KnownSurface<dim>::Kind::cylinder;
      result.axis[straight_axis] = 1.;
    }
  return result;
}

template class CurvedFace<2>;
template class CurvedFace<3>;
} // namespace snug::geometry
