#include <snug/contact/matching.h>
#include <snug/contact/projection.h>
#include <snug/contact/supported_normals.h>

#include <algorithm>

namespace snug::contact {
template <int dim>
Matching matching(const PairGeometry<dim> &pair)
{
  const Opposition<dim>       opposition(pair);
  const SupportedNormals<dim> normals(pair.surface, pair.sides.master, pair.shape, pair.positions,
                                      pair.held);
  Matching                    result;
  for (const Projection &projection :
       project(pair.surface, pair.sides, pair.shape, pair.positions, normals.normals()))
    {
      const auto            &x = pair.positions;
      dealii::Tensor<1, dim> point;
      for (const auto &master : projection.masters)
        point += master.second * x[master.first];
      if (!opposition.is_near((point - x[projection.slave]).norm()))
        continue;
      double nearest = (x[projection.masters[0].first] - point).norm();
      for (const auto &master : projection.masters)
        nearest = std::min(nearest, (x[master.first] - point).norm());
      ++result.n_nodes;
      result.n_matching +=
        nearest <= matching_tolerance * mean_face_size(pair.surface, {projection.face}, x);
    }
  return result;
}

template Matching matching(const PairGeometry<2> &);
template Matching matching(const PairGeometry<3> &);
} // namespace snug::contact
