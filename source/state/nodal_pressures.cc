#include <snug/faces/quadratic_triangle.h>
#include <snug/state/nodal_pressures.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

namespace snug::state {
namespace {
/// Lines whose lengths differ by more than this factor have no common alternation.
const double alike = 1.5;

/// Surface nodes of a line of three nodes: an end, the middle and the other end.
struct Line
{
  std::array<unsigned int, 3> nodes;

  unsigned int middle() const { return nodes[1]; }
  unsigned int end_opposite_to(const unsigned int end) const
  {
    return nodes[0] == end ? nodes[2] : nodes[0];
  }
  bool operator<(const Line &other) const { return nodes < other.nodes; }
};

/// Return the lines of the nodes of a face in tensor order along all of its directions.
std::vector<Line> lines_of(const std::vector<unsigned int> &nodes)
{
  std::vector<Line> result;
  for (unsigned int stride = 1; stride < nodes.size(); stride *= 3)
    for (unsigned int first = 0; first < nodes.size(); ++first)
      if (first / stride % 3 == 0)
        {
          const unsigned int last = first + 2 * stride;
          result.push_back({{{std::min(nodes[first], nodes[last]), nodes[first + stride],
                              std::max(nodes[first], nodes[last])}}});
        }
  return result;
}

/// The alternation of the means of one pair.
template <int dim>
class Alternation
{
public:
  /// @p means: positive means by their slave nodes.
  Alternation(const mesh::Surface<dim>             &surface,
              const contact::Side                  &slave,
              const std::map<unsigned int, double> &means)
    : X(surface.reference_positions()), means(means)
  {
    for (const unsigned int face : contact::faces_of(surface, slave))
      if (!faces::quadratic_triangle(surface, face))
        for (const Line &line : lines_of(surface.faces()[face].nodes))
          faces_of_line[line].insert(face);
    for (const auto &[line, on] : faces_of_line)
      for (const unsigned int end : {line.nodes[0], line.nodes[2]})
        lines_at[end].push_back(line);
  }

  /// Return the pressures minus the means by their slave nodes.
  std::map<unsigned int, double> corrections() const
  {
    std::map<unsigned int, double> result;
    for (const auto &[line, on] : faces_of_line)
      {
        const auto first = at_end(line, line.nodes[0]), last = at_end(line, line.nodes[2]);
        if (first || last)
          result[line.middle()] +=
            2. / 3. * (first && last ? 0.5 * (*first + *last) : first.value_or(last.value_or(0.)));
        for (const unsigned int end : {line.nodes[0], line.nodes[2]})
          {
            const bool is_first = end == line.nodes[0];
            const auto opposite = opposite_of(line, end);
            // Both lines at an end name it; each adds a half.
            if (const auto &a = opposite ? (is_first ? first : last) : (is_first ? last : first))
              result[end] -= 4. / 3. * *a * (opposite ? 0.5 : 1.);
          }
      }
    return result;
  }

private:
  /// Return the line that continues @p line beyond @p end: it has no face in common with it.
  std::optional<Line> opposite_of(const Line &line, const unsigned int end) const
  {
    std::optional<Line> result;
    const auto         &own = faces_of_line.at(line);
    for (const Line &other : lines_at.at(end))
      {
        const auto &on = faces_of_line.at(other);
        if (std::none_of(on.begin(), on.end(),
                         [&own](const unsigned int face) { return own.count(face) > 0; }))
          result = other;
      }
    return result;
  }

  double length(const Line &line) const { return (X[line.nodes[2]] - X[line.nodes[0]]).norm(); }

  /// Return half of the alternation at an @p end of @p line.
  std::optional<double> at_end(const Line &line, const unsigned int end) const
  {
    const auto opposite = opposite_of(line, end);
    if (!opposite || length(line) > alike * length(*opposite) ||
        length(*opposite) > alike * length(line))
      return {};
    double sum = 0.;
    for (const auto &[node, weight] :
         {std::pair(end, 6.), std::pair(line.middle(), -4.), std::pair(opposite->middle(), -4.),
          std::pair(line.end_opposite_to(end), 1.), std::pair(opposite->end_opposite_to(end), 1.)})
      {
        const auto mean = means.find(node);
        if (mean == means.end())
          return {};
        sum += weight * mean->second;
      }
    return sum / 16.;
  }

  const typename mesh::Surface<dim>::Field &X;
  const std::map<unsigned int, double>     &means;
  std::map<Line, std::set<unsigned int>>    faces_of_line;
  std::map<unsigned int, std::vector<Line>> lines_at;
};
} // namespace

template <int dim>
std::vector<double> nodal_pressures(const mesh::Surface<dim>    &surface,
                                    const contact::Contact<dim> &contact,
                                    const std::vector<double>   &means)
{
  auto result = means;
  for (unsigned int pair = 0; pair < contact.pairs().size(); ++pair)
    {
      std::map<unsigned int, double>       positive;
      std::map<unsigned int, unsigned int> rows;
      for (unsigned int row = 0; row < means.size(); ++row)
        if (contact.places()[row].pair == pair && means[row] > 0.)
          {
            positive[contact.places()[row].slave] = means[row];
            rows[contact.places()[row].slave]     = row;
          }
      const Alternation<dim> alternation(surface, contact.pairs()[pair].slave, positive);
      for (const auto &[node, correction] : alternation.corrections())
        if (const auto row = rows.find(node); row != rows.end())
          result[row->second] += correction;
    }
  return result;
}

template std::vector<double>
nodal_pressures(const mesh::Surface<2> &, const contact::Contact<2> &, const std::vector<double> &);
template std::vector<double>
nodal_pressures(const mesh::Surface<3> &, const contact::Contact<3> &, const std::vector<double> &);
} // namespace snug::state
