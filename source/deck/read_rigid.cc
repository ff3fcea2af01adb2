#include <snug/base/values.h>
#include <snug/deck/keyword_reader.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/fitted_surface.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::upper_case;
using Words   = std::vector<std::string>;
using Corners = DeckBodies::Corners;

namespace {
/// Nodes of a rigid surface may deviate from its shape by this fraction of its size, as nodes with
/// few digits do.
const double shape_tolerance = 1e-5;

/// Read *RIGID BODY of rigid elements or of an analytical surface.
void read_rigid_body(Reading &reading, const Keyword &keyword)
{
  const auto          &sets = reading.deck.sets;
  DeckModel::RigidBody rigid{0, {}, upper_case(keyword.option("ANALYTICALSURFACE")), keyword.line};
  const auto           nodes = keyword.has("REFNODE")
                                 ? sets.nodes(keyword.option("REFNODE"), "", keyword.title, keyword.line)
                                 : std::vector<unsigned int>();
  if (nodes.size() != 1)
    throw keyword_error(keyword, "*RIGID BODY must have one REF NODE");
  rigid.reference_node = nodes[0];
  if (keyword.has("ELSET"))
    for (const unsigned int e :
         sets.elements(keyword.option("ELSET"), "", keyword.title, keyword.line))
      {
        const auto &element = reading.deck.mesh.elements[e];
        if (mesh_file::dimension(element.shape) + 1 != reading.bodies.dimension())
          return reading.lacks(keyword, " of cells");
        rigid.faces.insert(geometry::sorted(element.corners));
      }
  if (rigid.faces.empty() && rigid.surface.empty())
    return reading.lacks(keyword, " without rigid elements or an analytical surface");
  reading.model.rigid_bodies.push_back(rigid);
}

/// Return the keyword of the analytical surface @p word, or null.
const Keyword *analytical(const Reading &reading, const std::string &word)
{
  for (const auto &keyword : reading.text.keywords())
    if (const auto type = upper_case(keyword.option("TYPE"));
        keyword.name == "SURFACE" && upper_case(keyword.option("NAME")) == upper_case(word) &&
        (type == "SEGMENTS" || type == "CYLINDER" || type == "REVOLUTION"))
      return &keyword;
  return nullptr;
}

/// Return a number with 12 digits, which drops the round-off of a fit, and without the sign of
/// zero.
double rounded(const double number)
{
  std::ostringstream text;
  text << std::setprecision(12) << number;
  return std::stod(text.str()) + 0.;
}

template <int dim>
std::vector<double> numbers(const dealii::Tensor<1, dim> &v)
{
  std::vector<double> result;
  for (unsigned int d = 0; d < dim; ++d)
    result.push_back(rounded(std::abs(v[d]) < 1e-12 * v.norm() ? 0. : v[d]));
  return result;
}

/// Return the positions of nodes in the model.
template <int dim>
std::vector<dealii::Point<dim>> positions(const Reading &reading, const std::vector<Corners> &faces)
{
  std::set<unsigned int> nodes;
  for (const auto &face : faces)
    nodes.insert(face.begin(), face.end());
  std::vector<dealii::Point<dim>> result;
  for (const unsigned int node : nodes)
    {
      result.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        result.back()[d] = reading.bodies.point(node)[d];
    }
  return result;
}

/// Return the normal of the plane through the point that is farthest from the first one, and the
/// one that is farthest from the line through these two.
template <int dim>
dealii::Tensor<1, dim> plane_normal(const std::vector<dealii::Point<dim>> &points)
{
  dealii::Tensor<1, dim> normal, first;
  for (const auto &point : points)
    if ((point - points[0]).norm() > first.norm())
      first = point - points[0];
  for (const auto &point : points)
    {
      dealii::Tensor<1, dim> of_point;
      if constexpr (dim == 3)
        of_point = dealii::cross_product_3d(first, point - points[0]);
      else
        of_point = dealii::cross_product_2d(first);
      if (of_point.norm() > normal.norm())
        normal = of_point;
    }
  return normal.norm() > 0. ? normal / normal.norm() : normal;
}

/// Return the plane, cylinder or sphere on which points lie, seen from @p slave, or nothing.
template <int dim>
std::optional<DeckModel::Obstacle> shape_of(const std::vector<dealii::Point<dim>> &points,
                                            const dealii::Point<dim>              &slave)
{
  using Kind  = typename geometry::KnownSurface<dim>::Kind;
  double size = 0.;
  for (const auto &point : points)
    size = std::max(size, point.distance(points[0]));
  const auto normal   = plane_normal<dim>(points);
  const bool is_plane = std::all_of(points.begin(), points.end(), [&](const auto &point) {
    return std::abs((point - points[0]) * normal) <= shape_tolerance * size;
  });
  if (is_plane && normal.norm() > 0.)
    {
      const double sign = (slave - points[0]) * normal < 0. ? -1. : 1.;
      return DeckModel::Obstacle{"", "plane", numbers<dim>(points[0]), numbers<dim>(sign * normal),
                                 0., 0};
    }
  const geometry::SurfaceSample<dim> sample{points, {}, {}};
  const auto round = geometry::recognized_surface(sample, shape_tolerance * size);
  if (!round || (round->kind != Kind::sphere && round->kind != Kind::cylinder))
    return {};
  const bool        is_sphere = round->kind == Kind::sphere && dim == 3;
  const std::string hollow    = round->distance(slave) < 0. ? "hollow " : "";
  return DeckModel::Obstacle{"",
                             hollow + (is_sphere ? "sphere" : "cylinder"),
                             numbers<dim>(round->centre),
                             dim == 3 && !is_sphere ? numbers<dim>(round->axis)
                                                    : std::vector<double>(),
                             rounded(round->radius),
                             0};
}

/// Return the points of an analytical surface of one line or one arc in the plane, or none.
std::vector<dealii::Point<2>> points_of(const Reading &reading, const Keyword &keyword)
{
  std::vector<dealii::Point<2>> points;
  unsigned int                  n_lines = 0;
  if (upper_case(keyword.option("TYPE")) != "SEGMENTS" || reading.bodies.dimension() != 2)
    return {};
  reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
    const auto        kind = upper_case(words[0]);
    const auto        x    = mesh_file::numbers_from(words, 1, line);
    const std::size_t size = kind == "CIRCL" ? 4 : 2;
    if ((kind != "START" && kind != "LINE" && kind != "CIRCL") || x.size() != size)
      throw error_at_line(line, "START, LINE or CIRCL with coordinates is expected");
    ++n_lines;
    if (kind != "CIRCL")
      return points.emplace_back(x[0], x[1]), void();
    // Points of the whole circle have the shape of the arc.
    points.clear();
    const dealii::Point<2> middle(x[2], x[3]);
    const auto             arm = dealii::Point<2>(x[0], x[1]) - middle;
    for (unsigned int i = 0; i < 8; ++i)
      {
        const double angle = i * dealii::numbers::PI / 4.;
        points.emplace_back(middle + std::cos(angle) * arm +
                            std::sin(angle) * dealii::cross_product_2d(arm));
      }
  });
  return n_lines == 2 ? points : std::vector<dealii::Point<2>>();
}

template <int dim>
std::optional<DeckModel::Obstacle> shape_of(const Reading              &reading,
                                            const std::vector<Corners> &faces,
                                            const Keyword              *surface,
                                            const std::vector<Corners> &slave)
{
  auto points = positions<dim>(reading, faces);
  if constexpr (dim == 2)
    if (surface != nullptr)
      points = points_of(reading, *surface);
  dealii::Tensor<1, dim> sum;
  const auto             of_slave = positions<dim>(reading, slave);
  for (const auto &point : of_slave)
    sum += point;
  const dealii::Point<dim> centre(sum / static_cast<double>(of_slave.size()));
  return points.empty() ? std::optional<DeckModel::Obstacle>() : shape_of<dim>(points, centre);
}
} // namespace

bool is_rigid_surface(const Reading &reading, const std::string &word)
{
  const auto found = reading.deck.sets.spelling.find(upper_case(word));
  return analytical(reading, word) != nullptr ||
         (found != reading.deck.sets.spelling.end() &&
          !reading.bodies.other_faces_of(found->second).empty());
}

std::optional<unsigned int> obstacle_of(Reading                    &reading,
                                        const std::string          &word,
                                        const std::vector<Corners> &slave,
                                        const unsigned long         line)
{
  auto       &model   = reading.model;
  const auto *surface = analytical(reading, word);
  const auto  faces =
    surface == nullptr
       ? reading.bodies.other_faces_of(reading.deck.sets.spelling.at(upper_case(word)))
       : std::vector<Corners>();
  for (unsigned int r = 0; r < model.rigid_bodies.size(); ++r)
    {
      const auto &rigid = model.rigid_bodies[r];
      if (surface != nullptr ? rigid.surface != upper_case(word)
                             : rigid.faces.count(faces.front()) == 0)
        continue;
      auto shape = reading.bodies.dimension() == 2 ? shape_of<2>(reading, faces, surface, slave)
                                                   : shape_of<3>(reading, faces, surface, slave);
      if (!shape)
        {
          reading.remarks.lacks("rigid body", "*RIGID BODY that is no plane, cylinder or sphere",
                                rigid.line);
          return {};
        }
      shape->name       = "rigid-" + std::to_string(model.obstacles.size() + 1);
      shape->rigid_body = r;
      model.obstacles.push_back(*shape);
      return model.obstacles.size() - 1;
    }
  reading.remarks.lacks("contact pair",
                        "*CONTACT PAIR with the surface '" + word +
                          "', which belongs to no cell and no rigid body",
                        line);
  return {};
}

KeywordReadings rigid_readings(Reading &reading)
{
  return {{"RIGIDBODY",
           {[&reading](const Keyword &keyword) { read_rigid_body(reading, keyword); },
            {{"REFNODE", "ELSET", "ANALYTICALSURFACE"}, {}}}}};
}
} // namespace snug::deck
