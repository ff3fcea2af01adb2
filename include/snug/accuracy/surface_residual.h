#ifndef snug_accuracy_surface_residual_h
#define snug_accuracy_surface_residual_h

#include <snug/accuracy/load_residual.h>
#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// The volume between the true surface of a body and its interpolation by polynomials of degree
/// surface_degree on each face, over the volume of the body.
struct UnseenVolume
{
  double              missed = 0.;
  std::vector<double> of_cells; ///< contributions of the cells of this rank
};

/// Return the unresolved volumes of all bodies in the reference geometry. Collective.
template <int dim>
std::vector<UnseenVolume> unseen_volumes(const mesh::BodyMesh<dim> &mesh);

/**
 * The pressure that roughness of the gap would cause if it is finer than the faces. On a face it is
 * @f[ q = \tfrac12 E^* \max|\nabla r|,\qquad
 *     1/E^* = (1 - \nu_1^2)/E_1 + (1 - \nu_2^2)/E_2, @f]
 * where r is the deviation of the gap from the quadratic polynomial through it. The gap consists
 * of `Gap` and of both sides, except sides on known surfaces such as spheres. For a wave of
 * amplitude d and length l, q is pi E^* d / l, the pressure in full contact. Only faces on which
 * the gap, including r, closes contribute.
 */
struct RoughPressure
{
  std::string pair;
  /// sum of ((1 + q/p)^4 - 1)/4 dA over the contact area, with the mean pressure p. It is q dA
  /// over the force of the pair if q is small, and more at peaks.
  double              missed = 0.;
  std::vector<double> of_cells;  ///< contributions of the cells of this rank
  std::vector<double> to_refine; ///< the same, but 0 on faces that are small beside the contact
};

/// Return the rough pressures of all pairs. Collective.
template <int dim>
std::vector<RoughPressure> rough_pressures(const state::StateSolver<dim>  &solver,
                                           const state::ContactState<dim> &state);

/// Return the cells to refine until the rough pressures of each pair are at most the share @p share
/// of its pressure. Collective.
template <int dim>
Unresolved unresolved_gaps(const state::StateSolver<dim>  &solver,
                           const state::ContactState<dim> &state,
                           double                          share);
} // namespace snug::accuracy

#endif
