#include <snug/contact/ends_inside.h>
#include <snug/contact/projection.h>
#include <snug/geometry/formula.h>

#include <algorithm>
#include <limits>

namespace snug::contact {
namespace {
/// Gaps that differ by less than this part of a face may both close.
const double same_gap = 0.1;

/// A foot point is on an outer edge if the nodes of outer edges have more than this part of its
/// weights.
const double on_edge = 0.99;
} // namespace

template <int dim>
bool ends_inside(const PairGeometry<dim> &pair)
{
  const faces::OuterEdges<dim> ends(pair.surface, pair.sides.slave, pair.shape),
    of_master(pair.surface, pair.sides.master, pair.shape);
  const PairNormals<dim>       normals(pair);
  const geometry::Formula<dim> formula("Gap", pair.pair.parameters.gap);
  const auto                  &x     = pair.positions;
  const double                 none  = std::numeric_limits<double>::max();
  double                       least = none, at_end = none;
  for (const auto &node : project(pair.surface, pair.sides, pair.shape, x, normals.values()))
    {
      dealii::Tensor<1, dim> foot;
      double                 edge_part = 0.;
      for (const auto &[master, weight] : node.masters)
        {
          foot += weight * x[master];
          edge_part += of_master.contains(master) ? weight : 0.;
        }
      const dealii::Point<dim> reference(pair.surface.reference_positions()[node.slave]);
      const double gap = (x[node.slave] - foot) * normals.values().master[node.masters[0].first] +
                         formula.value(reference);
      least = std::min(least, gap);
      if (ends.contains(node.slave) && edge_part < on_edge)
        at_end = std::min(at_end, gap);
    }
  return at_end < none && at_end <= least + same_gap * pair.slave_size();
}

template bool ends_inside(const PairGeometry<2> &);
template bool ends_inside(const PairGeometry<3> &);
} // namespace snug::contact
