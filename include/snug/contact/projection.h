#ifndef snug_contact_projection_h
#define snug_contact_projection_h

#include <snug/contact/nearest_face.h>
#include <snug/contact/pair_geometry.h>
#include <snug/contact/pair_normals.h>
#include <snug/contact/projection_equations.h>
#include <snug/faces/outer_edges.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace snug::contact {
/// Ascending surface nodes or points with their weights, which sum to 1.
using Weights = std::vector<std::pair<unsigned int, double>>;

/**
 * Projection of a point p to a master face. The foot point of p is the point x(xi) = sum_k w_k x_k
 * of the face from which the vector v of PairNormals leads to p, p = x(xi) + t v(xi),  v(xi) =
 * sum_k w_k n_k - n_p,  w_k = N_k(xi). With n_p = 0 on a circle or a sphere v is radial up to
 * round-off, so that rows have no lever about its centre. The point of the facet that is closest
 * to the node would give rows such a lever.
 */
template <int dim>
struct PointProjection
{
  unsigned int           face;      ///< index of the surface face
  dealii::Point<dim - 1> xi;        ///< coordinates of the foot point
  bool                   is_normal; ///< false: the closest point, as no vector v leads to p
  Weights                masters;   ///< nodes of the face
  Weights                surface;   ///< points that give the true surface where the normal meets it
  double softening; ///< edge_softening() beyond the end of the master side, else 0 [length]
};

/// Projection of a slave node, computed once per pairing.
template <int dim>
struct Projection : PointProjection<dim>
{
  unsigned int slave; ///< surface node
};

/**
 * Maximum distance of a slave node beyond the outer edge of the master side, as a fraction of the
 * master face's extent. A slave node whose closest point lies on the outer edge is paired only if
 * it is beyond that edge by less than this fraction.
 */
constexpr double edge_tolerance = 0.05;

/**
 * Return the additional gap of a node that is beyond the edge of the master side by @p excess, a
 * fraction of the face, of size h [length]:
 *   r t^4 / (2 (1 - t^2)),  t = excess / edge_tolerance,  r = edge_tolerance h.
 * The additional gap is negligible where the two sides end together except for their facets. It has
 * no kink, and it is infinite where nodes cease to carry a row. So forces fade as nodes leave the
 * master side.
 */
constexpr double edge_softening(double excess, double h)
{
  const double t = excess / edge_tolerance;
  return 0.5 * edge_tolerance * h * t * t * t * t / (1. - t * t);
}

/**
 * This class projects points onto a master side along PairNormals. The search
 * starts from the closest point. The closest point is taken where no normal is found, as beyond the
 * edge. The candidate faces come from a tree of boxes that contain the faces, so that no face is
 * missed. Of equally close faces, the one with the lowest index is taken. Weights below 1e-12
 * become 0.
 */
template <int dim>
class Projector
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Prepare the projection to the faces @p master, at least one face, with the @p normals of its
  /// nodes. The references must outlive this object.
  Projector(const mesh::Surface<dim>        &surface,
            const std::vector<unsigned int> &master,
            const faces::FaceShape<dim>     &shape,
            const Field                     &positions,
            const Field                     &normals);

  /// Return the projection of @p p with the normal @p of_slave, n_p, or nothing beyond the edge of
  /// the master side.
  std::optional<PointProjection<dim>> onto(const dealii::Tensor<1, dim> &p,
                                           const dealii::Tensor<1, dim> &of_slave) const;

  /// Return the projection of @p p also beyond the edge, where it is the closest point.
  PointProjection<dim> nearest(const dealii::Tensor<1, dim> &p,
                               const dealii::Tensor<1, dim> &of_slave) const
  {
    return projection(p, of_slave, side.closest(at_height(p, of_slave)), 0.);
  }

private:
  const mesh::Surface<dim>              &surface;
  const faces::FaceShape<dim>           &shape;
  const Field                           &positions, &normals;
  const NearestFace<dim>                 side;
  const faces::OuterEdges<dim>           edges;
  std::vector<std::vector<unsigned int>> faces_at; ///< per surface node

  ProjectionEquations<dim> equations(unsigned int                  face,
                                     const dealii::Tensor<1, dim> &of_slave) const
  {
    return {surface.faces()[face], shape, positions, normals, of_slave};
  }

  /// Return @p p, moved along v at its closest point to the height of this point. Beside a curved
  /// side the foot point along the mean of two normals may be several faces off the closest point
  /// of p. Return @p p itself if @p of_slave is 0.
  dealii::Tensor<1, dim> at_height(const dealii::Tensor<1, dim> &p,
                                   const dealii::Tensor<1, dim> &of_slave) const;

  /// Return the face and the coordinates of the foot point of @p p, searched near the point
  /// @p start. Return nothing where the side ends.
  std::optional<std::pair<unsigned int, dealii::Point<dim - 1>>>
  find_normal(const dealii::Tensor<1, dim>           &p,
              const dealii::Tensor<1, dim>           &of_slave,
              const typename NearestFace<dim>::Found &start) const;

  /// Return the projection of @p p, which is the point @p start where no v leads to p. @p excess is
  /// the distance of p beyond the edge.
  PointProjection<dim> projection(const dealii::Tensor<1, dim>           &p,
                                  const dealii::Tensor<1, dim>           &of_slave,
                                  const typename NearestFace<dim>::Found &start,
                                  double                                  excess) const;
};

/// Return the projections of the slave nodes that do not hang, in the order of the slave faces and
/// their nodes. Nodes beyond the edge of the master side are left out. The ranks share the nodes.
/// Collective.
template <int dim>
std::vector<Projection<dim>> project(const mesh::Surface<dim>                 &surface,
                                     const PairFaces                          &sides,
                                     const faces::FaceShape<dim>              &shape,
                                     const typename mesh::Surface<dim>::Field &positions,
                                     const typename PairNormals<dim>::Fields  &normals);
} // namespace snug::contact

#endif
