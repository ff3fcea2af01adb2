#include <snug/contact/contact.h>
#include <snug/faces/quadratic_triangle.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace snug::contact {
namespace {
/// Rows of three nodes in a line: an end, the middle and the other end.
using Line = std::array<unsigned int, 3>;

/// The lines that contain a node.
struct LinesOfNode
{
  std::vector<Line> as_middle, as_end;
};

/// Return the lines of three nodes with rows along all directions of the faces.
template <int dim>
std::set<Line> lines_of_faces(const mesh::Surface<dim>                   &surface,
                              const std::vector<unsigned int>            &faces,
                              const std::map<unsigned int, unsigned int> &row_of_node)
{
  std::set<Line> result;
  for (const unsigned int face : faces)
    {
      const auto &nodes = surface.faces()[face].nodes;
      if (faces::quadratic_triangle(surface, face))
        continue;
      for (unsigned int stride = 1; stride < nodes.size(); stride *= 3)
        for (unsigned int first = 0; first < nodes.size(); ++first)
          {
            if (first / stride % 3 != 0)
              continue;
            Line line;
            bool has_rows = true;
            for (unsigned int k = 0; k < 3 && has_rows; ++k)
              {
                const auto row = row_of_node.find(nodes[first + k * stride]);
                has_rows       = row != row_of_node.end();
                line[k]        = has_rows ? row->second : 0;
              }
            if (line[0] > line[2])
              std::swap(line[0], line[2]);
            if (has_rows)
              result.insert(line);
          }
    }
  return result;
}
} // namespace

template <int dim>
std::vector<Weights> Contact<dim>::pressure_reading(const std::vector<double> &forces) const
{
  std::vector<Weights> result;
  if (shape.degree() == 1)
    return result;
  std::vector<std::map<unsigned int, double>> weights(n_rows());
  for (unsigned int row = 0; row < n_rows(); ++row)
    weights[row][row] = 1.;
  for (unsigned int p = 0; p < chosen.size(); ++p)
    {
      std::map<unsigned int, unsigned int> row_of_node;
      for (unsigned int row = 0; row < n_rows(); ++row)
        if (row_places[row].pair == p && forces[row] > 0.)
          row_of_node[row_places[row].slave] = row;
      std::map<unsigned int, LinesOfNode> lines;
      for (const Line &line :
           lines_of_faces(surface, faces_of(surface, chosen[p].slave), row_of_node))
        {
          lines[line[1]].as_middle.push_back(line);
          for (const unsigned int end : {line[0], line[2]})
            lines[end].as_end.push_back(line);
        }
      for (const auto &[row, of_row] : lines)
        {
          const auto add = [&weights = weights[row]](const Line &line, const double factor) {
            weights[line[0]] += factor;
            weights[line[1]] -= 2. * factor;
            weights[line[2]] += factor;
          };
          for (const Line &line : of_row.as_middle)
            add(line, -0.25);
          // Where faces meet at an end, both have a line along each direction.
          const double n_directions = dim - 1. - double(of_row.as_middle.size());
          for (const Line &line : of_row.as_end)
            add(line, 0.5 * n_directions / double(of_row.as_end.size()));
        }
    }
  for (const auto &of_row : weights)
    result.emplace_back(of_row.begin(), of_row.end());
  return result;
}

template std::vector<Weights> Contact<2>::pressure_reading(const std::vector<double> &) const;
template std::vector<Weights> Contact<3>::pressure_reading(const std::vector<double> &) const;
} // namespace snug::contact
