#include <snug/contact/matching.h>
#include <snug/contact/projection.h>
#include <snug/contact/supported_normals.h>

#include <algorithm>
#include <limits>

namespace snug::contact {
namespace {
/// v without its part along the unit vector @p n.
template <int dim>
double offset_across(const dealii::Tensor<1, dim> &v, const dealii::Tensor<1, dim> &n)
{
  return (v - (v * n) * n).norm();
}
} // namespace

/// Where faces are apart and not parallel, nodes may face each other in any direction between the
/// two normals: as far as these part over the gap, an offset tells nothing.
template <int dim>
Matching matching(const PairGeometry<dim> &pair)
{
  const auto           &x = pair.positions;
  const Opposition<dim> opposition(pair);
  using Normals = SupportedNormals<dim>;
  const Normals of_slave(pair.surface, pair.sides.slave, pair.shape, x, pair.held);
  const Normals of_master(pair.surface, pair.sides.master, pair.shape, x, pair.held);
  Matching      result;
  for (const Projection<dim> &projection :
       project(pair.surface, pair.sides, pair.shape, x, of_master.normals()))
    {
      const auto            &n = of_slave.normals()[projection.slave];
      dealii::Tensor<1, dim> point, into_slave;
      for (const auto &master : projection.masters)
        {
          point += master.second * x[master.first];
          into_slave += master.second * of_master.normals()[master.first];
        }
      const double distance = (point - x[projection.slave]).norm();
      if (!opposition.is_near(distance))
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

template Matching matching(const PairGeometry<2> &);
template Matching matching(const PairGeometry<3> &);
} // namespace snug::contact
