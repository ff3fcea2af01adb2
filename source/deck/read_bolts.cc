#include <snug/deck/keyword_reader.h>

#include <algorithm>

namespace snug::deck {
using mesh_file::Keyword;
using mesh_file::keyword_error;

namespace {
using Vector = dealii::Tensor<1, 3>;

/// Largest angle between a normal that is given and that of the faces: 1 - cos(1 degree).
const double oblique = 1.5e-4;

/// Return the mean normal of the faces of a set out of their body.
Vector normal_of(const DeckBodies &bodies, const std::string &set)
{
  Vector sum;
  for (const auto &face : bodies.faces_of(set))
    {
      std::vector<dealii::Point<3>> X;
      for (const unsigned int corner : face)
        X.push_back(bodies.point(corner));
      // Edges are faces of the height 1. The corners of faces are clockwise, seen from outside.
      if (bodies.dimension() == 2)
        X.push_back(X[1] - Vector({0., 0., 1.}));
      for (std::size_t i = 2; i < X.size(); ++i)
        sum -= cross_product_3d(X[i - 1] - X[0], X[i] - X[0]);
    }
  return sum / sum.norm();
}

/// Read a cut across a shank, and the direction of its force if there is one.
void read_section(Reading &reading, const Keyword &keyword)
{
  if (keyword.has("ELEMENT"))
    return reading.lacks(keyword, " of a beam");
  const auto node     = one_node(keyword, "NODE", reading.deck.sets);
  const auto side     = reading.surface(keyword.option("SURFACE"), keyword.line);
  const auto opposite = side + " opposite";
  auto      &bolts    = reading.model.bolts;
  if (reading.bodies.body_at(node) || reading.references.count({node, 1}) > 0 ||
      std::any_of(bolts.begin(), bolts.end(), [&](const auto &b) { return b.node == node; }))
    throw keyword_error(keyword, "the NODE of " + keyword.title +
                                   " must belong to no element, rigid body or other section");
  if (!reading.use(keyword, side, keyword.line) || !reading.use(keyword, opposite, keyword.line))
    return;
  auto values = reading.first_line(keyword);
  values.resize(3, 0.);
  const Vector given({values[0], values[1], values[2]});
  const double along =
    given.norm() > 0. ? given * normal_of(reading.bodies, side) / given.norm() : 1.;
  if (std::abs(along) < 1. - oblique)
    return reading.lacks(keyword, " along a direction that is not the normal of its faces");
  const auto         a = reading.bodies.bodies_of(side)[0];
  const auto         b = reading.bodies.bodies_of(opposite)[0];
  DeckModel::Contact cut{side, opposite, a, b, "", 0., keyword.line};
  cut.is_tied = true;
  reading.model.contacts.push_back(cut);
  bolts.push_back(
    {"bolt-" + std::to_string(bolts.size() + 1), cut, node, along < 0. ? -1. : 1., keyword.line});
}
} // namespace

KeywordReadings bolt_readings(Reading &reading)
{
  return {{"PRE-TENSIONSECTION",
           {[&reading](const Keyword &keyword) { read_section(reading, keyword); },
            {{"SURFACE", "NODE", "ELEMENT"}, {}}}}};
}
} // namespace snug::deck
