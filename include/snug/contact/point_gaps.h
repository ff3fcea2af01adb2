#ifndef snug_contact_point_gaps_h
#define snug_contact_point_gaps_h

#include <snug/contact/joined_pairs.h>
#include <snug/contact/obstacle.h>
#include <snug/contact/pair_geometry.h>
#include <snug/contact/projection.h>
#include <snug/faces/nodal_normals.h>
#include <snug/geometry/formula.h>

namespace snug::contact {
/// Contact row at a point x of a slave side: n . (u(x) - sum_k w_k u_k) <= gap.
template <int dim>
struct PointGap
{
  dealii::Tensor<1, dim> normal;   ///< n, unit vector into the master
  double                 gap = 0.; ///< gap between the true surfaces [length]
  Weights                masters;  ///< w_k; empty for obstacles
  unsigned int           pair;     ///< index of the pair of the scene
};

/// This class computes the gaps of a pair at any points of its slave side. Nodal and obstacle
/// contact measure gaps along PairNormals, as nodal and obstacle rows do at nodes. Mortar contact
/// does so with mean normals. Without them it measures gaps along normals of the slave, as
/// MortarRows do between nodes.
template <int dim>
class PointGaps
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  using Formulas = std::vector<std::shared_ptr<const geometry::Formula<dim>>>;

  /// Prepare the gaps of @p pair, which is @p joined, with the gap @p formulas of the pairs of the
  /// scene. The surface, the shape, the positions, the held directions and the last two arguments
  /// must outlive this object.
  PointGaps(const PairGeometry<dim> &pair, const JoinedPair &joined, const Formulas &formulas);
  ~PointGaps();

  /// Return the gap at the point @p x of the true surface of the slave @p boundary, where the nodes
  /// of the slave face have the weights @p slave. Return nothing beyond the end of the master side.
  std::optional<PointGap<dim>>
  at(const dealii::Tensor<1, dim> &x, const Weights &slave, const Boundary &boundary) const;

  /// Return the part of the gap at @p x of a slave @p boundary that is given by formulas [length]:
  /// `Gap`, and the distance to the obstacle, if the pair has one.
  double given(const dealii::Tensor<1, dim> &x, const Boundary &boundary) const;

private:
  std::optional<PointProjection<dim>> project(const dealii::Tensor<1, dim> &x,
                                              const dealii::Tensor<1, dim> &slave_normal) const;
  dealii::Tensor<1, dim>              place(const PointProjection<dim> &projection) const;

  double offset(unsigned int pair, const dealii::Tensor<1, dim> &x) const;

  const Field                      &positions;
  const JoinedPair                 &joined;
  const Formulas                   &formulas;
  std::unique_ptr<Obstacle<dim>>    obstacle;
  dealii::Tensor<1, dim>            shift; ///< displacement of the obstacle
  const mesh::Surface<dim>         &surface;
  geometry::RigidMotion<dim>        slave_motion;
  PairFaces                         sides;
  std::unique_ptr<PairNormals<dim>> normals; ///< none for obstacles
  /// only for mortar contact without mean normals
  std::unique_ptr<faces::NodalNormals<dim>> slave_normals;
  std::unique_ptr<Projector<dim>>           projector;
};
} // namespace snug::contact

#endif
