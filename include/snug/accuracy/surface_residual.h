#ifndef snug_accuracy_surface_residual_h
#define snug_accuracy_surface_residual_h

#include <snug/accuracy/load_residual.h>
#include <snug/state/state_solver.h>

namespace snug::accuracy {
/// The volume between the true surface of a body and the polynomials of degree surface_degree
/// through it on each face, over the volume of the body.
struct UnseenVolume
{
  double              missed = 0.;
  std::vector<double> of_cells; ///< its parts in the cells of this rank
};

/// Of all bodies, at the reference. Collective.
template <int dim>
std::vector<UnseenVolume> unseen_volumes(const mesh::BodyMesh<dim> &mesh);

/**
 * The pressure that roughness of the gap would make where it is finer than faces: on a face
 * @f[ q = \tfrac12 E^* \max|\nabla r|,\qquad
 *     1/E^* = (1 - \nu_1^2)/E_1 + (1 - \nu_2^2)/E_2, @f]
 * r what the gap has beyond the quadratic polynomial through it, of `Gap` and of both sides, unless
 * these lie on spheres and the like. Of a wave of amplitude d and length l this is pi E^* d / l,
 * its pressure in full contact. Faces count where the gap, with r, closes.
 */
struct RoughPressure
{
  std::string pair;
  /// sum of ((1 + q/p)^4 - 1)/4 dA over the contact area, p the mean pressure: q dA over the
  /// force of the pair where q is small, and more of peaks
  double              missed = 0.;
  std::vector<double> of_cells;  ///< its parts in the cells of this rank
  std::vector<double> to_refine; ///< the same, 0 on faces that are small beside the contact
};

/// Of all pairs. Collective.
template <int dim>
std::vector<RoughPressure> rough_pressures(const state::StateSolver<dim>  &solver,
                                           const state::ContactState<dim> &state);

/// The cells to refine until the rough pressures of each pair are at most the part @p share of its
/// pressure. Collective.
template <int dim>
Unresolved unresolved_gaps(const state::StateSolver<dim>  &solver,
                           const state::ContactState<dim> &state,
                           double                          share);
} // namespace snug::accuracy

#endif
