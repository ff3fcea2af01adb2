#include <snug/scene/check.h>
#include <snug/scene/entries.h>
#include <snug/shape/interior.h>
#include <snug/shape/shape_basis.h>

#include <deal.II/base/utilities.h>

namespace snug::scene {
namespace {
std::string modes_text(const std::vector<std::vector<std::string>> &modes)
{
  std::string text;
  for (const auto &mode : modes)
    text += (text.empty() ? "" : "; ") + listed(mode);
  return text;
}

/// Split at commas and semicolons outside of parentheses, as functions
/// have arguments.
std::vector<std::vector<std::string>> read_modes(const std::string &text)
{
  std::vector<std::vector<std::string>> modes;
  for (const auto &mode : dealii::Utilities::split_string_list(text, ';'))
    {
      int depth = 0;
      modes.push_back({""});
      for (const char c : mode)
        {
          depth += (c == '(') - (c == ')');
          if (c == ',' && depth == 0)
            modes.back().push_back("");
          else
            modes.back().back() += c;
        }
      for (auto &formula : modes.back())
        formula = dealii::Utilities::trim(formula);
    }
  return modes;
}

void declare_places(Entries &entries, shape::ShapeParameters &shape)
{
  entries.add("Face", shape.face, anything("body.boundary"),
              "The face that is shaped, 'body.boundary', by patches, "
              "node-wise or by formula modes.");
  entries.add("Bodies",
              {[&shape]() { return listed(shape.bodies); },
               [&shape](const std::string &text) {
                 shape.bodies = dealii::Utilities::split_string_list(text);
               }},
              pairs("names separated by commas"),
              "The bodies that boxes, or formula modes without a face, "
              "shape; empty: all.");
  entries.add("Box corner", shape.box_corner,
              "Corner of a free-form deformation box with the smallest "
              "coordinates [length].");
  entries.add("Box size", shape.box_size,
              "Its edges along x, y, z [length]. Control points on sides "
              "that cut a body are frozen.");
}

void declare_modes(Entries &entries, shape::ShapeParameters &shape)
{
  entries.add("Control points", shape.control_points,
              "Number of control points along each edge of the face or "
              "box, in the order x, y, z; numbered with the first edge "
              "fastest.");
  entries.add("Degree", shape.degree,
              "Degree of B-splines, at least 1 and below the number of "
              "control points along each edge.");
  entries.add("Direction", shape.direction,
              "Direction x, y, z in which control points or nodes move, "
              "one design variable each. Empty: normal to the face; in "
              "boxes along each axis, so that a control point has as "
              "many variables as the scene dimensions.");
  entries.add("Filter radius", shape.filter_radius,
              "Node-wise: a node follows the mean of the variables "
              "within this radius [length], with weights that fall "
              "linearly to zero.");
  entries.add("Modes",
              {[&shape]() { return modes_text(shape.modes); },
               [&shape](const std::string &text) { shape.modes = read_modes(text); }},
              pairs("a list 'FORMULA, FORMULA, FORMULA; ...' of vectors "
                    "separated by semicolons",
                    ';'),
              "Formula modes: vector fields of x, y, z, one per design "
              "variable, separated by semicolons: '0, 0, x*(1-x); 0, 0, "
              "max(0,y)'.");
}

void declare_links(Entries &entries, shape::ShapeParameters &shape)
{
  entries.add("Fixed",
              {[&shape]() { return listed(shape.fixed); },
               [&shape](const std::string &text) {
                 shape.fixed = dealii::Utilities::split_string_list(text);
               }},
              pairs("a list of 'border' and numbers of control points"),
              "Control points or nodes that stay: 'border' (of the face "
              "or box) and numbers counted from 0 as in "
              "control-points.csv.");
  entries.add("Symmetry", shape.symmetry, pairs("a list 'axis: number, ...' of different axes"),
              "Mirror planes, axis: coordinate [length], which tie "
              "control points or nodes to their images: 'x: 0.5'.");
}

void declare_shape(Entries &entries, shape::ShapeParameters &shape)
{
  entries.begin_section(shape.section(), "Design variables. Several shapes: see the entry "
                                         "'Shapes'.");
  add_choice(entries, "Basis", shape.basis, shape::shape_basis_table<3>(),
             "How design variables move the nodes.");
  declare_places(entries, shape);
  declare_modes(entries, shape);
  declare_links(entries, shape);
  add_choice(entries, "Interior", shape.interior, shape::interior_table<3>(),
             "How the nodes of the body follow its shaped face. With "
             "Laplace and elasticity, faces that touch the shaped one "
             "slide in themselves and the others stay. Boxes and fields "
             "on bodies need none.");
  entries.add("Reach", shape.reach,
              "How far from the shaped face [length] the interior "
              "follows; 0: through the whole body. What does not move is "
              "not assembled again.");
  entries.add("Bounds", shape.bounds, "Smallest and largest value of a design variable [length].");
  entries.add("Initial", shape.initial,
              "Design variables at the start [length]: one for all, one "
              "for each, or empty: 0.");
}
} // namespace

void declare_shapes(Entries &entries, Scene &scene)
{
  for (auto &shape : scene.shapes)
    declare_shape(entries, shape);
}
} // namespace snug::scene
