#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/spline_box.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace snug::shape {
namespace {
/// Nodes this close to a side, relative to the box, are on it.
const double side_tolerance = 1e-10;

/// The sides belong to the box, also where rounding puts their nodes a little outside.
bool is_inside(const std::vector<double> &s)
{
  return std::all_of(s.begin(), s.end(), [](double coordinate) {
    return coordinate >= -side_tolerance && coordinate <= 1. + side_tolerance;
  });
}

/// s of the point at @p offset from the corner.
template <int dim>
std::vector<double> fractions(const dealii::Tensor<1, dim> &offset,
                              const dealii::Tensor<1, dim> &size)
{
  std::vector<double> s;
  for (unsigned int d = 0; d < dim; ++d)
    s.push_back(offset[d] / size[d]);
  return s;
}

/// One variable per point along the given direction, or one along each axis.
template <int dim>
std::vector<dealii::Tensor<1, dim>> directions_of_points(const ShapeParameters &parameters)
{
  if (!parameters.direction.empty())
    return {unit_direction<dim>(parameters)};
  std::vector<dealii::Tensor<1, dim>> axes(dim);
  for (unsigned int d = 0; d < dim; ++d)
    axes[d][d] = 1.;
  return axes;
}
} // namespace

/// The error lists the bodies there are.
std::vector<bool> wanted_bodies(const BodyNames &bodies, const ShapeParameters &parameters)
{
  std::vector<bool> result(bodies.names.size(), parameters.bodies.empty());
  for (const auto &name : parameters.bodies)
    {
      const auto found = std::find(bodies.names.begin(), bodies.names.end(), name);
      if (found == bodies.names.end())
        throw bad_entry(parameters.path("Bodies"), to_text(parameters.bodies),
                        "there is no body '" + name + "', there are " + to_text(bodies.names));
      result[found - bodies.names.begin()] = true;
    }
  return result;
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> boundaries_of(const mesh::BodyMesh<dim> &mesh,
                                                                 const std::vector<bool> &is_marked)
{
  using Boundary = std::pair<unsigned int, unsigned int>;
  std::set<Boundary> found;
  for (const auto &face : mesh.boundary_faces())
    for (const unsigned int node : face.nodes)
      if (is_marked[node])
        found.insert({face.body, face.boundary});
  const std::vector<Boundary> mine(found.begin(), found.end());
  // A set: ascending, each boundary once, the same on all ranks.
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(mesh.communicator(), mine))
    found.insert(of_rank.begin(), of_rank.end());
  return {found.begin(), found.end()};
}

template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>> box_of(const ShapeParameters &parameters)
{
  const auto read = [&](const std::string &entry, const std::vector<double> &numbers,
                        const bool positive) {
    dealii::Tensor<1, dim> result;
    bool                   good = numbers.size() == dim;
    for (unsigned int d = 0; d < dim && good; ++d)
      {
        result[d] = numbers[d];
        good      = std::isfinite(numbers[d]) && (!positive || numbers[d] > 0.);
      }
    if (!good)
      throw bad_entry(parameters.path(entry), to_text(numbers),
                      "must be " + std::to_string(dim) + (positive ? " numbers > 0" : " numbers"));
    return result;
  };
  return {read("Box corner", parameters.box_corner, false),
          read("Box size", parameters.box_size, true)};
}

template <int dim>
SplineBox<dim>::SplineBox(const mesh::BodyMesh<dim> &mesh,
                          const BodyNames           &bodies,
                          const ShapeParameters     &parameters,
                          const unsigned int         degree)
  : mesh(mesh)
  , net(spline_net(parameters, dim, degree))
  , directions(directions_of_points<dim>(parameters))
  , frozen(net.n_points(), false)
{
  std::tie(corner, size) = box_of<dim>(parameters);
  const auto is_wanted   = wanted_bodies(bodies, parameters);
  find_nodes(is_wanted);
  // A sum over ranks: all of them throw, or none.
  if (dealii::Utilities::MPI::sum<unsigned long>(nodes.size(), mesh.communicator()) == 0)
    throw bad_entry(parameters.path("Box size"), to_text(parameters.box_size),
                    "the box at (" + to_text(parameters.box_corner) +
                      ") holds no node of the bodies it shapes");
  freeze_cut_sides(is_wanted);
  freeze_idle_points();
}

template <int dim>
void SplineBox<dim>::find_nodes(const std::vector<bool> &is_wanted)
{
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (is_wanted[mesh.body_of_node(node)] && !mesh.is_hanging(node))
      {
        auto s = fractions(mesh.reference_positions()[node] - corner, size);
        if (!is_inside(s))
          continue;
        for (double &coordinate : s)
          // Splines are made for [0, 1] only.
          coordinate = std::clamp(coordinate, 0., 1.);
        nodes.push_back(node);
        places.push_back(s);
      }
}

/// On a side only the control points of that side have nonzero splines, as knots are clamped. With
/// these at rest the field vanishes there, as it does outside.
template <int dim>
void SplineBox<dim>::freeze_cut_sides(const std::vector<bool> &is_wanted)
{
  // A side cuts the cells that have a node inside and one beyond it.
  std::vector<unsigned int> cut(2 * dim, 0);
  for (const auto &cell : mesh.cells())
    {
      if (!is_wanted[cell.body])
        continue;
      std::vector<unsigned int> beyond(2 * dim, 0);
      bool                      inside = false;
      for (const unsigned int node : cell.nodes)
        {
          const auto s = fractions(mesh.reference_positions()[node] - corner, size);
          inside       = inside || is_inside(s);
          for (unsigned int d = 0; d < dim; ++d)
            {
              beyond[2 * d] |= s[d] < -side_tolerance;
              beyond[2 * d + 1] |= s[d] > 1. + side_tolerance;
            }
        }
      for (unsigned int side = 0; side < 2 * dim && inside; ++side)
        cut[side] |= beyond[side];
    }
  dealii::Utilities::MPI::max(cut, mesh.communicator(), cut);
  for (unsigned int i = 0; i < net.n_points(); ++i)
    for (unsigned int side = 0; side < 2 * dim; ++side)
      if (cut[side] == 1 && net.on_side(i, side / 2, side % 2))
        frozen[i] = true;
}

/// Such variables would have zero gradients, and the optimizer nothing to decide about them.
template <int dim>
void SplineBox<dim>::freeze_idle_points()
{
  std::vector<unsigned int> moves(net.n_points(), 0);
  for (const auto &place : places)
    for (const auto &value : net.values(place))
      if (value.second != 0.)
        moves[value.first] = 1;
  dealii::Utilities::MPI::max(moves, mesh.communicator(), moves);
  for (unsigned int i = 0; i < moves.size(); ++i)
    frozen[i] = frozen[i] || moves[i] == 0;
}

template <int dim>
unsigned int SplineBox<dim>::n_variables() const
{
  return directions.size() * net.n_points();
}

template <int dim>
typename SplineBox<dim>::Field SplineBox<dim>::apply(const std::vector<double> &alpha) const
{
  AssertDimension(alpha.size(), n_variables());
  const unsigned int                  m = directions.size();
  std::vector<dealii::Tensor<1, dim>> points(net.n_points());
  for (unsigned int i = 0; i < alpha.size(); ++i)
    // m variables per point, next to each other.
    points[i / m] += alpha[i] * directions[i % m];
  Field result(mesh.n_local_nodes());
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (const auto &value : net.values(places[k]))
      result[nodes[k]] += value.second * points[value.first];
  // Splines are not linear within cells: a hanging node has to follow its masters.
  mesh.interpolate_hanging(result);
  return result;
}

template <int dim>
std::vector<double> SplineBox<dim>::transpose(const Field &gradient) const
{
  // Point by point its directions, as in controls().
  const unsigned int m    = directions.size();
  Field              free = gradient;
  mesh.distribute_hanging(free);
  std::vector<double> result(n_variables(), 0.);
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (const auto &value : net.values(places[k]))
      for (unsigned int j = 0; j < m; ++j)
        result[m * value.first + j] += value.second * (directions[j] * free[nodes[k]]);
  dealii::Utilities::MPI::sum(result, mesh.communicator(), result);
  return result;
}

/// Frozen points are listed as well: their numbers are those that users see.
template <int dim>
std::vector<Control<dim>> SplineBox<dim>::controls() const
{
  std::vector<Control<dim>> result;
  for (unsigned int i = 0; i < net.n_points(); ++i)
    {
      dealii::Point<dim> position  = corner;
      const auto         fractions = net.greville(i);
      for (unsigned int d = 0; d < dim; ++d)
        position[d] += fractions[d] * size[d];
      for (const auto &direction : directions)
        result.push_back({i, position, direction, net.on_border(i), frozen[i]});
    }
  return result;
}

/// Boundaries with a node in the box.
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> SplineBox<dim>::faces() const
{
  std::vector<bool> is_inside(mesh.n_local_nodes(), false);
  for (const unsigned int node : nodes)
    is_inside[node] = true;
  return boundaries_of(mesh, is_inside);
}

#define SNUG_INSTANTIATE(dim)                                                     \
  template class SplineBox<dim>;                                                  \
  template std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>> box_of<dim>( \
    const ShapeParameters &);                                                     \
  template std::vector<std::pair<unsigned int, unsigned int>> boundaries_of(      \
    const mesh::BodyMesh<dim> &, const std::vector<bool> &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::shape
