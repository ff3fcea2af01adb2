#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/element_split.h>

#include <algorithm>

namespace snug::mesh_file {
namespace {
using Corners = std::vector<unsigned int>;

bool has(const Corners &face, const unsigned int corner)
{
  return std::find(face.begin(), face.end(), corner) != face.end();
}

/// Return the face of @p shape that contains three corners. It is unique if one of the corners is
/// adjacent to the two others.
const Corners &face_with(const ElementShape shape,
                         const unsigned int a,
                         const unsigned int b,
                         const unsigned int c)
{
  for (const auto &face : faces_of(shape))
    if (has(face, a) && has(face, b) && has(face, c))
      return face;
  return faces_of(shape).front();
}
} // namespace

const std::vector<std::vector<unsigned int>> &faces_of(const ElementShape shape)
{
  using S                                              = ElementShape;
  static const std::map<S, std::vector<Corners>> faces = {
    {S::vertex, {}},
    {S::line, {}},
    {S::triangle, {{0, 1}, {1, 2}, {2, 0}}},
    {S::quadrilateral, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
    {S::tetrahedron, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
    {S::pyramid, {}},
    {S::prism, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}},
    {S::hexahedron,
     {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}}};
  return faces.at(shape);
}

const std::vector<std::vector<unsigned int>> &corner_neighbours(const ElementShape shape)
{
  // The neighbours n0, n1, n2 of a corner are right-handed: the edges to them have a positive
  // determinant in elements that are numbered as in ElementShape, and so have the parts at the
  // corners. Pyramids cannot be split, because four edges meet at their tips.
  using S                                                   = ElementShape;
  static const std::map<S, std::vector<Corners>> neighbours = {
    {S::vertex, {{}}},
    {S::line, {{1}, {0}}},
    {S::triangle, {{1, 2}, {2, 0}, {0, 1}}},
    {S::quadrilateral, {{1, 3}, {2, 0}, {3, 1}, {0, 2}}},
    {S::tetrahedron, {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {1, 0, 2}}},
    {S::pyramid, {}},
    {S::prism, {{1, 2, 3}, {2, 0, 4}, {0, 1, 5}, {5, 4, 0}, {3, 5, 1}, {4, 3, 2}}},
    {S::hexahedron,
     {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}}};
  return neighbours.at(shape);
}

bool is_cell_shape(const ElementShape shape)
{
  return shape == ElementShape::line || shape == ElementShape::quadrilateral ||
         shape == ElementShape::hexahedron;
}

std::vector<unsigned int> cell_vertices(const MeshFile::Element &element)
{
  // Elements number their corners around bottom and top, deal.II with the first coordinate fastest.
  // Corners 2 and 3 change places, and so do corners 6 and 7.
  auto vertices = element.corners;
  for (unsigned int v = 2; v + 1 < vertices.size(); v += 4)
    std::swap(vertices[v], vertices[v + 1]);
  return vertices;
}

unsigned int ElementSplit::middle(std::vector<unsigned int> corners)
{
  // Neighbours number a common edge or face in different orders, but must use the same point.
  std::sort(corners.begin(), corners.end());
  const auto entry = middles.emplace(corners, points.size());
  if (entry.second)
    {
      dealii::Point<3> sum;
      for (const unsigned int corner : corners)
        sum += points[corner];
      points.push_back(sum / double(corners.size()));
    }
  return entry.first->second;
}

std::vector<std::vector<unsigned int>> ElementSplit::parts(const MeshFile::Element &element)
{
  const auto global = [&](const Corners &local) {
    Corners result;
    for (const unsigned int corner : local)
      result.push_back(element.corners[corner]);
    return result;
  };
  std::vector<Corners> result;
  const auto          &neighbours = corner_neighbours(element.shape);
  for (unsigned int corner = 0; corner < neighbours.size(); ++corner)
    {
      const auto &ends = neighbours[corner];
      Corners     part;
      // The bits of v are the edges along which the vertex lies: no edge gives the corner itself,
      // one edge its middle, two edges the middle of their face, all edges the middle of the
      // element.
      for (unsigned int v = 0; v < 1u << ends.size(); ++v)
        {
          Corners towards = {corner};
          for (unsigned int d = 0; d < ends.size(); ++d)
            if ((v >> d & 1) == 1)
              towards.push_back(ends[d]);
          if (towards.size() == 1)
            part.push_back(element.corners[corner]);
          else if (towards.size() == ends.size() + 1)
            part.push_back(middle(element.corners));
          else if (towards.size() == 2)
            part.push_back(middle(global(towards)));
          else
            part.push_back(
              middle(global(face_with(element.shape, towards[0], towards[1], towards[2]))));
        }
      result.push_back(part);
    }
  return result;
}

ElementShape face_shape(const std::vector<unsigned int> &corners)
{
  return corners.size() == 2   ? ElementShape::line
         : corners.size() == 3 ? ElementShape::triangle
                               : ElementShape::quadrilateral;
}

std::vector<std::vector<unsigned int>> outer_faces(const std::vector<MeshFile::Element> &cells)
{
  using Corners = std::vector<unsigned int>;
  std::map<Corners, std::pair<unsigned int, Corners>> count;
  for (const auto &cell : cells)
    for (const auto &local : faces_of(cell.shape))
      {
        Corners face;
        for (const unsigned int corner : local)
          face.push_back(cell.corners[corner]);
        auto &entry = count[geometry::sorted(face)];
        ++entry.first;
        entry.second = face;
      }
  std::vector<Corners> result;
  for (const auto &entry : count)
    if (entry.second.first == 1)
      result.push_back(entry.second.second);
  return result;
}
} // namespace snug::mesh_file
