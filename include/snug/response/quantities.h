#ifndef snug_response_quantities_h
#define snug_response_quantities_h

#include <snug/response/pressure_measures.h>
#include <snug/response/response.h>

#include <functional>

namespace snug::response {
/// Which of the pairs of contact are called @p name, either side first; empty: all.
/// @throws InputError if there is none.
template <int dim>
std::vector<bool> chosen_pairs(const state::StateSolver<dim> &solver, const std::string &name);

/// Which contact rows belong to the pair called @p name, either side
/// first; empty: all. @throws InputError if there is no such pair.
template <int dim>
std::vector<double> row_shares(const state::StateSolver<dim> &solver, const std::string &name);

/// @name What response_table() is made of
/// @{

/**
 * J = s 1/2 u'Ku + l f'u [force length]. For the potential energy, s = 1
 * and l = -1, the derivative needs no solve, because u minimises J on the
 * contact constraints: J' = 1/2 u'K'u - f''u + lambda'(B'u - g').
 * @p value: where a state holds J.
 */
template <int dim>
std::unique_ptr<Response<dim>>
work(double state::ContactState<dim>::*value, double stiffness, double load);

/// J = int w dV over one body or all: their volume [length^3], w = 1, or
/// their mass, w the density. Depends on the geometry alone.
template <int dim>
std::unique_ptr<Response<dim>> body_integral(const ResponseParameters &parameters, bool mass);

/**
 * A displacement [length]: a component of that of a point,
 * J = sum_a N_a(xi) u_a . e, where the design carries the point along,
 * xi being its place in its cell in the reference geometry; or one
 * averaged over a face, J = int u . e dA / int dA, with e = n for the
 * component along the outward normal.
 */
template <int dim>
std::unique_ptr<Response<dim>> displacement(const ResponseParameters &parameters);

/**
 * J = (int sigma_vM^p dV / int dV)^(1/p) [force / length^2], p >= 1, over
 * one body or all: the p-norm of the von Mises stress, divided by that
 * of 1. It grows with p to the largest stress at the Gauss points.
 */
template <int dim>
std::unique_ptr<Response<dim>> von_mises_norm(const ResponseParameters &parameters);

/**
 * J = 1 - (sum (1 - q)^p)^(1/p) with the scaled Jacobians q at the nodes and
 * Gauss points of the cells of one body or all, see Element: below the
 * least q, the nearer to it the larger p, and 1 where all angles are right
 * ones. Depends on the geometry alone.
 */
template <int dim>
std::unique_ptr<Response<dim>> least_scaled_jacobian(const ResponseParameters &parameters);

/**
 * The same with q = det J / det J_0, J_0 of the reference mesh, at most 1:
 * cells that are squeezed keep their angles until they tangle.
 */
template <int dim>
std::unique_ptr<Response<dim>> least_cell_size(const ResponseParameters &parameters);

/**
 * J = -sum_i p_i n_i . e [force]: component e of the force of a pair, or
 * of all pairs, on the slave side, with the normals n_i into the master.
 * For the component normal J = sum_i p_i.
 */
template <int dim>
std::unique_ptr<Response<dim>> contact_force(const ResponseParameters &parameters);

using Measure = std::function<Measured(const PressureRows &)>;

/**
 * A function of the contact forces and tributary areas of one pair, or
 * of all pairs; see pressure_measures.h for what there is. Rows that
 * cannot carry a force, or have no area, do not count.
 * @param entries  those that the measure reads, besides the pair.
 * @param power    the highest power of the pressure under an integral of the measure.
 */
template <int dim>
std::unique_ptr<Response<dim>> contact_measure(const ResponseParameters       &parameters,
                                               const Measure                  &measure,
                                               const std::vector<std::string> &entries = {},
                                               double                          power   = 1.);
/// @}
} // namespace snug::response

#endif
