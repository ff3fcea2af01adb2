#include <snug/geometry/entry_values.h>
#include <snug/mesh_file/element_split.h>
#include <snug/mesh_file/file_cells.h>
#include <snug/mesh_file/mesh_text.h>

#include <deal.II/base/tensor.h>

#include <set>

namespace snug::mesh_file {
namespace {
using Element = MeshFile::Element;

/// Return whether one of the groups of @p element is in @p regions, or @p regions is empty.
bool is_wanted(const Element &element, const std::vector<std::string> &regions)
{
  for (const auto &group : element.groups)
    if (std::find(regions.begin(), regions.end(), group) != regions.end())
      return true;
  return regions.empty();
}

/// Check that the file has all @p regions.
void check_regions(const std::vector<std::string> &regions, const std::set<std::string> &known)
{
  for (const auto &region : regions)
    if (known.count(region) == 0)
      throw bad_entry("Mesh regions", to_text(regions),
                      "'" + region + "' is not a region of the file, which has " +
                        (known.empty()
                           ? "no regions"
                           : "the regions " +
                               to_text(std::vector<std::string>(known.begin(), known.end()))));
}

[[noreturn]] void throw_without_cells(const MeshFile &file, unsigned int dim)
{
  const bool has_faces =
    std::any_of(file.elements.begin(), file.elements.end(),
                [](const Element &element) { return dimension(element.shape) == 2; });
  const std::string counts = count_shapes(file.elements);
  throw InputError(
    std::string("the file has no ") +
    (dim == 3 ? "tetrahedra, prisms or hexahedra, which Dimension = 3 "
                "needs to fill the body"
              : "triangles or quadrilaterals, which Dimension = 2 "
                "needs") +
    "; it has " + (counts.empty() ? "only points" : counts) +
    (has_faces ? ": shells, membranes, rigid elements or faces, without a volume" : ""));
}

/// Check that all cells of a plane mesh have the same z. Elements of other regions and isolated
/// points may have another z.
void check_plane(const std::vector<Element> &cells, const std::vector<dealii::Point<3>> &points)
{
  for (const auto &cell : cells)
    for (const unsigned int corner : cell.corners)
      // The comparison is exact, because programs write the same z for all nodes of a plane mesh.
      if (points[corner][2] != points[cells[0].corners[0]][2])
        throw element_error(cell, "is not in the plane of the other elements: its z is " +
                                    std::to_string(points[corner][2]));
}

/// Return 1 if the element is convex and right-handed at all corners, -1 if it is left-handed at
/// all corners, or else 0.
template <int dim>
int orientation(const Element &element, const std::vector<dealii::Point<3>> &points)
{
  // The triple product of the edges at a corner is the Jacobian determinant there, up to a
  // factor. In quadrilaterals the determinant is linear, so that its sign at the corners is its
  // sign everywhere. Hexahedra may still be inverted inside.
  int         sum        = 0;
  const auto &neighbours = corner_neighbours(element.shape);
  for (unsigned int c = 0; c < neighbours.size(); ++c)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < dim; ++i)
          edges[d][i] =
            points[element.corners[neighbours[c][d]]][i] - points[element.corners[c]][i];
      const double volume = determinant(edges);
      sum += volume > 0. ? 1 : volume < 0. ? -1 : 0;
    }
  const int n = neighbours.size();
  return sum == n ? 1 : sum == -n ? -1 : 0;
}

/// Reverse the orientation of an element.
void turn(Element &element)
{
  auto             &c = element.corners;
  const std::size_t n = c.size();
  // The first corner of plane elements and tetrahedra is kept. Bottom and top of prisms and
  // hexahedra are swapped.
  if (n == 3 || element.shape == ElementShape::tetrahedron)
    std::swap(c[1], c[2]);
  else if (n == 4)
    std::swap(c[1], c[3]);
  else
    std::swap_ranges(c.begin(), c.begin() + n / 2, c.begin() + n / 2);
}

/// Throw if a plane element that was turned is inverted: its edges had the directions that the
/// edges of its neighbours require, so that after the turn both run along an edge in one direction.
void require_consistent_edges(const std::vector<Element>  &cells,
                              const std::set<std::size_t> &turned)
{
  std::map<std::pair<unsigned int, unsigned int>, std::size_t> cell_at;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t k = 0; k < cells[i].corners.size(); ++k)
      {
        const auto &c              = cells[i].corners;
        const auto [found, is_new] = cell_at.insert({{c[k], c[(k + 1) % c.size()]}, i});
        if (!is_new && turned.count(i) + turned.count(found->second) > 0)
          throw element_error(cells[turned.count(i) > 0 ? i : found->second], "is inverted");
      }
}

/// Turn left-handed elements, because some programs number elements in the opposite order: plane
/// elements of a surface whose normal points down, prisms of VTK, whose first triangle has its
/// normal away from the second one, and converted hexahedra. In space all elements of a shape are
/// turned, or none: if some of them are right-handed, then a left-handed element is an error.
template <int dim>
void turn_mirrored(std::vector<Element>                &cells,
                   const std::vector<dealii::Point<3>> &points,
                   std::vector<std::string>            &notes)
{
  std::map<ElementShape, bool> right;
  for (const auto &cell : cells)
    {
      if (corner_neighbours(cell.shape).empty())
        throw element_error(cell, "is a pyramid, which cannot be split into "
                                  "hexahedra");
      right[cell.shape] = right[cell.shape] || orientation<dim>(cell, points) == 1;
    }
  std::set<std::size_t> turned;
  for (std::size_t i = 0; i < cells.size(); ++i)
    {
      Element  &cell = cells[i];
      const int sign = orientation<dim>(cell, points);
      if (sign == 0)
        throw element_error(cell, "is inverted at a corner or flat");
      if (sign > 0)
        continue;
      if (dim == 3 && right[cell.shape])
        throw element_error(cell, "is inverted");
      turn(cell);
      turned.insert(i);
    }
  if (dim == 2)
    require_consistent_edges(cells, turned);
  if (!turned.empty())
    notes.push_back(counted(turned.size(), dim == 2 ? "clockwise element" : "left-handed element") +
                    " turned around");
}
} // namespace

template <int dim>
std::vector<MeshFile::Element> body_cells(const MeshFile                 &file,
                                          const std::vector<std::string> &regions,
                                          std::vector<std::string>       &notes)
{
  std::vector<Element>  cells;
  std::set<std::string> known;
  for (const auto &element : file.elements)
    if (dimension(element.shape) == dim)
      {
        known.insert(element.groups.begin(), element.groups.end());
        if (is_wanted(element, regions))
          cells.push_back(element);
      }
  check_regions(regions, known);
  if (cells.empty())
    throw_without_cells(file, dim);
  for (const auto &element : file.elements)
    if (dimension(element.shape) > dim && is_wanted(element, regions))
      throw element_error(element, "is a solid, but Dimension = 2");
  if (dim == 2)
    check_plane(cells, file.points);
  turn_mirrored<dim>(cells, file.points, notes);
  return cells;
}

InputError element_error(const MeshFile::Element &element, const std::string &message)
{
  return error_at_line(element.line, "element " + std::to_string(element.number) + " " + message);
}

template std::vector<MeshFile::Element>
body_cells<2>(const MeshFile &, const std::vector<std::string> &, std::vector<std::string> &);
template std::vector<MeshFile::Element>
body_cells<3>(const MeshFile &, const std::vector<std::string> &, std::vector<std::string> &);
} // namespace snug::mesh_file
