#include <snug/deck/local_axes.h>

#include <algorithm>
#include <cmath>

namespace snug::deck {
using Direction = LocalAxes::Direction;
using Point     = dealii::Point<3>;
using mesh_file::keyword_error;
using mesh_file::upper_case;

namespace {
Direction unit(const Direction &direction)
{
  return direction.norm() > 0. ? direction / direction.norm() : direction;
}

/// Return the axes (e0, e1, e2) with e0 along @p first and e1 in the plane of the two vectors.
std::array<Direction, 3> right_handed(const Direction &first, const Direction &second)
{
  const auto e0 = unit(first);
  const auto e1 = unit(second - (second * e0) * e0);
  return {{e0, e1, dealii::cross_product_3d(e0, e1)}};
}
} // namespace

LocalAxes::LocalAxes(const mesh_file::DeckText &text, const mesh_file::DeckMesh &deck) : deck(deck)
{
  for (const auto &keyword : text.keywords())
    if (keyword.name == "TRANSFORM")
      {
        std::vector<double> numbers;
        text.for_each_line(keyword, [&](const auto &words, const unsigned long line) {
          const auto more = mesh_file::numbers_from(words, 0, line);
          numbers.insert(numbers.end(), more.begin(), more.end());
        });
        const auto type = upper_case(keyword.option("TYPE"));
        numbers.resize(6, 0.);
        Axes       of{type == "C", Point(numbers[0], numbers[1], numbers[2]),
                Point(numbers[3], numbers[4], numbers[5]), keyword.line};
        const bool is_regular =
          of.is_cylindrical ? of.a.distance(of.b) > 0. : cross_product_3d(of.a, of.b).norm() > 0.;
        if ((!type.empty() && type != "R" && type != "C") || !is_regular)
          throw keyword_error(keyword, "*TRANSFORM must have TYPE R with two directions, or C with "
                                       "two points of the axis");
        axes.push_back(of);
        for (const unsigned int node :
             deck.sets.nodes(keyword.option("NSET"), "", keyword.title, keyword.line))
          of_nodes[node] = axes.size() - 1;
      }
}

Direction
LocalAxes::direction_at(const Axes &of, const Point &x, const unsigned int component) const
{
  if (!of.is_cylindrical)
    return right_handed(of.a, of.b)[component];
  const auto axis   = unit(of.b - of.a);
  const auto radius = right_handed(axis, x - of.a)[1];
  return component == 0 ? radius : component == 1 ? dealii::cross_product_3d(axis, radius) : axis;
}

Direction LocalAxes::direction(const unsigned int node, const unsigned int component) const
{
  const auto found = of_nodes.find(node);
  if (found != of_nodes.end())
    return direction_at(axes[found->second], deck.mesh.points[node], component);
  Direction result;
  result[component] = 1.;
  return result;
}

std::optional<std::pair<unsigned int, double>> LocalAxes::axis(const std::set<unsigned int> &nodes,
                                                               const unsigned int component) const
{
  const double least_cosine = 1. - 1e-9;
  for (unsigned int c = 0; c < 3; ++c)
    for (const double sign : {1., -1.})
      {
        bool is_along = true;
        for (const unsigned int node : nodes)
          is_along = is_along && sign * direction(node, component)[c] > least_cosine;
        if (is_along)
          return std::make_pair(c, sign);
      }
  return {};
}

std::optional<LocalAxes::Axes> LocalAxes::cylinder(const std::set<unsigned int> &nodes) const
{
  std::optional<Axes> result;
  for (const unsigned int node : nodes)
    {
      const auto found = of_nodes.find(node);
      if (found == of_nodes.end() || !axes[found->second].is_cylindrical ||
          direction(node, 0).norm() == 0. || (result && !(*result == axes[found->second])))
        return {};
      result = axes[found->second];
    }
  return result;
}

bool LocalAxes::is_normal(const std::vector<unsigned int> &corners,
                          const unsigned int               component) const
{
  const double least_cosine = std::cos(5. * dealii::numbers::PI / 180.);
  const auto  &points       = deck.mesh.points;
  // A plane face has the cross products of its edges, and the normal of an edge is in the plane x,
  // y.
  const auto along = points[corners[1]] - points[corners[0]];
  const auto other =
    corners.size() > 2 ? points[corners[2]] - points[corners[0]] : Direction({0., 0., 1.});
  const auto normal = unit(dealii::cross_product_3d(along, other));
  return std::all_of(corners.begin(), corners.end(), [&](const unsigned int corner) {
    return has(corner) && std::abs(direction(corner, component) * normal) > least_cosine;
  });
}
} // namespace snug::deck
