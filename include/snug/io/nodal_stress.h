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
 * (1976)), and extrapolated to the nodes by the polynomial of degree p-1
 * through them: the constant of the centre for Q1, linear per axis for Q2.
 * A node gets the mean of its cells in the region weighted by 1/volume,
 * which gives back a linear field between the cells of a graded box;
 * hanging nodes are interpolated
 * between masters in the region. Second order inside a body; first order
 * on its surface for Q1.
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
