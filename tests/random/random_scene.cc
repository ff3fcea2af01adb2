#include <random/draw.h>
#include <random/random_scene.h>

#include <algorithm>

namespace snug::test {
namespace {
/// Data that all scenes of one problem share.
struct Common
{
  Draw         draw;
  SceneText    scene;
  unsigned int dim, degree;
};

void head(Common &c, const std::string &bodies)
{
  c.degree = c.draw.chance(0.3) ? 2 : 1;
  c.scene.set("Dimension", c.dim);
  c.scene.set("Element degree", c.degree);
  if (c.dim == 2)
    c.scene.set("Model", c.draw.one_of({"plane strain", "plane stress"}));
  c.scene.set("Bodies", bodies);
}

void material(Common &c)
{
  c.scene.set("Young's modulus", c.draw.scale(100., 10000.));
  c.scene.set("Poisson's ratio", c.draw.between(0., 0.45));
}

/// Components along all axes, all but the last @p across.
std::string vector(const Common &c, const std::string &across, double along)
{
  return c.dim == 2 ? join(across, " ", along) : join(across, " ", across, " ", along);
}

void contact(Common &c, const std::string &pairs, const std::string &gap)
{
  c.scene.begin("Contact");
  c.scene.set("Pairs", pairs);
  c.scene.set("Method", c.draw.one_of({"auto", "nodal", "mortar"}));
  c.scene.set("Slave", c.draw.one_of({"finer", "first"}));
  c.scene.set("Gap", gap);
  c.scene.set("Interference", "true");
  c.scene.end();
}

void solver(Common &c, bool in_clusters)
{
  c.scene.begin("Decomposition");
  c.scene.set("Subdomains", c.draw.whole(1, 8));
  c.scene.set("Method", c.draw.one_of({"auto", "METIS"}));
  c.scene.end();
  c.scene.begin("Solver");
  c.scene.set("Relative tolerance", "1e-9");
  const std::string method = c.draw.chance(0.15) ? "SMALSE-M" : "active set";
  c.scene.set("Method", method);
  c.scene.set("Preconditioner",
              c.draw.one_of({"Dirichlet", "Dirichlet", "Dirichlet", "lumped", "none"}));
  c.scene.set("Scaling", c.draw.one_of({"stiffness", "multiplicity"}));
  c.scene.set("Factorization", c.draw.chance(0.1) ? "MUMPS" : "CHOLMOD");
  c.scene.end();
  if (!in_clusters || method != "active set")
    return;
  c.scene.begin("Decomposition");
  c.scene.set("Subdomains per cluster edge", 2);
  c.scene.end();
}

/// Sums of waves, as short as a cell.
std::string rough(Common &c, double size)
{
  std::string formula = join(size * c.draw.between(-0.5, 1.));
  for (unsigned int i = c.draw.whole(1, 3); i > 0; --i)
    formula +=
      join("+", size * c.draw.between(0., 1.), "*sin(", c.draw.between(1., 20.), "*x+",
           c.draw.between(0., 6.), c.dim == 3 ? join("+", c.draw.between(0., 9.), "*y") : "", ")");
  return formula;
}

/// Cells along each axis of a box.
std::string cells(Common &c, unsigned int most)
{
  if (c.dim == 3 || c.degree == 2)
    most = std::max(2u, most / 2);
  std::string text;
  for (unsigned int d = 0; d < c.dim; ++d)
    text += join(d > 0 ? " " : "", c.draw.whole(d + 1 < c.dim ? 2 : 1, most));
  return text;
}

/// Pressures on all sides that together do nothing to a box, or not.
void side_loads(Common &c, double p)
{
  const double q = p * c.draw.between(0.1, 1.);
  if (c.draw.chance(0.4))
    c.scene.set("Pressure", join("left: ", q, ", right: ", q));
  else if (c.draw.chance(0.2))
    c.scene.set("Pressure", join("left: ", q));
}

/// The load of the upper block: centred, tilted or off the contact.
void upper_loads(Common &c, double p)
{
  const std::string tilt = c.draw.one_of({"0", "0", "0", join(p * c.draw.between(-0.3, 0.3))});
  const double      size = c.draw.chance(0.1) ? -p : p;
  if (c.draw.chance(0.3))
    c.scene.set("Force", join("top: ", vector(c, tilt, -size)));
  else if (c.draw.chance(0.5))
    c.scene.set("Traction", join("top: ", vector(c, tilt, -size)));
  else
    c.scene.set("Pressure", join("top: ", size, "*(1+", c.draw.between(-2., 2.), "*x)"));
  if (c.draw.chance(0.3))
    c.scene.set("Moment", c.dim == 2 ? join("top: ", p * c.draw.between(-0.5, 0.5))
                                     : join("top: ", p * c.draw.between(-0.3, 0.3), " ",
                                            p * c.draw.between(-0.3, 0.3), " 0"));
  if (c.draw.chance(0.3))
    c.scene.set("Body force", vector(c, "0", -p * c.draw.between(0., 1.)));
}

/// Two blocks that nothing holds, pressed together from both ends.
void squeezed_blocks(Common &c, double p)
{
  const double width = c.draw.between(0.8, 2.);
  for (const std::string body : {"upper", "lower"})
    {
      c.scene.begin("Body " + body);
      c.scene.set("Box corner", vector(c, "0", body == "upper" ? 1. : 0.));
      c.scene.set("Box size", vector(c, join(width), 1.));
      c.scene.set("Box cells", cells(c, 8));
      material(c);
      const double q = p * c.draw.between(0.1, 1.);
      c.scene.set("Pressure", join(body == "upper" ? "top: " : "bottom: ", p,
                                   c.draw.chance(0.5) ? join(", left: ", q, ", right: ", q) : ""));
      c.scene.end();
    }
}

void blocks(Common &c)
{
  head(c, "upper, lower");
  const double p = c.draw.scale(0.1, 10.);
  if (c.draw.chance(0.15))
    squeezed_blocks(c, p);
  else
    {
      const double width = c.draw.between(0.8, 2.), height = c.draw.between(0.4, 1.2);
      const double upper = width * c.draw.between(0.4, 1.2);
      c.scene.begin("Body lower");
      c.scene.set("Box size", vector(c, join(width), height));
      c.scene.set("Box cells", cells(c, 8));
      material(c);
      if (c.draw.chance(0.2))
        c.scene.set("Curved faces", join("top: ", rough(c, 0.01)));
      const std::string all = c.dim == 2 ? "xy" : "xyz", last = c.dim == 2 ? "y" : "z";
      const std::string front = c.dim == 2 ? "" : ", front: y";
      c.scene.set("Supports", c.draw.one_of({"bottom: " + all, "bottom: " + all, "bottom: " + all,
                                             "bottom: " + last, "bottom: " + last + ", left: x"}));
      side_loads(c, p);
      c.scene.end();
      c.scene.begin("Body upper");
      c.scene.set("Box corner",
                  vector(c, join(c.draw.between(-0.3 * upper, width - 0.7 * upper)), height));
      c.scene.set("Box size", vector(c, join(upper), c.draw.between(0.4, 1.2)));
      c.scene.set("Box cells", cells(c, 8));
      material(c);
      if (c.draw.chance(0.2))
        c.scene.set("Curved faces", join("bottom: ", rough(c, 0.01)));
      if (c.draw.chance(0.1))
        c.scene.set("Displacement", "top: " + last + " = -0.01");
      else if (c.draw.chance(0.5))
        c.scene.set("Supports", c.draw.one_of({"left: x", "right: x", "left: x, right: x",
                                               "left: x" + front, "left: x" + front}));
      upper_loads(c, p);
      c.scene.end();
    }
  const bool first = c.draw.chance(0.5);
  contact(c, first ? "upper.bottom: lower.top" : "lower.top: upper.bottom",
          c.draw.chance(0.2) ? "0" : rough(c, c.draw.scale(1e-4, 2e-2)));
}

/// Boxes on boxes, flat or as bowls and domes, that may tip or slide.
void stack(Common &c)
{
  const unsigned int n = c.draw.whole(3, c.dim == 2 ? 6 : 4);
  std::string        names, pairs;
  for (unsigned int i = 0; i < n; ++i)
    {
      names += join(i > 0 ? ", " : "", "b", i);
      if (i > 0)
        pairs += join(i > 1 ? ", b" : "b", i, ".bottom: b", i - 1, ".top");
    }
  const bool on_floor = c.draw.chance(0.2);
  head(c, names);
  if (on_floor)
    {
      c.scene.set("Obstacles", "floor");
      pairs += ", b0.bottom: floor";
    }
  const double p = c.draw.scale(0.1, 10.), spread = c.draw.between(0., 0.3);
  const bool   is_held = c.draw.chance(0.4);
  std::string  below;
  double       y = 0.;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double width = c.draw.between(0.6, 1.4), height = c.draw.between(0.3, 1.);
      c.scene.begin(join("Body b", i));
      c.scene.set("Box corner", vector(c, join(c.draw.between(-spread, spread) - width / 2.), y));
      c.scene.set("Box size", vector(c, join(width), height));
      c.scene.set("Box cells", cells(c, 5));
      material(c);
      std::string faces = below.empty() ? "" : "bottom: -(" + below + ")";
      below             = c.draw.chance(0.4) ? join(c.draw.between(-0.3, 0.3), "*x^2") : "";
      if (!below.empty() && i + 1 < n)
        faces += (faces.empty() ? "top: " : "; top: ") + below;
      c.scene.set("Curved faces", faces);
      if (i == 0 && !on_floor)
        c.scene.set("Supports", c.dim == 2 ? "bottom: xy" : "bottom: xyz");
      else if (is_held)
        c.scene.set("Supports", c.dim == 2 ? "left: x" : "left: x, front: y");
      if (c.draw.chance(0.5))
        c.scene.set("Body force", vector(c, "0", -p * c.draw.between(0.1, 1.)));
      if (i + 1 == n)
        c.scene.set("Force",
                    "top: " + vector(c,
                                     c.draw.one_of({"0", "0", join(p * c.draw.between(-0.3, 0.3))}),
                                     -p));
      c.scene.end();
      y += height;
    }
  if (on_floor)
    {
      c.scene.begin("Obstacle floor");
      c.scene.end();
    }
  contact(c, pairs, c.draw.chance(0.7) ? "0" : rough(c, 1e-3));
}

/// Full rings within each other, the innermost loaded or pressed.
void rounds(Common &c)
{
  const unsigned int n = c.draw.whole(2, 3);
  head(c, n == 2 ? "b0, b1" : "b0, b1, b2");
  const double       p     = c.draw.scale(0.1, 10.);
  const unsigned int all   = c.draw.whole(10, c.degree == 2 ? 16 : 28);
  const bool         match = c.draw.chance(0.4), pressed = c.draw.chance(0.5);
  double             inner = c.draw.between(0.3, 1.);
  const std::string  held  = c.draw.one_of({"outer: xy", "outer: xy", "outer: normal", ""});
  const double       force = p * c.draw.between(-1., 1.);
  for (unsigned int i = 0; i < n; ++i)
    {
      const double outer = inner + c.draw.between(0.3, 1.);
      c.scene.begin(join("Body b", i));
      c.scene.set("Mesh", "ring");
      c.scene.set("Inner radius", inner);
      c.scene.set("Radius", outer);
      c.scene.set("Cells", match ? all : c.draw.whole(10, c.degree == 2 ? 16 : 28),
                  c.draw.whole(1, c.degree == 2 ? 1 : 2));
      material(c);
      if (i == 0 && pressed)
        c.scene.set("Pressure", join("inner: ", p));
      else if (i == 0)
        c.scene.set("Force", join("inner: ", force, " ", -p));
      if (i == 0 && c.draw.chance(0.1))
        c.scene.set("Moment", join("inner: ", p * c.draw.between(-0.1, 0.1)));
      if (i + 1 == n && !pressed && held.empty())
        c.scene.set("Force", join("outer: ", -force, " ", p));
      else if (i + 1 == n && !pressed)
        c.scene.set("Supports", held);
      c.scene.end();
      inner = outer;
    }
  const double size = c.draw.scale(1e-4, 1e-2);
  contact(c, n == 2 ? "b0.outer: b1.inner" : "b0.outer: b1.inner, b2.inner: b1.outer",
          join(c.draw.chance(0.5) ? size : -size));
}

struct Kind
{
  std::string  name;
  unsigned int dim;
  void (*make)(Common &);
};

const std::vector<Kind> table = {{"two blocks, plane", 2, blocks},
                                 {"two blocks, solid", 3, blocks},
                                 {"stacks, plane", 2, stack},
                                 {"stacks, solid", 3, stack},
                                 {"round in round", 2, rounds}};
} // namespace

const std::vector<std::string> &kinds()
{
  static const auto names = []() {
    std::vector<std::string> result;
    for (const auto &kind : table)
      result.push_back(kind.name);
    return result;
  }();
  return names;
}

std::string random_scene(unsigned int number)
{
  const auto &kind = table[number % table.size()];
  Common      c{Draw(number), {}, kind.dim, 1};
  kind.make(c);
  solver(c, number / table.size() % 3 == 2);
  return c.scene.text();
}
} // namespace snug::test
