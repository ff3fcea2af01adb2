#include <snug/contact/placed_surface.h>

namespace snug::contact {
namespace {
template <typename Key, int dim>
geometry::RigidMotion<dim> motion_of(const std::map<Key, geometry::RigidMotion<dim>> &motions,
                                     const Key                                       &key)
{
  const auto found = motions.find(key);
  return found == motions.end() ? geometry::RigidMotion<dim>() : found->second;
}
} // namespace

template <int dim>
geometry::RigidMotion<dim> Position<dim>::of_body(const unsigned int index) const
{
  return motion_of(bodies, index);
}

template <int dim>
geometry::RigidMotion<dim> Position<dim>::of_obstacle(const std::string &name) const
{
  return motion_of(obstacles, name);
}

template <int dim>
PlacedSurface<dim>::PlacedSurface(const mesh::Surface<dim> &surface, const Position<dim> &position)
  : original(surface)
{
  auto bodies = surface.bodies_of_points();
  bool moves  = false;
  for (const unsigned int b : bodies)
    for (unsigned int i = motions.size(); i <= b; ++i)
      {
        motions.push_back(position.of_body(i));
        moves = moves || !motions.back().is_identity();
      }
  if (!moves)
    return;
  placed = std::make_unique<const mesh::Surface<dim>>(surface.moved(motions));
  body   = std::move(bodies);
}

template <int dim>
typename PlacedSurface<dim>::Field PlacedSurface<dim>::to_space(Field positions) const
{
  if (placed)
    for (unsigned int i = 0; i < positions.size(); ++i)
      positions[i] = motions[body[i]].point(positions[i]);
  return positions;
}

template <int dim>
typename PlacedSurface<dim>::Field PlacedSurface<dim>::turned(Field vectors) const
{
  if (placed)
    for (unsigned int i = 0; i < vectors.size(); ++i)
      vectors[i] = motions[body[i]].vector(vectors[i]);
  return vectors;
}

template <int dim>
typename PlacedSurface<dim>::Field PlacedSurface<dim>::turned_back(Field vectors) const
{
  if (placed)
    for (unsigned int i = 0; i < vectors.size(); ++i)
      vectors[i] = motions[body[i]].vector_back(vectors[i]);
  return vectors;
}

template <int dim>
faces::HeldDirections<dim> PlacedSurface<dim>::turned(faces::HeldDirections<dim> held) const
{
  if (placed)
    for (unsigned int node = 0; node < held.size(); ++node)
      for (auto &direction : held[node])
        direction = motions[body[node]].vector(direction);
  return held;
}

template <int dim>
Row<dim> PlacedSurface<dim>::turned(Row<dim> row) const
{
  for (auto &[node, coefficient] : row.coefficients)
    coefficient = turned(node, coefficient);
  return row;
}

template <int dim>
std::vector<Row<dim>> PlacedSurface<dim>::turned_back(std::vector<Row<dim>> rows) const
{
  if (placed)
    for (auto &row : rows)
      for (auto &[node, coefficient] : row.coefficients)
        coefficient = motions[body[node]].vector_back(coefficient);
  return rows;
}

template struct Position<2>;
template struct Position<3>;
template class PlacedSurface<2>;
template class PlacedSurface<3>;
} // namespace snug::contact
