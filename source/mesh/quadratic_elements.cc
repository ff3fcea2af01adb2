#include <snug/base/narrow.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/mesh/quadratic_elements.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace snug::mesh {
using geometry::no_element;

namespace {
/// Elements are products of simplices: a tetrahedron or a triangle is one simplex, a prism is the
/// product of a triangle and a line, quadrilaterals and hexahedra are products of lines. A node of
/// the quadratic element is a corner or the middle of an edge of each factor. Its key has one digit
/// 4 a + b per factor, where a <= b are the corners of the edge.
using NodeKey = unsigned int;

using Weights = QuadraticWeights;

/// Return the corner of each factor for a corner of an element.
std::vector<unsigned int>
factor_corners(const unsigned int dim, const unsigned int n_corners, const unsigned int corner)
{
  if (n_corners == dim + 1)
    return {corner};
  if (n_corners == 6)
    return {corner % 3, corner / 3};
  // The corners of quadrilaterals are numbered around.
  std::vector<unsigned int> result = {corner % 4 == 1 || corner % 4 == 2 ? 1u : 0u, corner % 4 / 2};
  if (dim == 3)
    result.push_back(corner / 4);
  return result;
}

/// Barycentric coordinates in a factor by the corners of the factor.
using Barycentric = std::map<unsigned int, double>;

/// Return the barycentric coordinates of the point @p u of a cell in each factor. They are the
/// multilinear interpolation of the coordinates at the vertices of the cell, which are the
/// centres of the corner and the corners along the axes of the vertex.
template <int dim>
std::vector<Barycentric> barycentric(const geometry::ElementPart<dim> &part,
                                     const dealii::Point<dim>         &u)
{
  const auto               own = factor_corners(dim, part.n_corners, part.corner);
  std::vector<Barycentric> result(own.size());
  for (unsigned int f = 0; f < own.size(); ++f)
    {
      std::vector<std::pair<unsigned int, double>> axes; // corner along the axis, coordinate
      for (unsigned int d = 0; d < dim; ++d)
        if (const auto end = factor_corners(dim, part.n_corners, part.towards[d])[f]; end != own[f])
          axes.emplace_back(end, u[d]);
      for (unsigned int vertex = 0; vertex < 1u << axes.size(); ++vertex)
        {
          double                    weight = 1.;
          std::vector<unsigned int> among  = {own[f]};
          for (unsigned int a = 0; a < axes.size(); ++a)
            {
              const bool along = (vertex >> a & 1) == 1;
              weight *= along ? axes[a].second : 1. - axes[a].second;
              if (along)
                among.push_back(axes[a].first);
            }
          for (const unsigned int corner : among)
            result[f][corner] += weight / double(among.size());
        }
    }
  return result;
}

/// Return the values of the shape functions lambda (2 lambda - 1) of the corners and
/// 4 lambda lambda' of the middles of edges of a simplex.
Weights simplex_weights(const Barycentric &lambda)
{
  Weights result;
  for (auto a = lambda.begin(); a != lambda.end(); ++a)
    for (auto b = a; b != lambda.end(); ++b)
      if (const double value =
            a == b ? a->second * (2. * a->second - 1.) : 4. * a->second * b->second;
          value != 0.)
        result.emplace_back(4 * a->first + b->first, value);
  return result;
}

template <int dim>
Weights element_weights(const geometry::ElementPart<dim> &part, const dealii::Point<dim> &u)
{
  Weights result = {{0, 1.}};
  for (const Barycentric &lambda : barycentric(part, u))
    {
      Weights product;
      for (const auto &[key, weight] : result)
        for (const auto &[digit, value] : simplex_weights(lambda))
          product.emplace_back(16 * key + digit, weight * value);
      result = product;
    }
  return result;
}

/// Return the vertex in the middle of the edge, the face or the cell inside of which a node lies.
/// The edge, the face or the whole element continues in other cells of the element.
template <int dim>
unsigned int middle_vertex(const unsigned int node)
{
  unsigned int vertex = 0;
  for (unsigned int d = 0, rest = node; d < dim; ++d, rest /= 3)
    vertex |= (rest % 3 > 0 ? 1u : 0u) << d;
  return vertex;
}
} // namespace

template <int dim>
std::vector<QuadraticWeights> quadratic_weights(const geometry::ElementPart<dim> &part)
{
  std::vector<Weights> result;
  for (unsigned int node = 0; node < dealii::Utilities::fixed_power<dim>(3u); ++node)
    {
      dealii::Point<dim> u;
      for (unsigned int d = 0, rest = node; d < dim; ++d, rest /= 3)
        u[d] = 0.5 * (rest % 3);
      result.push_back(element_weights(part, u));
    }
  return result;
}

template <int dim>
QuadraticElements<dim>::QuadraticElements(const Forest<dim> &forest)
{
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(forest.communicator()) == 0;
  // The cells of grids are no parts of elements.
  if (forest.are_grids() || (!is_first && !forest.triangulation()))
    return;
  const auto  &coarse     = forest.coarse();
  unsigned int n_elements = 0;
  for (unsigned int body = 0; body < coarse.geometries.size(); ++body)
    {
      const unsigned int first = n_elements, begin = coarse.first_cell[body];
      for (unsigned int cell = begin; cell < coarse.first_cell[body + 1]; ++cell)
        if (auto part = coarse.geometries[body]->element_part(cell - begin);
            part.element != no_element)
          {
            part.element += first;
            n_elements = std::max(n_elements, part.element + 1);
            cells.push_back({cell, part, false, 0});
          }
    }
  if (forest.triangulation() && n_elements > 0)
    find_refined(forest, n_elements);
  mark(coarse, n_elements);
}

template <int dim>
const typename QuadraticElements<dim>::Cell *
QuadraticElements<dim>::find(const unsigned int coarse) const
{
  const auto found =
    std::lower_bound(cells.begin(), cells.end(), coarse,
                     [](const Cell &cell, unsigned int c) { return cell.coarse < c; });
  return found != cells.end() && found->coarse == coarse ? &*found : nullptr;
}

template <int dim>
QuadraticElements<dim>
QuadraticElements<dim>::of_cells(const std::vector<unsigned int> &coarse) const
{
  QuadraticElements result;
  for (const unsigned int c : coarse)
    if (const Cell *cell = find(c))
      result.cells.push_back(*cell);
  return result;
}

/// A tetrahedron has 1.4 unknowns per component, a prism 4, a triangle 2. A cell of degree 2 has 8
/// in 3D and 4 in 2D. The power of the number of corners approximates all these ratios, and is 1
/// for hexahedra and quadrilaterals.
template <int dim>
CellPlace QuadraticElements<dim>::place(const dealii::CellId &id) const
{
  const Cell *cell = find(id.get_coarse_cell_id());
  if (cell == nullptr || cell->is_refined)
    return {no_element, 1.};
  const double n = cell->part.n_corners;
  return {cell->part.element, std::pow(n / (1u << dim), 2.5) / n};
}

template <int dim>
void QuadraticElements<dim>::find_refined(const Forest<dim> &forest, const unsigned int n_elements)
{
  const PlacedIds<dim>       ids(*forest.triangulation());
  std::vector<unsigned char> refined(n_elements, 0);
  for (const auto &cell : forest.triangulation()->active_cell_iterators())
    if (cell->is_locally_owned() && cell->level() > 0)
      if (const Cell *found = find(ids.of(cell->id()).get_coarse_cell_id()))
        refined[found->part.element] = 1;
  MPI_Allreduce(MPI_IN_PLACE, refined.data(), narrow<int>(refined.size()), MPI_UNSIGNED_CHAR,
                MPI_MAX, forest.communicator());
  for (auto &cell : cells)
    cell.is_refined = refined[cell.part.element] > 0;
}

/// Mark the vertices of constrained elements. A node of a cell is constrained if the vertex in the
/// middle of its edge, face or element is marked, so that it does not matter whether the cell
/// itself belongs to a constrained element.
template <int dim>
void QuadraticElements<dim>::mark(const CoarseMesh<dim> &coarse, const unsigned int n_elements)
{
  std::vector<bool> is_at_refined(coarse.vertices.size(), false), is_free(n_elements, false),
    is_hanging(coarse.vertices.size(), false);
  const auto for_edges = [&](const auto &action) {
    for (const auto &cell : cells)
      for (unsigned int d = 0; d < dim; ++d)
        action(cell, coarse.cells[cell.coarse].vertices[1u << d]);
  };
  for_edges([&](const Cell &cell, const unsigned int vertex) {
    if (cell.is_refined)
      is_at_refined[vertex] = true;
  });
  for_edges([&](const Cell &cell, const unsigned int vertex) {
    if (is_at_refined[vertex])
      is_free[cell.part.element] = true;
  });
  for (const auto &cell : cells)
    if (!is_free[cell.part.element])
      for (const unsigned int vertex : coarse.cells[cell.coarse].vertices)
        is_hanging[vertex] = true;
  for (auto &cell : cells)
    for (unsigned int v = 0; v < 1u << dim; ++v)
      if (is_hanging[coarse.cells[cell.coarse].vertices[v]])
        cell.hanging |= 1u << v;
}

template <int dim>
void QuadraticElements<dim>::constrain(const dealii::DoFHandler<dim>     &nodes,
                                       const PlacedId                    &placed_id,
                                       const std::vector<unsigned int>   &order,
                                       dealii::AffineConstraints<double> &constraints) const
{
  if (cells.empty())
    return;
  using Index = dealii::types::global_dof_index;
  std::map<std::pair<unsigned int, unsigned int>, std::vector<Weights>> of_corner;
  std::map<std::pair<unsigned int, NodeKey>, Index>                     masters;
  std::vector<Index>                                                    indices(order.size());
  // The action takes the coarse cell of a cell, and the weights and the index of one of its nodes.
  const auto for_nodes = [&](const auto &action) {
    for (const auto &cell : nodes.active_cell_iterators())
      if (!cell->is_artificial() && cell->level() == 0)
        {
          const Cell *coarse = find(placed_id(cell->id()).get_coarse_cell_id());
          if (coarse == nullptr || coarse->is_refined)
            continue;
          auto &weights = of_corner[{coarse->part.n_corners, coarse->part.corner}];
          if (weights.empty())
            weights = quadratic_weights(coarse->part);
          cell->get_dof_indices(indices);
          for (unsigned int node = 0; node < order.size(); ++node)
            action(*coarse, node, weights[node], indices[order[node]]);
        }
  };
  for_nodes([&](const Cell &coarse, unsigned int, const Weights &weights, const Index index) {
    if (weights.size() == 1)
      masters[{coarse.part.element, weights[0].first}] = index;
  });
  for_nodes(
    [&](const Cell &coarse, const unsigned int node, const Weights &weights, const Index index) {
      if (weights.size() == 1 || (coarse.hanging >> middle_vertex<dim>(node) & 1u) == 0 ||
          constraints.is_constrained(index) || !constraints.can_store_line(index))
        return;
      std::vector<std::pair<Index, double>> entries;
      for (const auto &[key, weight] : weights)
        if (const auto found = masters.find({coarse.part.element, key}); found != masters.end())
          entries.emplace_back(found->second, weight);
        else
          return;
      constraints.add_line(index);
      constraints.add_entries(index, entries);
    });
}

template std::vector<QuadraticWeights> quadratic_weights(const geometry::ElementPart<2> &);
template std::vector<QuadraticWeights> quadratic_weights(const geometry::ElementPart<3> &);
template class QuadraticElements<2>;
template class QuadraticElements<3>;
} // namespace snug::mesh
