#ifndef snug_io_nodal_stress_h
#define snug_io_nodal_stress_h

#include <snug/state/assembler.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace snug::io {
/// Return the maximum number of regions of a body.
template <int dim>
unsigned int n_stress_regions(const mesh::BodyMesh<dim> &mesh);

/**
 * Return the Cauchy stress at the local nodes [force / length^2], including the component zz of
 * sections (hoop stress if axisymmetric). The field is continuous in each region of a body and is
 * used for pictures. Its index is node * n_stress_regions() + region. It is zero if a node is not
 * in the region.
 *
 * In a cell of degree p the stress is evaluated at the p^dim Gauss points, where it is most
 * accurate (Barlow, Int. J. Numer. Meth. Engng 10 (1976)), and is extrapolated to the nodes. For
 * Q1 the extrapolation uses the slopes of the linear field that best fits the stresses at the
 * centers of the surrounding cells, as in the patch recovery of Zienkiewicz and Zhu (ibid. 33
 * (1992)). For Q2 it uses the function through the points that is linear per axis. A node gets
 * the mean over its cells in the region, weighted by 1/volume. Hanging nodes are interpolated
 * between masters in the region.
 *
 * The stress is of second order, and exact for linear fields on any mesh of Q1. It is of first
 * order at the surfaces of Q1 bodies of a single layer of cells. It is valid at the nodes of
 * owned cells. Collective.
 *
 * @param[in] bodies Materials and formulations.
 * @param[in] positions, displacement Values at the local nodes, valid at nodes of owned cells
 * [length].
 * @param[in] loads Loads of the bodies, whose temperatures cause thermal strains; empty: none.
 */
template <int dim>
std::vector<dealii::SymmetricTensor<2, 3>>
nodal_stress(const mesh::BodyMesh<dim>                 &mesh,
             const std::vector<state::BodyModel<dim>>  &bodies,
             const typename mesh::BodyMesh<dim>::Field &positions,
             const typename mesh::BodyMesh<dim>::Field &displacement,
             const std::vector<state::BodyLoads<dim>>  &loads = {});
} // namespace snug::io

#endif
