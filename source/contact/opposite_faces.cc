#include <snug/contact/opposite_faces.h>
#include <snug/faces/closest_point.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/numbers.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::contact {
namespace {
/// Limits of angles are met up to this.
const double equal_cosine = 1e-9;

template <int dim>
std::vector<dealii::Tensor<1, dim>> face_field(const mesh::Surface<dim>                 &surface,
                                               unsigned int                              face,
                                               const typename mesh::Surface<dim>::Field &field)
{
  std::vector<dealii::Tensor<1, dim>> values;
  for (const unsigned int node : surface.faces()[face].nodes)
    values.push_back(field[node]);
  return values;
}

template <int dim>
dealii::BoundingBox<dim> bounding_box(const std::vector<dealii::Tensor<1, dim>> &nodes)
{
  std::vector<dealii::Point<dim>> points;
  for (const auto &node : nodes)
    points.emplace_back(node);
  return dealii::BoundingBox<dim>(points);
}

template <int dim>
double diameter(const dealii::BoundingBox<dim> &box)
{
  const auto &corners = box.get_boundary_points();
  return corners.first.distance(corners.second);
}

/// A face as the search needs it.
/// The box is that of the nodes: a curved face may bulge beyond it by a little, for which the slack
/// of the search makes up.
template <int dim>
struct SearchFace
{
  std::vector<dealii::Tensor<1, dim>> nodes;
  dealii::BoundingBox<dim>            box;
  dealii::Tensor<1, dim>              centre, normal;

  SearchFace(const mesh::Surface<dim>                 &surface,
             unsigned int                              face,
             const faces::FaceShape<dim>              &shape,
             const typename mesh::Surface<dim>::Field &positions)
    : nodes(face_field<dim>(surface, face, positions)), box(bounding_box<dim>(nodes))
  {
    typename faces::FaceShape<dim>::Coordinates middle;
    for (int a = 0; a < dim - 1; ++a)
      middle[a] = 0.5;
    const auto values = shape.at(middle);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      centre += values.value[k] * nodes[k];
    normal =
      faces::area_vector(faces::tangents<dim>(values, surface.faces()[face].nodes, positions));
    normal /= normal.norm();
  }

  /// As the mortar kernels take positions, whose numbers may carry derivatives.
  mortar::FaceNodes<dim, double> arrays() const
  {
    mortar::FaceNodes<dim, double> result(nodes.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (int i = 0; i < dim; ++i)
        result[k][i] = nodes[k][i];
    return result;
  }
};

/// The tree of the master faces' boxes.
template <int dim>
class MasterTree
{
public:
  MasterTree(const std::vector<SearchFace<dim>> &faces, const faces::FaceShape<dim> &shape)
    : faces(faces), shape(shape), boxes(boxes_of(faces)), tree(dealii::pack_rtree_of_indices(boxes))
  {}

  /// Indices of the faces whose boxes are within reach of @p slave.
  std::vector<std::size_t> near(const SearchFace<dim> &slave) const
  {
    namespace bgi  = boost::geometry::index;
    double closest = std::numeric_limits<double>::max();
    // Boxes of four near faces: the closest of these gives an upper bound of the distance.
    for (const auto i :
         tree | bgi::adaptors::queried(bgi::nearest(dealii::Point<dim>(slave.centre), 4)))
      closest =
        std::min(closest,
                 faces::closest_point(shape, faces[i].nodes, slave.centre).squared_distance);
    dealii::BoundingBox<dim> around = slave.box;
    around.extend(1.5 * std::sqrt(closest) + diameter(slave.box));
    std::vector<std::size_t> result;
    for (const auto i : tree | bgi::adaptors::queried(bgi::intersects(around)))
      result.push_back(i);
    // The tree returns faces in an order of its own; rows must not depend on it.
    std::sort(result.begin(), result.end());
    return result;
  }

private:
  using Boxes = std::vector<dealii::BoundingBox<dim>>;

  static Boxes boxes_of(const std::vector<SearchFace<dim>> &faces)
  {
    Boxes result;
    for (const auto &face : faces)
      result.push_back(face.box);
    return result;
  }

  const std::vector<SearchFace<dim>>                                          &faces;
  const faces::FaceShape<dim>                                                 &shape;
  const Boxes                                                                  boxes;
  const decltype(dealii::pack_rtree_of_indices(std::declval<const Boxes &>())) tree;
};
} // namespace

template <int dim>
std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<dim> &pair)
{
  const auto &slaves      = pair.sides.slave;
  const auto  search_face = [&](unsigned int face) {
    return SearchFace<dim>(pair.surface, face, pair.shape, pair.positions);
  };
  // Projecting along the slave's normal squeezes a face by the cosine of the angle.
  const double angle        = std::min(pair.pair.parameters.largest_angle, steepest_angle);
  const double least_cosine = std::cos(angle / 180. * dealii::numbers::PI) - equal_cosine;
  std::vector<std::vector<unsigned int>> result(slaves.size());
  std::vector<SearchFace<dim>>           masters;
  for (const unsigned int face : pair.sides.master)
    masters.push_back(search_face(face));
  if (masters.empty())
    return result;
  // All pairs of faces would be a square of their number.
  const MasterTree<dim>                tree(masters, pair.shape);
  const mortar::SegmentQuadrature<dim> quadrature(pair.shape.degree(), pair.surface.idealization());
  for (unsigned int i = 0; i < slaves.size(); ++i)
    {
      const SearchFace<dim> slave = search_face(slaves[i]);
      for (const std::size_t m : tree.near(slave))
        // Both normals point out of their bodies, so those of opposite faces are opposite.
        if (-(slave.normal * masters[m].normal) >= least_cosine &&
            quadrature.overlap(slave.arrays(), masters[m].arrays(), pairing_margin))
          result[i].push_back(pair.sides.master[m]);
    }
  return result;
}

template std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<2> &);
template std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<3> &);
} // namespace snug::contact
