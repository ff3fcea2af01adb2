#include <snug/base/values.h>
#include <snug/deck/entry.h>
#include <snug/deck/keyword_reader.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/fitted_surface.h>

#include <algorithm>
#include <cmath>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::to_whole;
using mesh_file::upper_case;
using Words   = std::vector<std::string>;
using Corners = DeckBodies::Corners;

namespace {
/// Nodes of a rigid surface may deviate from its shape by this fraction of its size, as nodes with
/// few digits do.
const double shape_tolerance = 1e-5;

/// Add what follows a reference node. Nodes that are not those of whole faces are noted as lacking.
void add_follower(Reading &reading, const Keyword &keyword, DeckModel::RigidBody follower)
{
  const auto node = follower.reference_node;
  if (reading.bodies.body_at(node) || reading.axes.has(node))
    return reading.lacks(keyword, " with a reference node on a body or with *TRANSFORM");
  if (!follower.set.empty())
    {
      if (!reading.use(keyword, follower.set, keyword.line))
        return;
      if (!reading.bodies.nodes_without_face(follower.set).empty())
        return reading.lacks(keyword, " of nodes that are not those of whole faces");
      follower.bodies = reading.bodies.bodies_of(follower.set);
    }
  reading.model.rigid_bodies.push_back(follower);
}

/// Return the components, from 0, in the data lines "first, last" of a keyword, or all if there are
/// no lines.
std::set<unsigned int> components_of(const Reading &reading, const Keyword &keyword)
{
  std::set<unsigned int> result;
  reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
    const auto first = to_whole(words[0], line);
    const auto last  = words.size() > 1 && !words[1].empty() ? to_whole(words[1], line) : first;
    if (first < 1 || last < first || last > 6)
      throw error_at_line(line, "the first and the last component of " + keyword.title +
                                  " must be numbers from 1 to 6 in ascending order");
    for (auto c = first; c <= last; ++c)
      result.insert(c - 1);
  });
  return result.empty() ? std::set<unsigned int>{0, 1, 2, 3, 4, 5} : result;
}

/// Read *COUPLING and the next keyword, which is *KINEMATIC or *DISTRIBUTING.
void read_coupling(Reading &reading, const Keyword &coupling)
{
  const auto &keyword = &coupling == &reading.text.keywords().back() ? coupling : *(&coupling + 1);
  if (keyword.name != "KINEMATIC" && keyword.name != "DISTRIBUTING")
    throw keyword_error(coupling, "*COUPLING must be followed by *KINEMATIC or *DISTRIBUTING");
  if (!coupling.has("SURFACE"))
    throw keyword_error(coupling, "*COUPLING must have a SURFACE");
  DeckModel::RigidBody follower{one_node(coupling, "REF NODE", reading.deck.sets), {}, "", 0};
  follower.line            = keyword.line;
  follower.set             = reading.surface(coupling.option("SURFACE"), coupling.line);
  follower.is_distributing = keyword.name == "DISTRIBUTING";
  follower.components      = components_of(reading, keyword);
  if (keyword.has("WEIGHTINGMETHOD") && upper_case(keyword.option("WEIGHTINGMETHOD")) != "UNIFORM")
    reading.lacks(keyword, " with weights by distance");
  for (unsigned int c = 0; c < reading.bodies.dimension() && !follower.is_distributing; ++c)
    if (follower.components.count(c) == 0)
      return reading.lacks(keyword, " of some components only");
  add_follower(reading, keyword, follower);
}

/// Require *COUPLING before *KINEMATIC or *DISTRIBUTING, which are read with it.
void require_coupling(const Reading &reading, const Keyword &keyword)
{
  if (&keyword == &reading.text.keywords().front() || (&keyword - 1)->name != "COUPLING")
    throw keyword_error(keyword, keyword.title + " must follow *COUPLING");
}

/// Read *RIGID BODY of nodes, cells, rigid elements or an analytical surface.
void read_rigid_body(Reading &reading, const Keyword &keyword)
{
  const auto            &sets = reading.deck.sets;
  DeckModel::RigidBody   rigid{one_node(keyword, "REF NODE", sets), {}, "", keyword.line};
  auto                   nodes = rigid;
  std::set<unsigned int> cells;
  rigid.surface = upper_case(keyword.option("ANALYTICALSURFACE"));
  if (keyword.has("ELSET"))
    for (const unsigned int e :
         sets.elements(keyword.option("ELSET"), "", keyword.title, keyword.line))
      {
        const auto &element = reading.deck.mesh.elements[e];
        if (mesh_file::dimension(element.shape) + 1 == reading.bodies.dimension())
          rigid.faces.insert(geometry::sorted(element.corners));
        else
          cells.insert(e);
      }
  std::size_t n = 0;
  for (unsigned int b = 0; b < reading.bodies.all().size(); ++b)
    if (const auto &elements = reading.bodies.all()[b].elements; cells.count(elements[0]) > 0)
      {
        rigid.bodies.push_back(b);
        n += elements.size();
      }
  if (n != cells.size())
    return reading.lacks(keyword, " of elements that are not those of whole bodies");
  for (const std::string option : {"NSET", "PINNSET", "TIENSET"})
    if (keyword.has(option))
      {
        const auto key = sets.find(sets.of_nodes, keyword.option(option), "");
        if (key.empty())
          throw keyword_error(keyword, "there is no node set '" + keyword.option(option) + "'");
        nodes.set = sets.boundary_of_nodes(key);
        add_follower(reading, keyword, nodes);
      }
  if (!rigid.faces.empty() || !rigid.surface.empty() || !rigid.bodies.empty())
    add_follower(reading, keyword, rigid);
  else if (nodes.set.empty() && cells.empty())
    throw keyword_error(keyword,
                        "*RIGID BODY must have an NSET, an ELSET or an ANALYTICAL SURFACE");
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

template <int dim>
std::vector<double> numbers(const dealii::Tensor<1, dim> &v)
{
  std::vector<double> result;
  for (unsigned int d = 0; d < dim; ++d)
    result.push_back(rounded(v[d], v.norm()));
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

unsigned int
one_node(const Keyword &keyword, const std::string &option, const mesh_file::DeckSets &sets)
{
  const auto word  = keyword.option(option == "NODE" ? option : option.substr(0, 3) + "NODE");
  const auto nodes = word.empty() ? Corners() : sets.nodes(word, "", keyword.title, keyword.line);
  if (nodes.size() != 1)
    throw keyword_error(keyword, keyword.title + " must have one " + option);
  return nodes[0];
}

std::map<Freedom, Freedom> reference_freedoms(const mesh_file::DeckText &text,
                                              const mesh_file::DeckSets &sets)
{
  std::map<Freedom, Freedom> freedoms;
  for (const auto &keyword : text.keywords())
    if (keyword.name == "PRE-TENSIONSECTION")
      {
        const auto node     = one_node(keyword, "NODE", sets);
        freedoms[{node, 0}] = {node, 0};
      }
    else if (keyword.name == "RIGIDBODY" || keyword.name == "COUPLING")
      {
        const auto node      = one_node(keyword, "REF NODE", sets);
        const bool is_split  = keyword.has("ROTNODE");
        const auto rotations = is_split ? one_node(keyword, "ROT NODE", sets) : node;
        if (is_split && rotations == node)
          throw keyword_error(keyword, "the ROT NODE of *RIGID BODY must not be its REF NODE");
        for (unsigned int c = 0; c < 3; ++c)
          {
            freedoms[{node, c}]                         = {node, c};
            freedoms[{rotations, is_split ? c : c + 3}] = {node, c + 3};
          }
      }
  return freedoms;
}

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
  const auto by = [&reading](const auto read) {
    return [&reading, read](const Keyword &keyword) { read(reading, keyword); };
  };
  return {{"RIGIDBODY",
           {by(read_rigid_body),
            {{"REFNODE", "ROTNODE", "NSET", "PINNSET", "TIENSET", "ELSET", "ANALYTICALSURFACE"},
             {}},
            false}},
          {"COUPLING", {by(read_coupling), {{"REFNODE", "SURFACE", "CONSTRAINTNAME"}, {}}, false}},
          {"KINEMATIC", {by(require_coupling)}},
          {"DISTRIBUTING", {by(require_coupling), {{"WEIGHTINGMETHOD"}, {"COUPLING"}}}}};
}
} // namespace snug::deck
