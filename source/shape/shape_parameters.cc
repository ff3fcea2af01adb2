#include <snug/base/section_check.h>
#include <snug/shape/entries.h>
#include <snug/shape/formula_modes.h>
#include <snug/shape/shape_basis.h>

#include <algorithm>
#include <cctype>

namespace snug::shape {
namespace {
/// Return whether the value of 'Initial' is a path, which begins with a letter, "/", "./" or "../".
bool is_path(const std::string &text)
{
  const auto first = text.find_first_not_of('.');
  return first != std::string::npos && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 ||
                                        text[0] == '_' || text[first] == '/');
}

void declare_places(Entries &entries, ShapeParameters &shape)
{
  entries.add(
    "Face", shape.face, allowed("body.boundary + body.boundary + ..."),
    "The face that patches, node-wise variables or formula modes shape: one boundary, or a "
    "chain of boundaries of a body that meet smoothly.");
  entries.add("Bodies", shape.bodies,
              "The bodies that boxes, or formula modes without a face, shape. An empty list means "
              "all bodies.");
  entries.add("Box corner", shape.box_corner, per_dimension(),
              "The corner of a free-form deformation box with the smallest coordinates. Units: "
              "length.");
  entries.add(
    "Box size", shape.box_size, per_dimension(positive()),
    "The edge lengths of the free-form deformation box along x, y, z. Control points on sides of "
    "the box that cut a body are fixed. Units: length.");
}

void declare_coordinates(Entries &entries, ShapeParameters &shape)
{
  entries.add(
    "Coordinates", shape.coordinates,
    "The coordinates s and t along which the control points of a patch lie and which "
    "formula modes of a face may use. Splines are periodic along arc lengths and angles of "
    "closed faces.");
  entries.add("Axis", shape.axis,
              allowed("3 numbers separated by commas, not all zero, in 3D; otherwise left out"),
              "The direction of the axis of angles, or of the extrusion of arc lengths. An empty "
              "list means that the axis is found from the normals of the face.");
  entries.add("Axis point", shape.axis_point, per_dimension(),
              "The centre of angles, in 3D a point of the axis. Units: length. An empty list means "
              "that the point is found from the normals of the face.");
  entries.add("Start angle", shape.start_angle,
              "The angle at which closed coordinates are zero, from the direction x (y for an axis "
              "along x) in the right-handed sense. Units: degrees.");
  entries.add(
    "Smooth across symmetry", shape.smooth, allowed("a list of boundaries of the body"),
    "The boundaries of the body that are symmetry planes across which the patch is smooth: "
    "its slope is zero where the face meets them, as for a model of the whole body.");
}

void declare_modes(Entries &entries, ShapeParameters &shape)
{
  entries.add(
    "Control points", shape.control_points,
    "The numbers of control points along s and t of the face, or along x, y, z of the box. Control "
    "points are numbered along s first, or along x first.");
  entries.add(
    "Degree", shape.degree,
    "The degree of B-splines, at least 1 and below the number of control points along each edge. "
    "Along an edge with 1 control point the splines are constant.");
  entries.add(
    "Direction", shape.direction, per_dimension(),
    "The direction x, y, z in which control points or nodes move, with one design variable "
    "each. An empty list means the normal of the face. For boxes it means all axes, with "
    "one design variable per axis and control point.");
  entries.add("Filter radius", shape.filter_radius,
              "The radius of the filter of node-wise variables. A node moves by the mean of the "
              "variables within this radius, with weights that decrease linearly to zero. Units: "
              "length.");
  entries.add("Modes", access(shape.modes, ';'),
              allowed("a list 'FORMULA, FORMULA, FORMULA; ...' of vectors separated by semicolons"),
              "The vector fields of formula modes as formulas of x, y, z, one field per design "
              "variable: '0, 0, x*(1-x); 0, 0, max(0,y)'. On a face, formulas may contain the "
              "coordinates s and t, the angle and the length of the face.");
}

void declare_links(Entries &entries, ShapeParameters &shape)
{
  entries.add("Fixed", shape.fixed, allowed("a list of 'border' and numbers of control points"),
              "The control points or nodes that do not move: 'border' (of the face or box) and "
              "numbers counted from 0 as in control-points.csv.");
  entries.add("Symmetry", shape.symmetry, allowed("a list 'axis: number, ...' of different axes"),
              "The mirror planes that tie control points or nodes to their images, as axis and "
              "coordinate: 'x: 0.5'. Units: length.");
}

void declare_limits(Entries &entries, ShapeParameters &shape)
{
  entries.add("Only remove", shape.only_remove,
              "Whether the face moves into the body only, as by grinding. The bounds of the "
              "variables are reduced accordingly.");
  entries.add(
    "Maximum slope", shape.maximum_slope, at_least(0., "must be positive, or 0 for no limit"),
    "The maximum absolute derivative of the move along s and t with respect to the length. "
    "A value of 0 means no limit.");
  entries.add("Convex", shape.convex,
              "Whether the moved face must be convex along s and t with several control points.");
  entries.add(
    "Minimum tool radius", shape.tool_radius, at_least(0., "must be positive, or 0 for no limit"),
    "The minimum radius of concave curvature of the moved face along s and t, as that of a "
    "grinding wheel. Units: length. A value of 0 means no limit.");
}

/// Return the entries that the basis of @p shape reads.
std::vector<std::string> entries_of(const ShapeParameters &shape)
{
  // The bases and their entries are the same in 2D and 3D.
  auto       entries = choose(shape_basis_table<3>(), shape.basis).entries;
  const auto drop    = [&entries](const std::string &name) {
    entries.erase(std::remove(entries.begin(), entries.end(), name), entries.end());
  };
  const auto has = [&entries](const std::string &name) {
    return std::find(entries.begin(), entries.end(), name) != entries.end();
  };
  if (!has("Bodies") || !has("Face"))
    return entries;
  if (shape.face.empty())
    for (const auto *name :
         {"Face", "Interior", "Reach", "Coordinates", "Axis", "Axis point", "Start angle"})
      drop(name);
  else
    drop("Bodies");
  return entries;
}

/// Check that the objects which the basis makes from the entries without a mesh can be made.
/// @throws InputError naming the entry
template <int dim>
void make_parts(const ShapeParameters &shape)
{
  if (!shape.direction.empty())
    unit_direction<dim>(shape);
  if (!shape.axis.empty())
    unit_direction<3>(shape, "Axis");
  if (shape.reads("Control points"))
    spline_net(shape, dim - (shape.reads("Face") ? 1 : 0),
               shape.reads("Degree") ? shape.degree : 0);
  if (shape.reads("Box size"))
    box_of<dim>(shape);
  if (shape.reads("Modes"))
    FormulaFields<dim> fields(shape);
  require_bounds(shape);
}

void check_links(const SectionCheck &section, const ShapeParameters &shape)
{
  const std::string axes = std::string("xyz").substr(0, section.dimension);
  for (const auto &[axis, position] : shape.symmetry)
    section.require(axis.size() == 1 && axes.find(axis) != std::string::npos, "Symmetry",
                    to_text(shape.symmetry),
                    "must be a list 'axis: number' with axes of '" + axes + "'");
  for (const auto &item : shape.fixed)
    section.require(item == "border" ||
                      (!item.empty() && item.find_first_not_of("0123456789") == std::string::npos),
                    "Fixed", to_text(shape.fixed),
                    "'" + quotable(item) + "' must be 'border' or the number of a control point");
}
} // namespace

void ShapeParameters::declare(Entries &entries)
{
  entries.add("Basis", basis, choice(names(shape_basis_table<3>())),
              "The functions by which design variables move nodes.");
  declare_places(entries, *this);
  declare_coordinates(entries, *this);
  declare_modes(entries, *this);
  declare_links(entries, *this);
  declare_limits(entries, *this);
  entries.add("Interior", interior,
              "The motion of the nodes inside the body when its face is shaped. With Laplace and "
              "elasticity, nodes of faces adjacent to the shaped face slide in these faces, and "
              "nodes of all other faces do not move. Boxes and modes of bodies do not use it.");
  entries.add(
    "Reach", reach, at_least(0., "must be positive, or 0 for the whole body"),
    "The distance from the shaped face within which nodes inside the body move. Subdomains "
    "without moving nodes are not assembled again. Units: length. A value of 0 means the "
    "whole body.");
  entries.add("Bounds", bounds,
              "The minimum and the maximum of the design variables. Units: length.");
  entries.add("Initial",
              {[this]() { return initial_from.empty() ? to_text(initial) : initial_from; },
               [this](const std::string &text) {
                 initial.clear();
                 initial_from = is_path(text) ? text : "";
                 if (initial_from.empty())
                   from_text(text, initial);
               }},
              allowed("numbers separated by commas or blanks, or the output directory of a run"),
              "The initial values of the design variables, one for all or one for each, or the "
              "output directory, relative to the working directory, of an optimization whose last "
              "design is the initial one, on any mesh. Units: length. An empty list means 0.");
}

bool ShapeParameters::reads(const std::string &entry) const
{
  const auto entries = entries_of(*this);
  return std::find(entries.begin(), entries.end(), entry) != entries.end();
}

void ShapeParameters::check(const SectionCheck &section) const
{
  if (!moves())
    return;
  auto read = entries_of(*this);
  read.insert(read.end(), {"Basis", "Bounds", "Initial"});
  section.require_read(*this, read, "must be left out for Basis = " + basis);
  section.require(axis.empty() || section.dimension == 3, "Axis", to_text(axis),
                  "must be left out for Dimension = 2");
  section.require(degree >= 1 && degree <= 10, "Degree", to_text(degree),
                  "must lie between 1 and 10");
  try
    {
      section.dimension == 2 ? make_parts<2>(*this) : make_parts<3>(*this);
    }
  catch (const InputError &error)
    {
      throw section.placed(error, "Basis", basis);
    }
  section.require(!convex || tool_radius == 0., "Minimum tool radius", to_text(tool_radius),
                  "must be left out for Convex = true");
  section.require(filter_radius > 0. || !reads("Filter radius"), "Filter radius",
                  to_text(filter_radius), "must be positive");
  check_links(section, *this);
}
} // namespace snug::shape
