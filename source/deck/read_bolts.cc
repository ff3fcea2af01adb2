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
  const auto  node     = one_node(keyword, "NODE", reading.deck.sets);
  const auto  values   = reading.first_line(keyword);
  auto       &bolts    = reading.model.bolts;
  const auto &sections = reading.deck.sections;
  const auto  section  = *std::find_if(sections.begin(), sections.end(), [&](const auto &other) {
    return other.begin == keyword.begin;
  });
  if (reading.bodies.body_at(node) || reading.references.count({node, 1}) > 0 ||
      std::any_of(bolts.begin(), bolts.end(), [&](const auto &b) { return b.node == node; }))
    throw keyword_error(keyword, "the NODE of " + keyword.title +
                                   " must belong to no element, rigid body or other section");
  if (!reading.use(keyword, section.side, keyword.line) ||
      !reading.use(keyword, section.opposite, keyword.line))
    return;
  const auto a = reading.bodies.bodies_of(section.side);
  const auto b = reading.bodies.bodies_of(section.opposite);
  if (a.size() != 1 || b.size() != 1 || a == b)
    throw keyword_error(keyword, "surface '" + section.side + "' of " + keyword.title +
                                   " must cut one body in two pieces");
  Vector given;
  for (std::size_t d = 0; d < values.size(); ++d)
    given[d] = values[d];
  const double along =
    given.norm() > 0. ? given * normal_of(reading.bodies, section.side) / given.norm() : 1.;
  if (std::abs(along) < 1. - oblique)
    return reading.lacks(keyword, " along a direction that is not the normal of its faces");
  const DeckModel::Contact cut{section.side, section.opposite, a[0], b[0],  "",
                               0.,           keyword.line,     {},   false, 0.,
                               true};
  reading.model.contacts.push_back(cut);
  bolts.push_back({cut, node, along < 0. ? -1. : 1., keyword.line});
}
} // namespace

KeywordReadings bolt_readings(Reading &reading)
{
  return {{"PRE-TENSIONSECTION",
           {[&reading](const Keyword &keyword) { read_section(reading, keyword); },
            {{"SURFACE", "NODE", "ELEMENT"}, {}}}}};
}
} // namespace snug::deck
