#include <snug/faces/face_shape.h>
#include <snug/shape/interior.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace snug::shape {
namespace {
/**
 * The faces of a side of a box as rectangles of the logical square
 * [0,1]^(dim-1). The rectangles cover the square. This class returns the weights of the face nodes
 * at points of the square.
 */
template <int dim>
class LogicalFaces
{
public:
  using Tangential = dealii::Point<dim - 1>;

  explicit LogicalFaces(const ShapedFace<dim> &face)
    : face(face)
    , normal(face.boundaries().front() / 2)
    , shape(face.mesh().degree())
    , positions(face.surface().gather(logical(face.mesh())))
    // With about as many bins as faces, a bin holds a few faces on meshes of any element size.
    , n_bins(std::ceil(std::pow(face.surface().faces().size(), 1. / (dim - 1))))
    , bins(dealii::Utilities::pow(n_bins, dim - 1))
  {
    const auto &faces = face.surface().faces();
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        rectangles.push_back(rectangle(faces[f].nodes));
        add_to_bins(f);
      }
  }

  /// Return the tangential coordinates of a point of the logical box.
  Tangential tangential(const dealii::Tensor<1, dim> &point) const
  {
    Tangential   place;
    unsigned int t = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != normal)
        place[t++] = point[d];
    return place;
  }

  /// Return the surface nodes and their weights at @p place.
  std::vector<std::pair<unsigned int, double>> weights(const Tangential &place) const
  {
    unsigned int bin = 0;
    for (unsigned int t = dim - 1; t-- > 0;)
      bin = bin * n_bins + bin_along(place[t]);
    // No bin is empty, because the faces cover the square. If several faces meet at the place, any
    // of these faces is valid, because the field of the face is continuous. Round-off may put a
    // place slightly outside of all faces, so the nearest face is taken.
    unsigned int nearest = bins[bin].front();
    for (const unsigned int f : bins[bin])
      if (distance(f, place) < distance(nearest, place))
        nearest = f;
    return weights_in(nearest, place);
  }

private:
  struct Rectangle
  {
    Tangential lower, upper;
  };

  static mesh::Field<dim> logical(const mesh::BodyMesh<dim> &mesh)
  {
    return {mesh.logical_positions().begin(), mesh.logical_positions().end()};
  }

  /// Return the rectangle of a face. Cells are refined along their logical coordinates, so faces
  /// are axis-parallel in logical coordinates.
  Rectangle rectangle(const std::vector<unsigned int> &nodes) const
  {
    Rectangle result;
    result.lower = result.upper = tangential(positions[nodes[0]]);
    for (const unsigned int node : nodes)
      {
        const Tangential place = tangential(positions[node]);
        for (unsigned int t = 0; t < dim - 1; ++t)
          {
            result.lower[t] = std::min(result.lower[t], place[t]);
            result.upper[t] = std::max(result.upper[t], place[t]);
          }
      }
    return result;
  }

  unsigned int bin_along(const double coordinate) const
  {
    return std::clamp<int>(std::floor(coordinate * n_bins), 0, n_bins - 1);
  }

  void add_to_bins(const unsigned int f)
  {
    unsigned int first[2] = {0, 0}, last[2] = {0, 0};
    for (unsigned int t = 0; t < dim - 1; ++t)
      {
        // A face at the edge between two bins belongs to both bins, because round-off may put a
        // place at this edge into either bin.
        first[t] = bin_along(rectangles[f].lower[t] - 1e-9);
        last[t]  = bin_along(rectangles[f].upper[t] + 1e-9);
      }
    for (unsigned int j = first[1]; j <= last[1]; ++j)
      for (unsigned int i = first[0]; i <= last[0]; ++i)
        bins[i + n_bins * j].push_back(f);
  }

  /// Return the maximum over axes of the distance of @p place from a rectangle; zero inside.
  double distance(const unsigned int f, const Tangential &place) const
  {
    double largest = 0.;
    for (unsigned int t = 0; t < dim - 1; ++t)
      largest =
        std::max({largest, rectangles[f].lower[t] - place[t], place[t] - rectangles[f].upper[t]});
    return largest;
  }

  std::vector<std::pair<unsigned int, double>> weights_in(const unsigned int f,
                                                          const Tangential  &place) const
  {
    const auto &nodes = face.surface().faces()[f].nodes;
    const auto &box   = rectangles[f];
    const auto  xi    = [&](const Tangential &at) {
      Tangential result;
      for (unsigned int t = 0; t < dim - 1; ++t)
        result[t] = (at[t] - box.lower[t]) / (box.upper[t] - box.lower[t]);
      return result;
    };
    // The weights are the shape functions of the elements, so that nodes on the face keep their
    // moves exactly and the interior bends as the face bends between the face nodes.
    const auto                                   values = shape.at(xi(place));
    std::vector<std::pair<unsigned int, double>> result;
    // The coordinates of a face may be rotated relative to the coordinates of the box, so nodes
    // are matched with shape functions by position.
    for (const unsigned int node : nodes)
      {
        const Tangential own = xi(tangential(positions[node]));
        unsigned int     k   = 0;
        for (unsigned int t = dim - 1; t-- > 0;)
          // number of the shape function that is 1 at this node
          k = k * (shape.degree() + 1) + std::lround(own[t] * shape.degree());
        if (values.value[k] != 0.)
          result.emplace_back(node, values.value[k]);
      }
    return result;
  }

  const ShapedFace<dim>                 &face;
  unsigned int                           normal;
  faces::FaceShape<dim>                  shape;
  typename mesh::Surface<dim>::Field     positions; ///< logical
  unsigned int                           n_bins;
  std::vector<std::vector<unsigned int>> bins;
  std::vector<Rectangle>                 rectangles;
};

/// Return the factor b at a node of the box.
template <int dim>
double
blend_factor(const ShapedFace<dim> &face, const dealii::Point<dim> &logical, const double reach)
{
  const auto        &geometry = face.mesh().geometry(face.body());
  const unsigned int axis     = face.boundaries().front() / 2;
  const double       fraction = geometry.box_fraction(logical)[axis];
  // Face 2d is at the lower end of axis d, face 2d + 1 at the upper one.
  const double       depth = face.boundaries().front() % 2 == 1 ? 1. - fraction : fraction;
  dealii::Point<dim> far;
  far[axis] = 1.;
  const double height =
    geometry.box_position(far).distance(geometry.box_position(dealii::Point<dim>()));
  // Without a reach the factor decreases to zero at the opposite face, for boxes of any height.
  if (reach == 0.)
    return 1. - depth;
  return std::max(0., 1. - depth * height / reach);
}
template <int dim>
class LinearBlending : public Interior<dim>
{
public:
  using Field     = typename Interior<dim>::Field;
  using FaceField = typename Interior<dim>::FaceField;

  LinearBlending(const ShapedFace<dim> &face, const double reach) : mesh(face.mesh())
  {
    // Curved, turned and graded boxes are axis-parallel in logical coordinates as well. The face
    // point below or above a node therefore has the same tangential coordinates as the node.
    const LogicalFaces<dim> faces(face);
    for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
      {
        if (mesh.body_of_node(node) != face.body() || mesh.is_hanging(node))
          continue;
        const auto  &logical = mesh.logical_positions()[node];
        const double b       = blend_factor(face, logical, reach);
        // The node is beyond the reach and stays.
        if (b == 0.)
          continue;
        rows.push_back({node, faces.weights(faces.tangential(logical))});
        for (auto &weight : rows.back().weights)
          weight.second *= b;
      }
  }

  Field extend(const FaceField &moves) const override
  {
    Field result(mesh.n_local_nodes());
    for (const NodeWeights &row : rows)
      for (const auto &weight : row.weights)
        result[row.node] += weight.second * moves[weight.first];
    return result;
  }

private:
  /// The weights of the face nodes at one node of the body, multiplied by b.
  struct NodeWeights
  {
    unsigned int                                 node; ///< local
    std::vector<std::pair<unsigned int, double>> weights;
  };

  const mesh::BodyMesh<dim> &mesh;
  std::vector<NodeWeights>   rows;
};
} // namespace

template <int dim>
std::unique_ptr<Interior<dim>> linear_blending(const ShapedFace<dim> &face,
                                               const ShapeParameters &parameters)
{
  return std::make_unique<LinearBlending<dim>>(face, parameters.reach);
}

template std::unique_ptr<Interior<2>> linear_blending(const ShapedFace<2> &,
                                                      const ShapeParameters &);
template std::unique_ptr<Interior<3>> linear_blending(const ShapedFace<3> &,
                                                      const ShapeParameters &);
} // namespace snug::shape
