#include <snug/mesh/body_mesh.h>
#include <snug/mesh/quadratic_elements.h>
#include <snug/mesh/tetrahedron.h>

#include <algorithm>
#include <map>

namespace snug::mesh {
namespace {
constexpr unsigned int missing = static_cast<unsigned int>(-1);

/// Set the corner of the cell and the middles of the edges along its axes.
void set_nodes(Tetrahedron                     &tetrahedron,
               const unsigned int               corner,
               const std::vector<unsigned int> &of_cell)
{
  tetrahedron.nodes[corner] = of_cell[0];
  for (unsigned int d = 0, end = 2; d < 3; ++d, end *= 3)
    tetrahedron.nodes[Tetrahedron::middle(corner, tetrahedron_axes[corner][d])] = of_cell[end];
}
} // namespace

unsigned int Tetrahedron::middle(const unsigned int corner, const unsigned int other)
{
  constexpr unsigned int of_edge[4][4] = {{missing, 4, 6, 7},
                                          {4, missing, 5, 8},
                                          {6, 5, missing, 9},
                                          {7, 8, 9, missing}};
  return of_edge[corner][other];
}

std::array<unsigned int, 6> Tetrahedron::face(const unsigned int opposite) const
{
  constexpr unsigned int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const auto            &of_face       = corners[opposite];
  return {{nodes[of_face[0]], nodes[of_face[1]], nodes[of_face[2]],
           nodes[middle(of_face[0], of_face[1])], nodes[middle(of_face[1], of_face[2])],
           nodes[middle(of_face[2], of_face[0])]}};
}

template <int dim>
std::vector<Tetrahedron> find_tetrahedra(const BodyMesh<dim> &mesh)
{
  std::vector<Tetrahedron> result;
  if (dim == 2 || mesh.degree() != 2)
    return result;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> number; // of body and element
  for (unsigned int index = 0; index < mesh.cells().size(); ++index)
    {
      const auto &cell = mesh.cells()[index];
      // The node in the middle of a cell hangs only if its element is constrained.
      if (!mesh.is_hanging(cell.nodes[cell.nodes.size() / 2]))
        continue;
      const auto part =
        mesh.geometry(cell.body).element_part(mesh.coarse_cells().coarse_cell(mesh.cell_id(index)));
      if (part.n_corners != 4 || !std::equal(part.towards.begin(), part.towards.end(),
                                             tetrahedron_axes[part.corner].begin()))
        continue;
      const auto entry = number.emplace(std::make_pair(cell.body, part.element), result.size());
      if (entry.second)
        {
          result.emplace_back();
          result.back().cells.fill(missing);
        }
      auto &tetrahedron              = result[entry.first->second];
      tetrahedron.cells[part.corner] = index;
      set_nodes(tetrahedron, part.corner, cell.nodes);
    }
  // Without tearing, cells of an element may be on several ranks. Formulas may give them several
  // regions.
  const auto is_divided = [&](const Tetrahedron &tetrahedron) {
    return std::any_of(tetrahedron.cells.begin(), tetrahedron.cells.end(), [&](const auto cell) {
      return cell == missing ||
             mesh.cells()[cell].region != mesh.cells()[tetrahedron.cells[0]].region;
    });
  };
  result.erase(std::remove_if(result.begin(), result.end(), is_divided), result.end());
  return result;
}

const std::vector<double> &tetrahedron_functions(const unsigned int corner)
{
  static const auto of_corners = [] {
    std::array<std::vector<double>, 4> result;
    for (unsigned char c = 0; c < 4; ++c)
      {
        const geometry::ElementPart<3> part{0, 4, c, tetrahedron_axes[c]};
        for (const auto &weights : quadratic_weights(part))
          {
            const std::size_t first = result[c].size();
            result[c].resize(first + 10);
            for (const auto &[key, value] : weights)
              result[c][first + (key % 5 == 0 ? key / 5 : Tetrahedron::middle(key / 4, key % 4))] =
                value;
          }
      }
    return result;
  }();
  return of_corners[corner];
}

template std::vector<Tetrahedron> find_tetrahedra(const BodyMesh<2> &);
template std::vector<Tetrahedron> find_tetrahedra(const BodyMesh<3> &);
} // namespace snug::mesh
