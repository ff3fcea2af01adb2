#include <snug/base/shared_work.h>
#include <snug/contact/face_tree.h>
#include <snug/contact/opposite_faces.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace snug::contact {
namespace {
/// Tolerance of the cosines at the limits of angles.
const double equal_cosine = 1e-9;

template <int dim>
dealii::BoundingBox<dim> bounding_box(const std::vector<dealii::Tensor<1, dim>> &nodes)
{
  return dealii::BoundingBox<dim>(std::vector<dealii::Point<dim>>(nodes.begin(), nodes.end()));
}

/// A face with the data of the search. The box is that of the nodes. A curved face may bulge beyond
/// the box by a little, which the slack of the search covers.
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
    : nodes(face_nodes<dim>(surface, face, positions)), box(bounding_box<dim>(nodes))
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

  /// Return the nodes in the form of the mortar functions, whose numbers may carry derivatives.
  mortar::MortarFace<dim, double> arrays() const
  {
    mortar::FaceNodes<dim, double> result(nodes.size());
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (int i = 0; i < dim; ++i)
        result[k][i] = nodes[k][i];
    return {result};
  }
};

/// Return the faces of the master side that are near enough to @p slave.
template <int dim>
std::vector<std::size_t> near(const FaceTree<dim> &masters, const SearchFace<dim> &slave)
{
  dealii::BoundingBox<dim> around = slave.box;
  around.extend(1.5 * masters.bound(slave.centre) + diameter(slave.box));
  return masters.meeting(around);
}

template <int dim>
std::vector<std::vector<unsigned int>> find_opposite(const PairGeometry<dim>  &pair,
                                                     const MortarNormals<dim> &normals)
{
  const auto &slaves      = pair.sides.slave;
  const auto  search_face = [&](unsigned int face) {
    return SearchFace<dim>(pair.surface, face, pair.shape, pair.positions);
  };
  // Limit the angle, because projection along the slave's normal shrinks a face by the cosine of
  // the angle.
  const double angle        = std::min(pair.pair.parameters.largest_angle, steepest_angle);
  const double least_cosine = std::cos(angle / 180. * dealii::numbers::PI) - equal_cosine;
  std::vector<std::vector<unsigned int>> result(slaves.size());
  std::vector<SearchFace<dim>>           masters;
  for (const unsigned int face : pair.sides.master)
    masters.push_back(search_face(face));
  if (masters.empty())
    return result;
  // Use a tree, because the number of all pairs of faces would be quadratic.
  const FaceTree<dim> tree(pair.surface, pair.sides.master, pair.shape, pair.positions);
  const mortar::SegmentQuadrature<dim> quadrature(pair.shape.degree(), pair.surface.idealization());
  const auto                           of_slave = normals.at(pair.positions);
  const faces::PointField<dim, double> x(pair.positions), n(of_slave.normals());
  const auto                           opposite = [&](const unsigned int i) {
    const SearchFace<dim> slave    = search_face(slaves[i]);
    const auto            of_nodes = normals.slave_face(slaves[i], x, n);
    std::vector<double>   found;
    for (const std::size_t m : near(tree, slave))
      // Both normals point out of their bodies, so opposite faces have opposite normals.
      if (-(slave.normal * masters[m].normal) >= least_cosine &&
          quadrature.overlap(of_nodes, masters[m].arrays(), pairing_margin))
        found.push_back(pair.sides.master[m]);
    return found;
  };
  const auto found =
    shared_work(pair.surface.communicator(), std::vector<double>(slaves.size(), 1.), opposite);
  for (unsigned int i = 0; i < slaves.size(); ++i)
    result[i].assign(found[i].begin(), found[i].end());
  return result;
}
} // namespace

template <int dim>
std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<dim>  &pair,
                                                      const MortarNormals<dim> &normals)
{
  return find_opposite(pair, normals);
}

template std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<2> &,
                                                               const MortarNormals<2> &);
template std::vector<std::vector<unsigned int>> opposite_faces(const PairGeometry<3> &,
                                                               const MortarNormals<3> &);
} // namespace snug::contact
