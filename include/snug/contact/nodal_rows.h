#ifndef snug_contact_nodal_rows_h
#define snug_contact_nodal_rows_h

#include <snug/contact/projection.h>
#include <snug/contact/row_group.h>
#include <snug/contact/supported_normals.h>

namespace snug::contact {
/**
 * Nodal (node to face) contact of one pair. The row of slave node s with
 * the weights w_k of its closest point (see Projection) is
 * c_s = n, c_k = -w_k n, gap = n . (sum_k w_k x_k - x_s),
 * n = -v/|v|, v = sum_k w_k n_k by the SupportedNormals n_k of the master;
 * hanging master nodes are replaced by their masters. Faces and weights
 * stay, normals and gaps follow the positions. Slave nodes that hang, or
 * whose closest point lies beyond the edge of the master side
 * (edge_tolerance), is out of reach or does not face them (Opposition),
 * carry no row.
 */
template <int dim>
class NodalRows : public RowGroup<dim>
{
public:
  using Field = typename RowGroup<dim>::Field;

  explicit NodalRows(const PairGeometry<dim> &pair);

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
  const mesh::Surface<dim>    &surface;
  const faces::FaceShape<dim> &shape;
  PairFaces                    sides;
  faces::HeldDirections<dim>   held;
  std::vector<Projection>      found;
  std::vector<unsigned int>    slave_nodes;
  /// of each row: surface nodes, ascending, and their factors of n in the
  /// coefficients: 1 (slave) or -w (masters, none hanging)
  std::vector<std::vector<std::pair<unsigned int, double>>> factors;

  void                  resolve_hanging();
  SupportedNormals<dim> master_normals(const Field &positions) const;
};
} // namespace snug::contact

#endif
