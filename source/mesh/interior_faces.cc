#include <snug/mesh/interior_faces.h>

#include <deal.II/grid/tria.h>

namespace snug::mesh {
namespace {
constexpr unsigned int none = static_cast<unsigned int>(-1);

/// Numbers of the cells a rank knows.
class CellNumbers
{
public:
  template <int dim>
  explicit CellNumbers(const dealii::Triangulation<dim> &triangulation)
    : numbers(triangulation.n_active_cells(), none)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        numbers[cell->active_cell_index()] = next++;
  }

  /// That of a cell, which may be one of another rank.
  unsigned int of(const unsigned int active_index, std::vector<unsigned int> &ghosts)
  {
    unsigned int &number = numbers[active_index];
    if (number == none)
      {
        number = next++;
        ghosts.push_back(active_index);
      }
    return number;
  }

private:
  std::vector<unsigned int> numbers; ///< by active index
  unsigned int              next = 0;
};

/// Vertex of a cell that has the vertex @p v of a face at its lower end along all axes but
/// @p along, where it is at the upper.
template <int dim>
unsigned int vertex_of_face(const unsigned int face, const unsigned int along)
{
  const unsigned int side = (face % 2) << (face / 2);
  return along == none ? side : side | (1u << along);
}

/// Number in @p cell of the vertex that has the number @p vertex in the mesh.
template <typename Cell>
unsigned int number_in(const Cell &cell, const unsigned int vertex)
{
  unsigned int v = 0;
  while (cell->vertex_index(v) != vertex)
    {
      ++v;
      AssertIndexRange(v, cell->n_vertices());
    }
  return v;
}

/// @p whole: the cell or, if the neighbour is coarser, its parent.
template <int dim, typename Cell, typename Neighbour>
void orient(const Cell &whole, const Neighbour &neighbour, InteriorFace<dim> &face)
{
  const auto in_neighbour = [&](const unsigned int along) {
    return number_in(neighbour, whole->vertex_index(vertex_of_face<dim>(face.face, along)));
  };
  face.origin     = in_neighbour(none);
  unsigned int at = 0;
  for (unsigned int axis = 0; axis < dim; ++axis)
    if (axis != face.face / 2u)
      {
        // vertices of an edge differ by the bit of its axis
        const unsigned int step = in_neighbour(axis) ^ face.origin;
        face.axes[at++]         = step == 1 ? 0 : step == 2 ? 1 : 2;
      }
}
} // namespace

template <int dim>
dealii::Point<dim> InteriorFace<dim>::in_neighbour(const dealii::Point<dim> &in_cell) const
{
  dealii::Point<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = (origin >> d) & 1;
  unsigned int at = 0;
  for (unsigned int axis = 0; axis < dim; ++axis)
    if (axis != face / 2u)
      {
        const bool   is_part = child < (1u << dim);
        const double along =
          is_part ? 0.5 * (in_cell[axis] + ((child >> axis) & 1)) : in_cell[axis];
        const unsigned int other = axes[at++];
        result[other] += ((origin >> other) & 1) ? -along : along;
      }
  return result;
}

/// Across a face that hangs only the finer cell has an active neighbour, so each face comes up once
/// from there and twice where cells are equal.
template <int dim>
std::vector<InteriorFace<dim>> interior_faces(const dealii::Triangulation<dim, dim> &triangulation,
                                              std::vector<unsigned int>             &ghosts)
{
  ghosts.clear();
  CellNumbers                    numbers(triangulation);
  std::vector<InteriorFace<dim>> faces;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int f : cell->face_indices())
        {
          if (cell->at_boundary(f) || !cell->neighbor(f)->is_active())
            continue;
          const auto neighbour  = cell->neighbor(f);
          const bool is_coarser = cell->neighbor_is_coarser(f);
          if (neighbour->is_artificial() ||
              !(cell->is_locally_owned() || neighbour->is_locally_owned()))
            continue;
          // Of equals, one that is owned, and of two such the first.
          if (!is_coarser && (!cell->is_locally_owned() ||
                              (neighbour->is_locally_owned() &&
                               neighbour->active_cell_index() < cell->active_cell_index())))
            continue;
          InteriorFace<dim> face;
          face.cell      = numbers.of(cell->active_cell_index(), ghosts);
          face.neighbour = numbers.of(neighbour->active_cell_index(), ghosts);
          face.face      = f;
          face.child     = 1u << dim;
          if (is_coarser)
            {
              const auto parent = cell->parent();
              for (unsigned int c = 0; c < parent->n_children(); ++c)
                if (parent->child(c)->index() == cell->index())
                  face.child = c;
              orient(parent, neighbour, face);
            }
          else
            orient(cell, neighbour, face);
          faces.push_back(face);
        }
  return faces;
}

template struct InteriorFace<2>;
template struct InteriorFace<3>;
template std::vector<InteriorFace<2>> interior_faces(const dealii::Triangulation<2, 2> &,
                                                     std::vector<unsigned int> &);
template std::vector<InteriorFace<3>> interior_faces(const dealii::Triangulation<3, 3> &,
                                                     std::vector<unsigned int> &);
} // namespace snug::mesh
