#include <snug/scene/check.h>
#include <snug/scene/section_check.h>
#include <snug/scene/values.h>
#include <snug/shape/formula_modes.h>

#include <algorithm>
#include <cmath>

namespace snug::scene {
namespace {
/// Checks the entries of one shape, as far as no mesh is needed.
class ShapeCheck : public SectionCheck
{
public:
  ShapeCheck(const Scene &scene, const shape::ShapeParameters &shape, const Origins &origins)
    : SectionCheck(shape.section(), origins), scene(scene), shape(shape)
  {}

  void check() const
  {
    if (shape.basis == "none")
      return;
    check_unread();
    const bool box     = names("box");
    const bool formula = names("formula");
    if (!box && !(formula && shape.face.empty()))
      check_face();
    if (box || names("patch"))
      check_control_points(box ? scene.dimension : scene.dimension - 1);
    if (box)
      check_box();
    if (formula)
      check_modes();
    check_numbers();
    check_links();
    check_design();
  }

private:
  /// Whether the name of the basis holds @p word.
  bool names(const std::string &word) const { return shape.basis.find(word) != std::string::npos; }

  /// Entries the basis is made from.
  std::vector<std::string> read_entries() const
  {
    if (names("formula"))
      return shape.face.empty() ? std::vector<std::string>{"Modes", "Bodies"}
                                : std::vector<std::string>{"Modes", "Face", "Interior", "Reach"};
    std::vector<std::string> entries = {"Direction", "Symmetry", "Fixed"};
    const auto               add     = [&entries](const std::vector<std::string> &more) {
      entries.insert(entries.end(), more.begin(), more.end());
    };
    if (names("box"))
      add({"Bodies", "Box corner", "Box size"});
    else
      add({"Face", "Interior", "Reach"});
    if (names("node-wise"))
      add({"Filter radius"});
    else
      add({"Control points"});
    if (names("B-spline"))
      add({"Degree"});
    return entries;
  }

  /// Entries that are set must be read.
  void check_unread() const
  {
    const shape::ShapeParameters initial;
    const auto                   read   = read_entries();
    const auto                   unless = [&](const bool is_initial, const std::string &entry,
                            const std::string &value) {
      require(is_initial || std::find(read.begin(), read.end(), entry) != read.end(), entry, value,
                                "must be left out for Basis = " + shape.basis);
    };
    const auto &s = shape;
    unless(s.face.empty(), "Face", s.face);
    unless(s.bodies.empty(), "Bodies", listed(s.bodies));
    unless(s.control_points.empty(), "Control points", to_text(s.control_points));
    unless(s.degree == initial.degree, "Degree", to_text(s.degree));
    unless(s.direction.empty(), "Direction", to_text(s.direction));
    unless(s.box_corner.empty(), "Box corner", to_text(s.box_corner));
    unless(s.box_size.empty(), "Box size", to_text(s.box_size));
    unless(s.modes.empty(), "Modes", s.modes.empty() ? "" : listed(s.modes.front()));
    unless(s.filter_radius == initial.filter_radius, "Filter radius", to_text(s.filter_radius));
    unless(s.symmetry.empty(), "Symmetry", to_text(s.symmetry));
    unless(s.fixed.empty(), "Fixed", listed(s.fixed));
    unless(s.interior == initial.interior, "Interior", s.interior);
    unless(s.reach == initial.reach, "Reach", to_text(s.reach));
  }

  void check_face() const
  {
    require_face(scene, origins, path("Face"), shape.face, shape.face);
    const unsigned int body = body_index(scene, split_face(shape.face).first);
    require(shape.interior != "linear blending" || scene.bodies[body].mesh.source == "box",
            "Interior", shape.interior,
            "must be Laplace or elasticity for the body '" + scene.bodies[body].name +
              "', which is no box");
  }

  void check_control_points(const unsigned int n_axes) const
  {
    const auto        &points  = shape.control_points;
    const bool         splines = names("B-spline");
    const unsigned int least   = splines ? shape.degree + 1 : 1;
    require(!splines || (shape.degree >= 1 && shape.degree <= 10), "Degree", to_text(shape.degree),
            "must lie between 1 and 10");
    require(points.size() == n_axes, "Control points", to_text(points),
            "must have " + to_text(n_axes) +
              (n_axes == 1 ? " number" : " numbers separated by commas") +
              ", one per edge of the face or box");
    // Bernstein polynomials of higher degree lose all digits.
    for (const unsigned int n : points)
      require(n >= least && (splines || n <= 50), "Control points", to_text(points),
              splines ? "must be more than 'Degree' each" : "must lie between 1 and 50 each");
  }

  void check_box() const
  {
    const std::string three =
      "must have " + to_text(scene.dimension) + " numbers separated by commas";
    require(shape.box_corner.size() == scene.dimension && all_finite(shape.box_corner),
            "Box corner", to_text(shape.box_corner), three);
    require(shape.box_size.size() == scene.dimension && all_finite(shape.box_size), "Box size",
            to_text(shape.box_size), three);
    for (const double edge : shape.box_size)
      require(edge > 0., "Box size", to_text(shape.box_size), "must be positive");
    for (const auto &body : shape.bodies)
      require(body_index(scene, body) < scene.bodies.size(), "Bodies", listed(shape.bodies),
              "there is no body '" + quotable(body) + "'");
  }

  /// Formulas are parsed, their values are checked on the mesh.
  void check_modes() const
  {
    try
      {
        if (scene.dimension == 2)
          shape::FormulaFields<2> fields(shape);
        else
          shape::FormulaFields<3> fields(shape);
      }
    catch (const InputError &error)
      {
        throw InputError(origins.of(path("Modes")) + error.what());
      }
  }

  void check_numbers() const
  {
    double square = 0.;
    for (const double component : shape.direction)
      square += component * component;
    require(shape.direction.empty() ||
              (shape.direction.size() == scene.dimension && square > 0. && std::isfinite(square)),
            "Direction", to_text(shape.direction),
            "must be empty or " + to_text(scene.dimension) +
              " numbers separated by commas, not all zero");
    const double radius = shape.filter_radius;
    require(std::isfinite(radius) && (radius > 0. || shape.basis != "node-wise"), "Filter radius",
            to_text(radius), "must be positive");
    require(std::isfinite(shape.reach) && shape.reach >= 0., "Reach", to_text(shape.reach),
            "must be positive, or 0 for the whole body");
  }

  void check_links() const
  {
    const std::string axes = std::string("xyz").substr(0, scene.dimension);
    for (const auto &plane : shape.symmetry)
      require(plane.first.size() == 1 && axes.find(plane.first) != std::string::npos &&
                std::isfinite(plane.second),
              "Symmetry", to_text(shape.symmetry),
              "must be a list 'axis: number' with axes of '" + axes + "'");
    for (const auto &item : shape.fixed)
      require(item == "border" ||
                (!item.empty() && item.find_first_not_of("0123456789") == std::string::npos),
              "Fixed", listed(shape.fixed),
              "'" + quotable(item) + "' must be 'border' or the number of a control point");
  }

  void check_design() const
  {
    const auto &bounds = shape.bounds;
    require(bounds.size() == 2 && std::isfinite(bounds[0]) && std::isfinite(bounds[1]) &&
              bounds[0] < bounds[1],
            "Bounds", to_text(bounds),
            "must be two numbers separated by a comma, the first below "
            "the second");
    for (const double move : shape.initial)
      require(move >= bounds[0] && move <= bounds[1], "Initial", to_text(shape.initial),
              to_text(move) + " must lie within the bounds " + to_text(bounds));
  }

  const Scene                  &scene;
  const shape::ShapeParameters &shape;
};
} // namespace

void check_shapes(const Scene &scene, const Origins &origins)
{
  bool none = true;
  for (const auto &shape : scene.shapes)
    {
      ShapeCheck(scene, shape, origins).check();
      none = none && shape.basis == "none";
    }
  if (none && scene.task != Task::state)
    throw origins.error(scene.shapes.front().path("Basis"), "none",
                        "must not be none for the task " + to_text(scene.task));
}
} // namespace snug::scene
