#include <snug/base/narrow.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/mesh/quadratic_elements.h>

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
  // The cells of grids are no parts of elements.
  if (forest.are_grids())
    return;
  const auto  &coarse     = forest.coarse();
  unsigned int n_elements = 0;
  for (unsigned int body = 0; body < coarse.geometries.size(); ++body)
    {
      const unsigned int first = n_elements;
      for (unsigned int cell = coarse.first_cell[body]; cell < coarse.first_cell[body + 1]; ++cell)
        {
          parts.push_back(coarse.geometries[body]->element_part(cell - coarse.first_cell[body]));
          if (auto &element = parts.back().element; element != no_element)
            n_elements = std::max(n_elements, (element += first) + 1);
        }
    }
  if (n_elements == 0)
    {
      parts.clear();
      return;
    }
  for (const auto &cell : coarse.cells)
    vertices.push_back(cell.vertices);
  refined.assign(n_elements, 0);
  if (forest.triangulation())
    find_refined(forest);
  mark(forest);
}

/// A tetrahedron has 1.4 unknowns per component, a prism 4, a triangle 2. A cell of degree 2 has 8
/// in 3D and 4 in 2D. The power of the number of corners approximates all these ratios, and is 1
/// for hexahedra and quadrilaterals.
template <int dim>
CellPlace QuadraticElements<dim>::place(const dealii::CellId &cell) const
{
  const unsigned int coarse = cell.get_coarse_cell_id();
  if (parts.empty() || parts[coarse].element == no_element || is_refined(coarse))
    return {no_element, 1.};
  const double n = parts[coarse].n_corners;
  return {parts[coarse].element, std::pow(n / (1u << dim), 2.5) / n};
}

template <int dim>
void QuadraticElements<dim>::find_refined(const Forest<dim> &forest)
{
  const PlacedIds<dim> ids(*forest.triangulation());
  for (const auto &cell : forest.triangulation()->active_cell_iterators())
    if (cell->is_locally_owned() && cell->level() > 0)
      {
        const auto &part = parts[ids.of(cell->id()).get_coarse_cell_id()];
        if (part.element != no_element)
          refined[part.element] = 1;
      }
  MPI_Allreduce(MPI_IN_PLACE, refined.data(), narrow<int>(refined.size()), MPI_UNSIGNED_CHAR,
                MPI_MAX, forest.communicator());
}

/// Mark the vertices of constrained elements. A node of a cell is constrained if the vertex in the
/// middle of its edge, face or element is marked, so that it does not matter whether the cell
/// itself belongs to a constrained element.
template <int dim>
void QuadraticElements<dim>::mark(const Forest<dim> &forest)
{
  const unsigned int n_vertices = forest.coarse().vertices.size();
  std::vector<bool>  is_at_refined(n_vertices, false), is_free(refined.size(), false);
  const auto         for_edges = [&](const auto &action) {
    for (unsigned int cell = 0; cell < parts.size(); ++cell)
      if (parts[cell].element != no_element)
        for (unsigned int d = 0; d < dim; ++d)
          action(cell, vertices[cell][1u << d]);
  };
  for_edges([&](const unsigned int cell, const unsigned int vertex) {
    if (is_refined(cell))
      is_at_refined[vertex] = true;
  });
  for_edges([&](const unsigned int cell, const unsigned int vertex) {
    if (is_at_refined[vertex])
      is_free[parts[cell].element] = true;
  });
  is_hanging.assign(n_vertices, false);
  for (unsigned int cell = 0; cell < parts.size(); ++cell)
    if (parts[cell].element != no_element && !is_free[parts[cell].element])
      for (const unsigned int vertex : vertices[cell])
        is_hanging[vertex] = true;
}

template <int dim>
void QuadraticElements<dim>::constrain(const dealii::DoFHandler<dim>     &nodes,
                                       const PlacedId                    &placed_id,
                                       const std::vector<unsigned int>   &order,
                                       dealii::AffineConstraints<double> &constraints) const
{
  if (parts.empty())
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
          const unsigned int coarse = placed_id(cell->id()).get_coarse_cell_id();
          const auto        &part   = parts[coarse];
          if (part.element == no_element || is_refined(coarse))
            continue;
          auto &weights = of_corner[{part.n_corners, part.corner}];
          if (weights.empty())
            weights = quadratic_weights(part);
          cell->get_dof_indices(indices);
          for (unsigned int node = 0; node < order.size(); ++node)
            action(coarse, node, weights[node], indices[order[node]]);
        }
  };
  for_nodes(
    [&](const unsigned int coarse, unsigned int, const Weights &weights, const Index index) {
      if (weights.size() == 1)
        masters[{parts[coarse].element, weights[0].first}] = index;
    });
  for_nodes([&](const unsigned int coarse, const unsigned int node, const Weights &weights,
                const Index index) {
    if (weights.size() == 1 || !is_hanging[vertices[coarse][middle_vertex<dim>(node)]] ||
        constraints.is_constrained(index) || !constraints.can_store_line(index))
      return;
    std::vector<std::pair<Index, double>> entries;
    for (const auto &[key, weight] : weights)
      if (const auto found = masters.find({parts[coarse].element, key}); found != masters.end())
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
