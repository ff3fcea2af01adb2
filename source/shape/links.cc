#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/links.h>
#include <snug/shape/near_points.h>

#include <algorithm>
#include <numeric>

namespace snug::shape {
namespace {
/// Two controls are images of each other if their differences do not exceed this tolerance. The
/// difference of positions is relative to the extent of all controls, and the difference of
/// directions is relative to the length of the directions.
const double image_tolerance = 1e-6;

/// Groups of numbers that are equal up to their signs. The groups form a forest: each number
/// points to a number of the same group with a lower index and stores the sign relative to the
/// number with the lower index. Roots point to themselves.
class SignedGroups
{
public:
  explicit SignedGroups(unsigned int n) : parent(n), sign(n, 1.), fixed(n, false)
  {
    std::iota(parent.begin(), parent.end(), 0u);
  }

  /// Return the root and the sign of number i, with number i = sign * number root(i).
  std::pair<unsigned int, double> root(unsigned int i) const
  {
    double product = 1.;
    while (parent[i] != i)
      {
        product *= sign[i];
        i = parent[i];
      }
    return {i, product};
  }

  /// Set number i equal to @p factor times number j.
  void tie(unsigned int i, unsigned int j, double factor)
  {
    const auto a = root(i), b = root(j);
    // a.second * A = factor * b.second * B
    // Signs are their own inverses: A = between * B and B = between * A.
    const double between = a.second * factor * b.second;
    if (a.first == b.first)
      // Only x = 0 satisfies x = -x.
      fixed[a.first] = fixed[a.first] || between < 0.;
    else
      {
        const unsigned int first = std::min(a.first, b.first);
        const unsigned int last  = std::max(a.first, b.first);
        // The root is the first number of the group, so that variables are numbered in the order
        // of the controls.
        parent[last] = first;
        sign[last]   = between;
        fixed[first] = fixed[first] || fixed[last];
      }
  }

  /// Fix the whole group of number i, because the numbers of a group are equal up to signs.
  void fix(unsigned int i) { fixed[root(i).first] = true; }

  bool is_fixed(unsigned int i) const { return fixed[root(i).first]; }

private:
  std::vector<unsigned int> parent;
  std::vector<double>       sign; ///< relative to the parent
  std::vector<bool>         fixed;
};

/// This class ties controls to their images across mirror planes.
template <int dim>
class Mirrors
{
public:
  Mirrors(const std::vector<Control<dim>> &controls, const ShapeParameters &parameters)
    : controls(controls), parameters(parameters), positions(places(controls)), near(positions)
  {
    for (const auto &position : positions)
      // The tolerance of positions is relative to this length.
      extent = std::max(extent, (position - positions[0]).norm());
  }

  void tie(SignedGroups &groups) const
  {
    // Planes are processed one after the other. Groups join the images of images.
    for (const auto &plane : parameters.symmetry)
      for (unsigned int i = 0; i < controls.size(); ++i)
        tie_image(groups, plane.first, plane.second, i);
  }

private:
  static std::vector<dealii::Tensor<1, dim>> places(const std::vector<Control<dim>> &controls)
  {
    std::vector<dealii::Tensor<1, dim>> result;
    for (const auto &control : controls)
      result.push_back(control.position);
    return result;
  }

  void tie_image(SignedGroups      &groups,
                 const std::string &axis,
                 const double       coordinate,
                 const unsigned int i) const
  {
    // The mirror image reflects the coordinate normal to the plane and the same component of the
    // direction.
    const unsigned int d         = axis[0] - 'x';
    auto               position  = positions[i];
    auto               direction = controls[i].direction;
    position[d]                  = 2. * coordinate - position[d];
    direction[d]                 = -direction[d];
    bool found                   = false;
    near.for_each(position, image_tolerance * extent, [&](unsigned int j, double) {
      const auto other = controls[j].direction;
      // A control that moves the image point in the opposite direction is tied with the sign -1. A
      // control with another direction, such as the other axes of a box, is not tied.
      for (const double sign : {1., -1.})
        if ((direction - sign * other).norm() <= image_tolerance * other.norm())
          {
            groups.tie(i, j, sign);
            found = true;
          }
    });
    // A control without an image would break the symmetry of the other controls.
    if (found)
      return;
    std::ostringstream what;
    what << "control point " << controls[i].point << " at (" << controls[i].position
         << ") has no image at (" << position << ") that moves along (" << direction << ")";
    throw bad_entry(parameters.path("Symmetry"), to_text(parameters.symmetry), what.str());
  }

  const std::vector<Control<dim>>    &controls;
  const ShapeParameters              &parameters;
  std::vector<dealii::Tensor<1, dim>> positions;
  NearPoints<dim>                     near;
  double                              extent = 0.;
};

/// Read the index in an item of the entry Fixed. Return false if the item is no index. An index
/// has at most 9 digits, which fit an unsigned int.
bool read_index(const std::string &text, unsigned int &index)
{
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
    return false;
  index = std::stoul(text);
  return true;
}
} // namespace

template <int dim>
std::vector<bool> fixed_points(const std::vector<Control<dim>> &controls,
                               const ShapeParameters           &parameters)
{
  // Controls are sorted by their points, and several controls may move the same point.
  const unsigned int n_points = controls.empty() ? 0 : controls.back().point + 1;
  std::vector<bool>  listed_points(n_points, false);
  bool               border = false;
  for (const auto &item : parameters.fixed)
    {
      unsigned int index = 0;
      if (item == "border")
        border = true;
      else if (read_index(item, index) && index < n_points)
        listed_points[index] = true;
      else
        throw bad_entry(parameters.path("Fixed"), to_text(parameters.fixed),
                        "'" + item + "' must be 'border' or one of the " +
                          std::to_string(n_points) + " control points, counted from 0");
    }
  std::vector<bool> result;
  for (const auto &control : controls)
    result.push_back(control.frozen || (border && control.border) || listed_points[control.point]);
  return result;
}

/// This constructor serves modes without control points, which cannot be fixed or mirrored.
Links::Links(const unsigned int n) : size(n)
{
  for (unsigned int i = 0; i < n; ++i)
    // Each control is a variable of its own.
    ties.push_back({i, 1.});
}

template <int dim>
Links::Links(const std::vector<Control<dim>> &controls, const ShapeParameters &parameters)
{
  SignedGroups groups(controls.size());
  Mirrors<dim>(controls, parameters).tie(groups);
  const auto fixed = fixed_points(controls, parameters);
  for (unsigned int i = 0; i < controls.size(); ++i)
    if (fixed[i])
      groups.fix(i);
  std::vector<unsigned int> variable(controls.size());
  for (unsigned int i = 0; i < controls.size(); ++i)
    {
      const auto root = groups.root(i);
      if (root.first == i && !groups.is_fixed(i))
        variable[i] = size++;
      // The root comes first in its group, so variable[root.first] is already set.
      ties.push_back({variable[root.first], groups.is_fixed(i) ? 0. : root.second});
    }
  if (size == 0)
    throw bad_entry(parameters.path("Fixed"), to_text(parameters.fixed),
                    "all control points are fixed: there are no design variables");
}

/// Fixed controls have the sign 0, and the variable index of a fixed control has no meaning.
std::vector<double> Links::expand(const std::vector<double> &alpha) const
{
  SNUG_ASSERT_EQUAL(alpha.size(), size);
  std::vector<double> result;
  for (const Tie &tie : ties)
    result.push_back(tie.sign == 0. ? 0. : tie.sign * alpha[tie.variable]);
  return result;
}

template std::vector<bool> fixed_points(const std::vector<Control<2>> &, const ShapeParameters &);
template Links::Links(const std::vector<Control<2>> &, const ShapeParameters &);
template std::vector<bool> fixed_points(const std::vector<Control<3>> &, const ShapeParameters &);
template Links::Links(const std::vector<Control<3>> &, const ShapeParameters &);
} // namespace snug::shape
