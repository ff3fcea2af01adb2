#ifndef snug_response_quantities_h
#define snug_response_quantities_h

#include <snug/response/pressure_measures.h>
#include <snug/response/response.h>

#include <functional>

namespace snug::response {
/// Return which of the contact pairs have the name @p name, with either side first. An empty
/// name selects all pairs.
/// @throws InputError if there is no such pair.
template <int dim>
std::vector<bool> chosen_pairs(const state::StateSolver<dim> &solver,
                               const std::string             &name,
                               unsigned int                   load_case);

/// Return the share of each contact row in the pair called @p name, with either side first.
/// An empty name selects all pairs. @throws InputError if there is no such pair.
template <int dim>
std::vector<double>
row_shares(const state::StateSolver<dim> &solver, const std::string &name, unsigned int load_case);

/// Return the shares of row_shares() with the sign of the forces on the side that the scene names
/// first: plus if this side is the slave, minus if it is the master.
template <int dim>
std::vector<double> row_shares_of_first_side(const state::StateSolver<dim> &solver,
                                             const std::string             &name,
                                             unsigned int                   load_case);

/// Return virtual motions of the nodes of the slave side of a pair, a function of their positions
/// in space, in the frames of the bodies. Other nodes are at rest.
template <int dim>
typename mesh::Surface<dim>::Field motion_of_slave(
  const state::StateSolver<dim>                                               &solver,
  const unsigned int                                                           load_case,
  const contact::Pair                                                         &pair,
  const typename mesh::Surface<dim>::Field                                    &positions,
  const std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &)> &motion);

/// @name Quantities of response_table()
/// @{

/**
 * Return the response J = s 1/2 u'Ku + l f'u [force length] with @p stiffness s and @p load
 * l. For the potential energy, s = 1 and l = -1, the derivative needs no solve, because u
 * minimizes J subject to the contact constraints: J' = 1/2 u'K'u - f''u + lambda'(B'u - g').
 * @param value member of the state that contains J.
 */
template <int dim>
std::unique_ptr<Response<dim>>
work(double state::ContactState<dim>::*value, double stiffness, double load);

/// Return the response J = int w dV over one body or all bodies. J is their volume [length^3]
/// with w = 1, or their mass with the density w. J depends on the geometry alone.
template <int dim>
std::unique_ptr<Response<dim>> body_integral(const ResponseParameters &parameters, bool mass);

/**
 * Return a displacement response [length]. For a point it is a component of the displacement,
 * J = sum_a N_a(xi) u_a . e. The design moves the point with its cell: xi is its reference
 * coordinate in the cell of the reference geometry. For a face it is the average J = int u . e dA /
 * int dA, with e = n for the component along the outward normal.
 */
template <int dim>
std::unique_ptr<Response<dim>> displacement(const ResponseParameters &parameters);

/**
 * Return the rotation of a face about an axis e [rad]: J = e . I^-1 int r x u dA with the distance
 * r from the centroid and the inertia I of the face. This is the rotation of the rigid motion that
 * is nearest to u over the face, positive from x to y about z, and the conjugate of the entry
 * Moment: if a moment on the face is the only load, J is the compliance over the moment.
 */
template <int dim>
std::unique_ptr<Response<dim>> rotation(const ResponseParameters &parameters);

/// Return a component of the force that supports apply to the nodes of a face, in space [force].
template <int dim>
std::unique_ptr<Response<dim>> reaction(const ResponseParameters &parameters);

/// Return the moment of these forces about an axis through a point, both in space [force length].
template <int dim>
std::unique_ptr<Response<dim>> reaction_moment(const ResponseParameters &parameters);

/// Return a component of the translation [length] or, if it @p turns, of the rotation [rad] of a
/// reference point; or the shortening of a bolt [length].
template <int dim>
std::unique_ptr<Response<dim>> point_motion(const ResponseParameters &parameters, bool turns);

/// Return a component of the force [force] or of the moment about the point [force length] of the
/// supports of a reference point; or the tension of a bolt [force].
template <int dim>
std::unique_ptr<Response<dim>> point_reaction(const ResponseParameters &parameters, bool turns);

/**
 * Return the response J = (int sigma_vM^p dV / int dV)^(1/p) [force / length^2], p >= 1, over one
 * body or all bodies: the p-norm of the von Mises stress, divided by the p-norm of 1. J grows with
 * p to the maximum stress at the Gauss points. With @p over_yield, sigma_vM is divided by the yield
 * stress of its material, and cells without a yield stress are left out.
 */
template <int dim>
std::unique_ptr<Response<dim>> von_mises_norm(const ResponseParameters &parameters,
                                              bool                      over_yield);

/**
 * Return the response J = 1 - (sum (1 - q)^p)^(1/p) with the scaled Jacobians q at the nodes and
 * Gauss points of the cells of one body or all bodies, see Element. J is below the minimum q and
 * approaches it as p grows. J is 1 if all angles are right angles. J depends on the geometry alone.
 */
template <int dim>
std::unique_ptr<Response<dim>> least_scaled_jacobian(const ResponseParameters &parameters);

/**
 * Return the same response with q = min(1, det J / det J_0) and J_0 of the reference mesh.
 * This response detects compressed cells, which keep their angles until they tangle.
 */
template <int dim>
std::unique_ptr<Response<dim>> least_cell_size(const ResponseParameters &parameters);

/**
 * Return the response J = -sum_i p_i n_i . e [force]: component e of the force of a pair, or
 * of all pairs, on the slave side, with the normals n_i into the master. For the component
 * normal J = sum_i p_i.
 */
template <int dim>
std::unique_ptr<Response<dim>> contact_force(const ResponseParameters &parameters);

/**
 * Return the same of the friction forces alone, J = -sum_i q_i . e with the shears q_i
 * (state::ContactPoint), or their moment on the slave side about an axis through a point in space,
 * J = -sum_i e . ((x_i - p) x q_i) [force length].
 */
template <int dim>
std::unique_ptr<Response<dim>> friction_force(const ResponseParameters &parameters);
template <int dim>
std::unique_ptr<Response<dim>> friction_moment(const ResponseParameters &parameters);

using Measure = std::function<Measured(const PressureRows &)>;

/// The amount of a contact that a measure takes as its force, with its derivatives by the normal
/// force, the area, the shear and the slip of the contact.
struct Amount
{
  double               value     = 0.;
  double               by_normal = 0., by_area = 0.;
  dealii::Tensor<1, 3> by_shear, by_slip;
};

using AmountOf = std::function<Amount(const state::ContactPoint &, const contact::RowFriction &)>;

/// @name Amounts of a contact
/// @{
Amount normal_force(const state::ContactPoint &point, const contact::RowFriction &law);
/// |shear|
Amount shear_force(const state::ContactPoint &point, const contact::RowFriction &law);
/// limit - |shear| of closed contacts: positive where they stick
Amount shear_reserve(const state::ContactPoint &point, const contact::RowFriction &law);
/// |slip| times area, so that the pressure of the measure is |slip|
Amount slip_over_area(const state::ContactPoint &point, const contact::RowFriction &law);
/// shear . slip
Amount friction_work(const state::ContactPoint &point, const contact::RowFriction &law);
/// @}

/**
 * Return a response that is a function of the contact forces, or of other amounts, and tributary
 * areas of one pair, or of all pairs; see pressure_measures.h for the functions. Rows that cannot
 * carry a force, or have no area, are left out.
 * @param entries  entries that the measure reads, besides the pair.
 * @param power    maximum power of the pressure under an integral of the measure.
 */
template <int dim>
std::unique_ptr<Response<dim>> contact_measure(const ResponseParameters       &parameters,
                                               const Measure                  &measure,
                                               const std::vector<std::string> &entries = {},
                                               double                          power   = 1.,
                                               const AmountOf &amount = normal_force);
/// @}
} // namespace snug::response

#endif
