#ifndef snug_contact_point_gaps_h
#define snug_contact_point_gaps_h

#include <snug/contact/obstacle.h>
#include <snug/contact/pair_geometry.h>
#include <snug/contact/projection.h>
#include <snug/contact/supported_normals.h>
#include <snug/geometry/formula.h>

namespace snug::contact {
/// What a row would be at a point x of a slave side: n . (u(x) - sum_k w_k u_k) <= gap.
template <int dim>
struct PointGap
{
  dealii::Tensor<1, dim> normal;          ///< n, of length 1, into the master
  double                 gap = 0.;        ///< between the true surfaces [length]
  Weights                masters;         ///< w_k; none of obstacles
  Boundary               master_boundary; ///< {} of obstacles
};

/// The gaps of a pair at any points of its slave side, as NodalRows and ObstacleRows have
/// them at nodes, by normals of the master, and MortarRows between them, by those of the slave.
template <int dim>
class PointGaps
{
public:
  using Field = typename mesh::Surface<dim>::Field;

  /// Surface, shape, positions and what is held must outlive this.
  explicit PointGaps(const PairGeometry<dim> &pair);
  ~PointGaps();

  /// At the point @p x of the slave's true surface, of a face of which its nodes have the weights
  /// @p slave there; nothing beyond the end of the master side.
  std::optional<PointGap<dim>> at(const dealii::Tensor<1, dim> &x, const Weights &slave) const;

  /// The part of the gap at @p x that is given by formulas [length]: `Gap`, and the distance of an
  /// obstacle, where there is one.
  double given(const dealii::Tensor<1, dim> &x) const;

private:
  using Normals = std::unique_ptr<SupportedNormals<dim>>;

  std::optional<PointProjection<dim>> foot(const dealii::Tensor<1, dim> &x,
                                           const dealii::Tensor<1, dim> &slave_normal) const;
  dealii::Tensor<1, dim>              place(const PointProjection<dim> &foot) const;

  const Field                            &positions;
  std::unique_ptr<geometry::Formula<dim>> offset;
  std::unique_ptr<Obstacle<dim>>          obstacle;
  dealii::Tensor<1, dim>                  shift; ///< of the obstacle
  const mesh::Surface<dim>               &surface;
  std::vector<unsigned int>               master_faces, slave_faces;
  Normals                                 normals, slave_normals; ///< the latter of mortar
  std::unique_ptr<Projector<dim>>         projector;
};
} // namespace snug::contact

#endif
