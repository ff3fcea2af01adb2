#ifndef snug_io_nodal_stress_h
#define snug_io_nodal_stress_h

#include <snug/state/assembler.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace snug::io {
/// Largest number of regions of a body.
template <int dim>
unsigned int n_stress_regions(const mesh::BodyMesh<dim> &mesh);

/**
 * Cauchy stress at the local nodes [force / length^2], components zz of
 * sections (axisymmetric: hoop stress) included: a field that is
 * continuous in each region of a body, for pictures: index
 * node * n_stress_regions() + region, zero where a node is not in the
 * region. In a cell of degree p the stress is taken at the p^dim Gauss
 * points, where it is most accurate (Barlow, Int. J. Numer. Meth. Engng 10
 * (1976)), and extrapolated to the nodes: of Q1 by the slopes of the linear
 * field that fits the stresses at the centres of the cells around best, as
 * in the patch recovery of Zienkiewicz and Zhu (ibid. 33 (1992)), of Q2 by
 * the function through the points that is linear per axis. A node gets the
 * mean of its cells in the region weighted by 1/volume; hanging nodes are
 * interpolated between masters in the region. Second order, and exact for
 * linear fields on any mesh of Q1; first order at the surfaces of Q1 bodies
 * of a single layer of cells.
 *
 * Valid at the nodes of owned cells. Collective.
 *
 * @param[in] bodies Materials and formulations.
 * @param[in] positions, displacement On the local nodes, valid at nodes of
 *   owned cells [length].
 */
template <int dim>
std::vector<dealii::SymmetricTensor<2, 3>>
nodal_stress(const mesh::BodyMesh<dim>                 &mesh,
             const std::vector<state::BodyModel<dim>>  &bodies,
             const typename mesh::BodyMesh<dim>::Field &positions,
             const typename mesh::BodyMesh<dim>::Field &displacement);
} // namespace snug::io

#endif
