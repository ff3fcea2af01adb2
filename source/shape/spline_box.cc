#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/make_modes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::shape {
namespace {
/// Maximum distance of a node on a side from the side, relative to the size of the box.
const double side_tolerance = 1e-10;

/// Return whether a point is inside of the box. The sides belong to the box, even if round-off puts
/// their nodes slightly outside.
bool is_inside(const std::vector<double> &s)
{
  return std::all_of(s.begin(), s.end(), [](double coordinate) {
    return coordinate >= -side_tolerance && coordinate <= 1. + side_tolerance;
  });
}

/// Return the coordinates s of the point at @p offset from the corner.
template <int dim>
std::vector<double> fractions(const dealii::Tensor<1, dim> &offset,
                              const dealii::Tensor<1, dim> &size)
{
  std::vector<double> s;
  for (unsigned int d = 0; d < dim; ++d)
    s.push_back(offset[d] / size[d]);
  return s;
}

/// Return the directions of the variables of a control point: the given direction, or each axis.
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

/// This class finds the nodes of the wanted bodies in the box of the entries, and the control
/// points that are frozen.
template <int dim>
class Box
{
public:
  /// Construct the box. Collective.
  Box(const mesh::BodyMesh<dim> &mesh,
      const std::vector<bool>   &is_wanted,
      const ShapeParameters     &parameters,
      const unsigned int         degree)
    : mesh(mesh)
    , net(spline_net(parameters, dim, degree))
    , directions(directions_of_points<dim>(parameters))
    , places(mesh.n_points())
    , frozen(net.n_points(), false)
  {
    std::tie(corner, size) = box_of<dim>(parameters);
    find_nodes(is_wanted);
    // The maximum over ranks makes all ranks throw, or none.
    const bool empty =
      std::all_of(places.begin(), places.end(), [](const auto &place) { return place.empty(); });
    if (dealii::Utilities::MPI::max(empty ? 0u : 1u, mesh.communicator()) == 0)
      throw bad_entry(parameters.path("Box size"), to_text(parameters.box_size),
                      "the box at (" + to_text(parameters.box_corner) +
                        ") holds no node of the bodies it shapes");
    freeze_cut_sides(is_wanted);
    freeze_idle_points();
  }

  Modes<dim> modes() const
  {
    Modes<dim> modes;
    modes.n_variables = directions.size() * net.n_points();
    modes.n_nodes     = places.size();
    const auto row_at = [net = net, directions = directions](const std::vector<double> &place) {
      typename Modes<dim>::Row row;
      if (!place.empty())
        for (const auto &value : net.values(place))
          for (unsigned int j = 0; j < directions.size(); ++j)
            // The variables of a control point are consecutive.
            row.emplace_back(directions.size() * value.first + j, value.second * directions[j]);
      return row;
    };
    modes.row          = [=, places = places](unsigned int node) { return row_at(places[node]); };
    modes.row_at_point = [=, net = net](unsigned int i) { return row_at(net.greville(i)); };
    // Frozen points are listed as well, because users refer to points by these indices.
    for (unsigned int i = 0; i < net.n_points(); ++i)
      {
        dealii::Point<dim> position  = corner;
        const auto         fractions = net.greville(i);
        for (unsigned int d = 0; d < dim; ++d)
          position[d] += fractions[d] * size[d];
        for (const auto &direction : directions)
          modes.controls.push_back({i, position, direction, net.on_border(i), frozen[i]});
      }
    return modes;
  }

private:
  void find_nodes(const std::vector<bool> &is_wanted)
  {
    for (unsigned int node = 0; node < mesh.n_points(); ++node)
      if (is_wanted[mesh.body_of_node(node)] && !mesh.is_hanging(node))
        {
          auto s = fractions(mesh.reference_positions()[node] - corner, size);
          if (!is_inside(s))
            continue;
          for (double &coordinate : s)
            // Splines are defined on [0, 1] only.
            coordinate = std::clamp(coordinate, 0., 1.);
          places[node] = s;
        }
  }

  /// Freeze the control points of sides that cut a wanted body. Knots are clamped, so on a side
  /// only the control points of this side have nonzero splines. With these points frozen the field
  /// vanishes on the side, as it does outside of the box.
  void freeze_cut_sides(const std::vector<bool> &is_wanted)
  {
    // A side cuts the cells that have one node inside of the box and one node beyond the side.
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

  /// Freeze the control points that move no node. Their variables would have zero gradients, and
  /// the optimizer could not determine these variables.
  void freeze_idle_points()
  {
    std::vector<unsigned int> moves(net.n_points(), 0);
    for (const auto &place : places)
      if (!place.empty())
        for (const auto &value : net.values(place))
          if (value.second != 0.)
            moves[value.first] = 1;
    dealii::Utilities::MPI::max(moves, mesh.communicator(), moves);
    for (unsigned int i = 0; i < moves.size(); ++i)
      frozen[i] = frozen[i] || moves[i] == 0;
  }

  const mesh::BodyMesh<dim>          &mesh;
  SplineNet                           net;
  std::vector<dealii::Tensor<1, dim>> directions; ///< of the moves of each point
  dealii::Point<dim>                  corner;
  dealii::Tensor<1, dim>              size;
  std::vector<std::vector<double>>    places; ///< s; empty outside and if hanging
  std::vector<bool>                   frozen; ///< per control point
};

} // namespace

template <int dim>
Modes<dim> spline_box(const mesh::BodyMesh<dim> &mesh,
                      const BodyNames           &bodies,
                      const ShapeParameters     &parameters,
                      const unsigned int         degree)
{
  return Box<dim>(mesh, wanted_bodies(bodies, parameters), parameters, degree).modes();
}

template Modes<2>
spline_box(const mesh::BodyMesh<2> &, const BodyNames &, const ShapeParameters &, unsigned int);
template Modes<3>
spline_box(const mesh::BodyMesh<3> &, const BodyNames &, const ShapeParameters &, unsigned int);
} // namespace snug::shape
