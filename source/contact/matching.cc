#include <snug/contact/matching.h>
#include <snug/contact/nearest_face.h>
#include <snug/contact/projection.h>
#include <snug/geometry/extents.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace snug::contact {
namespace {
/// Return the length of v without its part along the unit vector @p n.
template <int dim>
double offset_across(const dealii::Tensor<1, dim> &v, const dealii::Tensor<1, dim> &n)
{
  return (v - (v * n) * n).norm();
}
} // namespace

/// Count the matching nodes. Where faces are apart and not parallel, nodes may face each other in
/// any direction between the two normals. The tolerance therefore includes the offset that the
/// angle between the normals causes over the gap.
template <int dim>
Matching matching(const PairGeometry<dim> &pair)
{
  const auto                    &x = pair.positions;
  const SearchCriteria<dim>      criteria(pair);
  const faces::NodalNormals<dim> of_slave(pair.surface, pair.sides.slave, pair.shape, x,
                                          &pair.held);
  const PairNormals<dim>         normals(pair);
  Matching                       result;
  for (const Projection<dim> &projection :
       project(pair.surface, pair.sides, pair.shape, x, normals.values()))
    {
      const auto            &n = of_slave.normals()[projection.slave];
      dealii::Tensor<1, dim> point, into_slave;
      for (const auto &master : projection.masters)
        {
          point += master.second * x[master.first];
          into_slave += master.second * normals.values().master[master.first];
        }
      const double distance = (point - x[projection.slave]).norm();
      if (!criteria.is_near(distance))
        continue;
      double nearest = std::numeric_limits<double>::max();
      for (const unsigned int node : pair.surface.faces()[projection.face].nodes)
        nearest = std::min(nearest, offset_across<dim>(x[node] - x[projection.slave], n));
      const double parted = distance * offset_across<dim>(into_slave / into_slave.norm(), n);
      ++result.n_nodes;
      result.n_matching +=
        nearest <= parted + matching_tolerance * mean_face_size(pair.surface, {projection.face}, x);
    }
  return result;
}

namespace {
/// Faces are opposite if their normals are opposite up to this angle [degrees].
const double steepest_meeting = 60.;

/// Return the centre and the unit normal of a face.
template <int dim>
std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
middle(const mesh::Surface<dim>                 &surface,
       const faces::FaceShape<dim>              &shape,
       const unsigned int                        face,
       const typename mesh::Surface<dim>::Field &positions)
{
  const auto            &nodes = surface.faces()[face].nodes;
  dealii::Point<dim - 1> centre;
  for (unsigned int d = 0; d < dim - 1; ++d)
    centre[d] = 0.5;
  const auto             values = shape.at(centre);
  dealii::Tensor<1, dim> x;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    x += values.value[k] * positions[nodes[k]];
  const auto n = faces::area_vector(faces::tangents<dim>(values, nodes, positions));
  return {x, n / n.norm()};
}
} // namespace

template <int dim>
std::vector<unsigned int> coarse_faces(const mesh::Surface<dim>                 &surface,
                                       const faces::FaceShape<dim>              &shape,
                                       const Pair                               &pair,
                                       const typename mesh::Surface<dim>::Field &positions)
{
  std::vector<unsigned int> result;
  if (pair.obstacle)
    return result;
  const double least_cosine = std::cos(steepest_meeting / 180. * dealii::numbers::PI);
  const auto   slave = faces_of(surface, pair.slave), master = faces_of(surface, pair.master);
  const auto add = [&](const std::vector<unsigned int> &side, const std::vector<unsigned int> &of) {
    const NearestFace<dim> other(surface, of, shape, positions);
    for (const unsigned int face : side)
      {
        const auto [x, n]           = middle(surface, shape, face, positions);
        const unsigned int opposite = other.closest(x).face;
        if (-(n * middle(surface, shape, opposite, positions).second) >= least_cosine &&
            mean_face_size(surface, {face}, positions) >
              coarser_by * mean_face_size(surface, {opposite}, positions))
          result.push_back(face);
      }
  };
  add(slave, master);
  add(master, slave);
  std::sort(result.begin(), result.end());
  return result;
}

template <int dim>
std::string places_of_sides(const mesh::Surface<dim>                 &surface,
                            const faces::FaceShape<dim>              &shape,
                            const Pair                               &pair,
                            const typename mesh::Surface<dim>::Field &positions)
{
  std::ostringstream text;
  const auto         slave  = faces_of(surface, pair.slave);
  const auto         extent = [&](const std::vector<unsigned int> &side) {
    std::vector<dealii::Point<dim>> points;
    for (const unsigned int face : side)
      for (const unsigned int node : surface.faces()[face].nodes)
        points.emplace_back(positions[node]);
    const auto [lower, upper] = dealii::BoundingBox<dim>(points).get_boundary_points();
    return geometry::extents<dim>(lower, upper, lower.distance(upper));
  };
  if (!pair.obstacle)
    {
      const auto             master = faces_of(surface, pair.master);
      const NearestFace<dim> other(surface, master, shape, positions);
      double                 least = std::numeric_limits<double>::max(), cosine = 0.;
      for (const unsigned int face : slave)
        {
          const auto [x, n] = middle(surface, shape, face, positions);
          const auto found  = other.closest(x);
          if (found.point.squared_distance < least)
            {
              least  = found.point.squared_distance;
              cosine = n * middle(surface, shape, found.face, positions).second;
            }
        }
      text << "the sides have a distance of " << std::sqrt(least)
           << (cosine > -1e-9 ? ", and they do not look at each other" : "") << "; '"
           << pair.master_name << "' is at " << extent(master) << "; ";
    }
  text << "'" << pair.slave_name << "' is at " << extent(slave);
  return text.str();
}

#define SNUG_INSTANTIATE(dim)                                                                     \
  template Matching                  matching(const PairGeometry<dim> &);                         \
  template std::vector<unsigned int> coarse_faces(const mesh::Surface<dim> &,                     \
                                                  const faces::FaceShape<dim> &, const Pair &,    \
                                                  const mesh::Surface<dim>::Field &);             \
  template std::string places_of_sides(const mesh::Surface<dim> &, const faces::FaceShape<dim> &, \
                                       const Pair &, const mesh::Surface<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::contact
