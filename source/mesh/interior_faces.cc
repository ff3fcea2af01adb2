#include <snug/base/assertions.h>
#include <snug/mesh/interior_faces.h>

#include <deal.II/grid/tria.h>

namespace snug::mesh {
namespace {
constexpr unsigned int none = static_cast<unsigned int>(-1);

/// Numbers of the owned cells and the required ghost cells of a rank.
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

  /// Return the number of a cell. A cell of another rank gets the next number and is added to
  /// @p ghosts on the first call.
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

/// Return the vertex of a cell on @p face that is at the lower end along all axes of the face
/// except @p along, and at the upper end along @p along.
template <int dim>
unsigned int vertex_of_face(const unsigned int face, const unsigned int along)
{
  const unsigned int side = (face % 2) << (face / 2);
  return along == none ? side : side | (1u << along);
}

/// Return the number in @p cell of the vertex with the number @p vertex in the mesh.
template <typename Cell>
unsigned int number_in(const Cell &cell, const unsigned int vertex)
{
  unsigned int v = 0;
  while (cell->vertex_index(v) != vertex)
    {
      ++v;
      SNUG_ASSERT_BELOW(v, cell->n_vertices());
    }
  return v;
}

/// Set origin and axes of @p face. @p whole is the cell or, if the neighbour is coarser, the parent
/// of the cell.
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
        // The numbers of the two vertices of an edge differ in the bit of the axis of the edge.
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

/// At a face between cells of different levels, only the finer cell has an active neighbour, so the
/// loop visits the face once. The loop visits a face between cells of equal size twice.
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
          // Of two cells of equal size, the owned cell lists the face. If both cells are owned, the
          // first cell lists the face.
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
