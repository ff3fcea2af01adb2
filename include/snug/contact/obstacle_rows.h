#ifndef snug_contact_obstacle_rows_h
#define snug_contact_obstacle_rows_h

#include <snug/contact/pair_geometry.h>
#include <snug/contact/row_group.h>

namespace snug::contact {
/**
 * Slave nodes against a rigid obstacle. With the distance d(x) to the
 * obstacle as it is placed, the row of slave node s is
 *   c_s = n = -grad d(x_s),  gap = d(x_s) + n . w,
 * where w is the displacement of the obstacle. Normal and gap follow the
 * slave node: n' = -H V_s with the Hessian H of d, d' = -n . V_s.
 * Slave nodes that hang, are out of reach or do not face the obstacle
 * (Opposition) carry no row.
 */
template <int dim>
class ObstacleRows : public RowGroup<dim>
{
public:
  using Field = typename RowGroup<dim>::Field;

  explicit ObstacleRows(const PairGeometry<dim> &pair);

  const std::vector<unsigned int> &slaves() const override;
  std::vector<Row<dim>>            rows(const Field &positions) const override;
  std::vector<Row<dim>>            row_derivatives(const Field &positions,
                                                   const Field &velocity) const override;
  void                             add_energy_gradient(const Field               &positions,
                                                       const Field               &displacement,
                                                       const std::vector<double> &forces,
                                                       Field                     &gradient) const override;
  std::vector<double>              areas(const Field &positions) const override;
  void                             add_area_gradient(const Field               &positions,
                                                     const std::vector<double> &factors,
                                                     Field                     &gradient) const override;

private:
  const mesh::Surface<dim>      &surface;
  const faces::FaceShape<dim>   &shape;
  std::unique_ptr<Obstacle<dim>> obstacle;
  dealii::Tensor<1, dim>         shift; ///< w
  std::vector<unsigned int>      slave_faces, slave_nodes;

  ObstacleDistance<dim> distance(const dealii::Tensor<1, dim> &x) const;
};
} // namespace snug::contact

#endif
