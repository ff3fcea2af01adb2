#include <snug/faces/quadratic_triangle.h>

#include <algorithm>
#include <cmath>

namespace snug::faces {
namespace {
using Weights = std::vector<std::pair<unsigned int, double>>;

/// Return the nodes of @p weights with the weight @p value.
std::vector<unsigned int> nodes_with(const Weights &weights, const double value)
{
  std::vector<unsigned int> result;
  for (const auto &[node, weight] : weights)
    if (std::abs(weight - value) < 1e-10)
      result.push_back(node);
  return result;
}
} // namespace

template <int dim>
std::array<double, 3> QuadraticTriangle::linear_functions(const mesh::Surface<dim> &surface,
                                                          const unsigned int        node) const
{
  const auto &masters  = surface.masters(node);
  const auto  value_of = [&](const unsigned int other) {
    if (masters.empty())
      return other == node ? 1. : 0.;
    const auto found = std::find_if(masters.begin(), masters.end(),
                                     [&](const auto &master) { return master.first == other; });
    return found == masters.end() ? 0. : found->second;
  };
  std::array<double, 3> result;
  for (unsigned int k = 0; k < 3; ++k)
    // A linear function is the sum of its values at the six nodes times their quadratic functions.
    result[k] = 1. - 2. * (value_of(corners[k]) + 0.5 * value_of(middles[(k + 1) % 3]) +
                           0.5 * value_of(middles[(k + 2) % 3]));
  return result;
}

/// At the middle of the triangle, the functions of the corners are -1/9 and those of the middles of
/// edges 4/9. At the middle between a corner and the middle of an edge, they are 3/8, 6/8 and, at
/// the other corner, -1/8.
template <int dim>
std::optional<QuadraticTriangle> quadratic_triangle(const mesh::Surface<dim> &surface,
                                                    const unsigned int        face)
{
  const auto &nodes = surface.faces()[face].nodes;
  if (dim != 3 || nodes.size() != 9)
    return {};
  for (const unsigned int centre : {0, 2, 6, 8})
    {
      const auto &masters = surface.masters(nodes[centre]);
      const auto  corners = nodes_with(masters, -1. / 9.), middles = nodes_with(masters, 4. / 9.);
      if (masters.size() != 6 || corners.size() != 3 || middles.size() != 3)
        continue;
      QuadraticTriangle  result;
      const unsigned int own = nodes[8 - centre];
      result.corners[0]      = own;
      unsigned int n         = 1;
      for (const unsigned int node : nodes)
        {
          const auto &of_edge = surface.masters(node);
          const auto  ends = nodes_with(of_edge, -1. / 8.), on = nodes_with(of_edge, 6. / 8.);
          if (of_edge.size() != 3 || ends.size() != 1 || on.size() != 1 || ends[0] == own ||
              nodes_with(of_edge, 3. / 8.) != std::vector<unsigned int>{own} || n > 2)
            continue;
          // The edge from the own corner to corner n is opposite to the corner 3 - n.
          result.corners[n]     = ends[0];
          result.middles[3 - n] = on[0];
          ++n;
        }
      for (const unsigned int middle : middles)
        if (middle != result.middles[1] && middle != result.middles[2])
          result.middles[0] = middle;
      if (n == 3)
        return result;
    }
  return {};
}

template std::array<double, 3> QuadraticTriangle::linear_functions(const mesh::Surface<2> &,
                                                                   unsigned int) const;
template std::array<double, 3> QuadraticTriangle::linear_functions(const mesh::Surface<3> &,
                                                                   unsigned int) const;
template std::optional<QuadraticTriangle> quadratic_triangle(const mesh::Surface<2> &,
                                                             unsigned int);
template std::optional<QuadraticTriangle> quadratic_triangle(const mesh::Surface<3> &,
                                                             unsigned int);
} // namespace snug::faces
