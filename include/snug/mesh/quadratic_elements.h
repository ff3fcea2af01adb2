#ifndef snug_mesh_quadratic_elements_h
#define snug_mesh_quadratic_elements_h

#include <snug/mesh/forest.h>
#include <snug/mesh/partition.h>

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>

namespace snug::mesh {
/// Nodes of the quadratic element with the values of their shape functions at a point, without
/// zeros. The key of a node has one digit 4 a + b in base 16 per factor of the element, where a <=
/// b are the corners of an edge of the factor, and a = b a corner.
using QuadraticWeights = std::vector<std::pair<unsigned int, double>>;

/// Return the values at the 3^dim nodes of a cell, in tensor-product order.
template <int dim>
std::vector<QuadraticWeights> quadratic_weights(const geometry::ElementPart<dim> &part);

/**
 * This class finds the elements of mesh files that were split into cells, and constrains the nodes
 * of degree 2 of their cells such that the functions on the cells are the quadratic functions of
 * the elements: P2 on triangles and tetrahedra, products of P2 along the triangle and the axis on
 * prisms, biquadratic and triquadratic functions on quadrilaterals and hexahedra.
 *
 * The map from the coordinates of a cell to the barycentric coordinates of a simplex is
 * multilinear, so a quadratic function of the simplex has degree 2 in each coordinate of the cell
 * and thus belongs to Q2 on the cells. The nodes at the corners of the element and in the middles
 * of its edges remain unknowns (for prisms and hexahedra also in the middles of quadrilateral faces
 * and of hexahedra). The value at every other node x of the cells is
 * @f[ u(x) = \sum_m N_m(x) u_m @f]
 * with the shape functions N_m of the element. On a face or an edge, only the functions of its own
 * nodes are not zero, so elements that share a face or an edge have equal constraints there.
 *
 * An element whose cells were refined, and all elements that share an edge with it, keep all nodes
 * of their cells, except nodes on faces and edges of constrained elements. Such functions are
 * continuous, too.
 */
template <int dim>
class QuadraticElements
{
public:
  /// Find no elements, so that no node is constrained.
  QuadraticElements() = default;

  /// Find the elements of all bodies. Without refined cells, rank 0 finds them, and all other ranks
  /// get the elements of their cells by of_cells(). Collective.
  explicit QuadraticElements(const Forest<dim> &forest);

  /// Return the elements of some coarse cells, given in ascending order.
  QuadraticElements of_cells(const std::vector<unsigned int> &coarse) const;

  /// Return the place of a cell, whose id has the position in the coarse mesh. The place has no
  /// element if a cell of the element was refined. The elements of all bodies have different
  /// numbers.
  CellPlace place(const dealii::CellId &cell) const;

  /// Return the id of a cell whose coarse cell is the position in the coarse mesh.
  using PlacedId = std::function<dealii::CellId(const dealii::CellId &)>;

  /// Add the constraints to @p constraints, which may contain those of hanging nodes of refined
  /// cells. @p order is the permutation from tensor-product order to the order of the element of
  /// degree 2 of @p nodes. Constraints of ghost cells whose masters are not on this rank are left
  /// out.
  void constrain(const dealii::DoFHandler<dim>     &nodes,
                 const PlacedId                    &placed_id,
                 const std::vector<unsigned int>   &order,
                 dealii::AffineConstraints<double> &constraints) const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & cells;
  }

private:
  /// A coarse cell that is a part of an element.
  struct Cell
  {
    unsigned int               coarse;     ///< position in the coarse mesh
    geometry::ElementPart<dim> part;       ///< elements are numbered over all bodies
    bool                       is_refined; ///< a cell of the element was refined
    unsigned char              hanging;    ///< bit v: vertex v is marked, see mark()

    template <class Archive>
    void serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive & coarse & part & is_refined & hanging;
    }
  };

  std::vector<Cell> cells; ///< ascending

  /// Return a coarse cell, or null if it is no part of an element.
  const Cell *find(unsigned int coarse) const;
  void        find_refined(const Forest<dim> &forest, unsigned int n_elements);
  void        mark(const CoarseMesh<dim> &coarse, unsigned int n_elements);
};
} // namespace snug::mesh

#endif
