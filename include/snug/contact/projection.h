#ifndef snug_contact_projection_h
#define snug_contact_projection_h

#include <snug/contact/nearest_face.h>
#include <snug/contact/normal_rays.h>
#include <snug/contact/pair_geometry.h>
#include <snug/faces/outer_edges.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace snug::contact {
/// Surface nodes or points, ascending, and weights, which sum to 1.
using Weights = std::vector<std::pair<unsigned int, double>>;

/**
 * A point p against a master face: its foot, the point x(xi) =
 * sum_k w_k x_k of the face from which the normal of the master side leads
 * to it,
 *   p = x(xi) + t v(xi),  v(xi) = sum_k w_k n_k,  w_k = N_k(xi),
 * with the nodal normals n_k. On a circle or a sphere v is radial to
 * rounding, so that rows have no lever about its centre, as they would have
 * from the point of the facet that is closest to the node.
 */
template <int dim>
struct PointProjection
{
  unsigned int           face;    ///< of the surface
  dealii::Point<dim - 1> xi;      ///< of the foot
  bool                   is_ray;  ///< false: the closest point, as no ray leads to the node
  Weights                masters; ///< the nodes of the face
  Weights                surface; ///< the points that give the true surface where the ray meets it
  double relief; ///< edge_relief() beyond the end of the master side, else 0 [length]
};

/// That of a slave node, found once.
template <int dim>
struct Projection : PointProjection<dim>
{
  unsigned int slave; ///< surface node
};

/**
 * A slave node whose closest point lies on the outer edge of the master
 * side is paired if it is beyond that edge by less than this fraction of
 * the master face's extent.
 */
constexpr double edge_tolerance = 0.05;

/**
 * How far the master gives way to a node that is beyond its edge by
 * @p excess, a part of the face, of size h [length]:
 *   r t^4 / (2 (1 - t^2)),  t = excess / edge_tolerance,  r = edge_tolerance h.
 * Next to nothing where sides end together but for their facets, without a
 * kink, and infinite where nodes carry no row any more, so that forces fade
 * as nodes leave the master side.
 */
constexpr double edge_relief(double excess, double h)
{
  const double t = excess / edge_tolerance;
  return 0.5 * edge_tolerance * h * t * t * t * t / (1. - t * t);
}

/**
 * Projects points onto a master side by the @p normals of its nodes. The search starts
 * from the closest point, which is taken where no ray is found, as beyond the
 * edge. The faces to be tried come from a tree of boxes
 * that contain them, so none is missed. Where faces are equally close, the
 * one with the lowest index is taken; weights below 1e-12 become 0.
 */
template <int dim>
class Projector
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// @p master: at least one face. The references must outlive this.
  Projector(const mesh::Surface<dim>        &surface,
            const std::vector<unsigned int> &master,
            const faces::FaceShape<dim>     &shape,
            const Field                     &positions,
            const Field                     &normals);

  /// Nothing beyond the edge of the master side.
  std::optional<PointProjection<dim>> onto(const dealii::Tensor<1, dim> &p) const;

private:
  const mesh::Surface<dim>              &surface;
  const faces::FaceShape<dim>           &shape;
  const Field                           &positions, &normals;
  const NearestFace<dim>                 side;
  const faces::OuterEdges<dim>           edges;
  std::vector<std::vector<unsigned int>> faces_at; ///< per surface node

  NormalRays<dim> rays(unsigned int face) const
  {
    return {surface.faces()[face], shape, positions, normals};
  }

  /// Face and coordinates where the ray to @p p begins, near those of the closest point; none
  /// where the side ends.
  std::optional<std::pair<unsigned int, dealii::Point<dim - 1>>>
  find_ray(const dealii::Tensor<1, dim> &p,
           unsigned int                  face,
           const dealii::Point<dim - 1> &closest) const;
};

/// Projections of the slave nodes that do not hang, in the order of the
/// slave faces and their nodes, without the nodes beyond the edge of the
/// master side.
template <int dim>
std::vector<Projection<dim>> project(const mesh::Surface<dim>                 &surface,
                                     const PairFaces                          &sides,
                                     const faces::FaceShape<dim>              &shape,
                                     const typename mesh::Surface<dim>::Field &positions,
                                     const typename mesh::Surface<dim>::Field &normals);
} // namespace snug::contact

#endif
