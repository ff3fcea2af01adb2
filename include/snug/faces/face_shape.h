#ifndef snug_faces_face_shape_h
#define snug_faces_face_shape_h

#include <snug/mesh/lagrange.h>
#include <snug/mesh/surface.h>

#include <array>
#include <type_traits>
#include <vector>

namespace snug::faces {
/**
 * This class provides the Lagrange shape functions with equispaced nodes of a boundary face. The
 * coordinates are xi in [0,1]^(dim-1). The nodes are in tensor order, the first coordinate fastest.
 * Faces are linear or quadratic segments in 2D, and bilinear or biquadratic quadrilaterals in 3D.
 */
template <int dim>
class FaceShape
{
public:
  static constexpr int n_tangents = dim - 1;
  using Coordinates               = dealii::Point<dim - 1>;
  using Field                     = typename mesh::Surface<dim>::Field;
  using Tangents                  = std::array<dealii::Tensor<1, dim>, dim - 1>;

  /// Values and derivatives of all shape functions at one point.
  using Values = mesh::LagrangePoint<dim - 1>;

  explicit FaceShape(unsigned int degree) : p(degree), nodes(mesh::lagrange_nodes<dim - 1>(degree))
  {
    for (const auto &node : nodes)
      samples_at_nodes.push_back(samples_at(node.point));
    for (const auto &sample : mesh::lagrange_nodes<dim - 1>(mesh::surface_degree))
      nodes_at_samples.push_back(at(sample.point));
    for (const auto &point : mesh::lagrange_nodes<dim - 1>(2 * degree))
      grid_values.push_back(at(point.point));
  }

  unsigned int n_nodes() const { return nodes.size(); }
  unsigned int degree() const { return p; }

  /// Return the coordinates of node @p k.
  Coordinates node(unsigned int k) const { return nodes[k].point; }

  Values at(const Coordinates &xi) const { return mesh::lagrange_point<dim - 1>(p, xi); }

  /// Return the values at node @p k.
  const Values &at_node(unsigned int k) const { return nodes[k]; }

  /// Return the values on an even grid of 2p + 1 points per direction, the first one fastest.
  const std::vector<Values> &grid() const { return grid_values; }

  /// @name Shape functions of the samples of a face, which describe its true surface
  /// @{
  static Values samples_at(const Coordinates &xi)
  {
    return mesh::lagrange_point<dim - 1>(mesh::surface_degree, xi);
  }

  const Values &samples_at_node(unsigned int k) const { return samples_at_nodes[k]; }
  /// @}

  /// Return the shape functions at sample @p k.
  const Values &at_sample(unsigned int k) const { return nodes_at_samples[k]; }

private:
  unsigned int        p;
  std::vector<Values> nodes, samples_at_nodes, nodes_at_samples, grid_values;
};

/// Points and shape functions that describe the true surface of a face: its samples, or its nodes
/// if it has no samples.
template <int dim>
struct TrueSurface
{
  const std::vector<unsigned int>       &points; ///< indices of surface points
  const typename FaceShape<dim>::Values &at_node;

  /// Evaluate at node @p k of @p face.
  TrueSurface(const FaceShape<dim>                    &shape,
              const typename mesh::Surface<dim>::Face &face,
              unsigned int                             k)
    : points(face.samples.empty() ? face.nodes : face.samples)
    , at_node(face.samples.empty() ? shape.at_node(k) : shape.samples_at_node(k))
  {}
};

/// Return x,_1 and x,_2 of the face with @p nodes at a point with shape @p values. @p field
/// contains positions, or velocities for the derivatives of the tangents: a Field or a PointField.
template <int dim, typename Points>
auto tangents(const typename FaceShape<dim>::Values &values,
              const std::vector<unsigned int>       &nodes,
              const Points                          &field)
{
  std::array<std::decay_t<decltype(field[0])>, dim - 1> t;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < dim - 1; ++i)
      t[i] += values.gradient[k][i] * field[nodes[k]];
  return t;
}

/// Return the outward area vector: (t_y, -t_x), which is t rotated by -90 degrees, in 2D. Faces are
/// oriented such that this vector, or t1 x t2 in 3D, points out of the body.
template <typename Number>
dealii::Tensor<1, 2, Number> area_vector(const std::array<dealii::Tensor<1, 2, Number>, 1> &t)
{
  return dealii::cross_product_2d(t[0]);
}

/// Return the outward area vector t1 x t2.
template <typename Number>
dealii::Tensor<1, 3, Number> area_vector(const std::array<dealii::Tensor<1, 3, Number>, 2> &t)
{
  return dealii::cross_product_3d(t[0], t[1]);
}

/// Return the derivative of area_vector() at @p t along @p dt.
dealii::Tensor<1, 2> area_vector_derivative(const std::array<dealii::Tensor<1, 2>, 1> &t,
                                            const std::array<dealii::Tensor<1, 2>, 1> &dt);
dealii::Tensor<1, 3> area_vector_derivative(const std::array<dealii::Tensor<1, 3>, 2> &t,
                                            const std::array<dealii::Tensor<1, 3>, 2> &dt);

/// Return the transpose applied to @p b: b . area_vector_derivative(t, dt) = sum_i result_i . dt_i.
std::array<dealii::Tensor<1, 2>, 1>
area_vector_transpose(const std::array<dealii::Tensor<1, 2>, 1> &t, const dealii::Tensor<1, 2> &b);
std::array<dealii::Tensor<1, 3>, 2>
area_vector_transpose(const std::array<dealii::Tensor<1, 3>, 2> &t, const dealii::Tensor<1, 3> &b);
} // namespace snug::faces

#endif
