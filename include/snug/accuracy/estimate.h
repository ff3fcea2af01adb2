#ifndef snug_accuracy_estimate_h
#define snug_accuracy_estimate_h

#include <snug/response/response.h>
#include <snug/sensitivity/gradient_parameters.h>

namespace snug::accuracy {
/// How far a displacement u_h on a mesh is from u without one.
struct EnergyEstimate
{
  /// eta_K of the cells of this rank, eta_K^2 = a(e, e) by LocalErrors
  std::vector<double> cells;
  /// eta = (sum eta_K^2)^(1/2) ~ |u - u_h|, |v|^2 = a(v, v) [(force length)^(1/2)]
  double error = 0.;
  /// eta / (|u_h|^2 + eta^2)^(1/2); 0 where nothing strains
  double relative = 0.;
};

/**
 * How far a response J(u_h, p_h) on a mesh is from J(u, p):
 * @f[ J - J_h \approx \sum_K \bigl(a_K(e_u, e_z) + \tfrac s2 a_K(e_u, e_u)\bigr)
 *     - B(u_h, z) - \tfrac s2 B(u_h, u_h)
 *     + \int q_\eta\,(g - n\cdot[u_h])\,dA
 *     + \lambda\cdot c(z + s u_h) - \int p_h\,n\cdot[z + s u_h]\,dA + J(p_h) - J_h, @f]
 * e_u and e_z the local errors of the state and of its adjoint less s u_h, B of SurfaceLayer,
 * q_eta the adjoint's contact forces by area, c the contact rows, and s the stiffness of
 * FieldDerivative. The last difference is that of pressures between nodes and those that J reads:
 * at degree 2 its size, and not what is before it.
 */
struct ResponseEstimate
{
  double cells   = 0.; ///< the sum over cells, less what lies beyond their faces, signed
  double contact = 0.; ///< the integrals, the sum over rows and the last difference, signed
  double reading = 0.; ///< the last difference, where it is not in contact
  /// size of what the mesh misses of data: the work of LoadResidual on the adjoint and, of
  /// pressures, RoughPressure
  double data = 0.;
  /// Of this rank's cells: sizes of their parts in both.
  std::vector<double> indicators;

  /// Return the sums of the parts of this rank's cells, those of contact times @p factor.
  /// Collective.
  static ResponseEstimate of_cells(const std::vector<double> &cells,
                                   const std::vector<double> &contact,
                                   double                     factor,
                                   MPI_Comm                   comm);

  /// Add the parts of an error that is of the data, times @p factor. Collective.
  void add_data(const std::vector<double> &of_cells, double factor, MPI_Comm comm);

  /// max(|cells + contact|, |cells|/2, |contact|/2) + |reading| + data: both may cancel by chance.
  double error() const;
};

/// All at a state.
struct Estimates
{
  EnergyEstimate                energy;
  std::vector<ResponseEstimate> responses;
};

/**
 * Estimate the error in the energy norm and those of responses, by one block solve for all that
 * need one. Where jumps between subdomains, which the solver leaves, make more than a tenth of an
 * estimated error, as near Poisson's ratio one half, the estimate would measure the solver: the
 * state and the adjoints are then solved on to smaller tolerances, as far as the solver can.
 * @param[out] solved_on the state that is estimated, if it is not @p state. Collective.
 * @throws SolveError where the adjoints cannot be solved at all.
 */
template <int dim>
Estimates estimate(const state::StateSolver<dim>                      &solver,
                   const state::ContactState<dim>                     &state,
                   const std::vector<const response::Response<dim> *> &responses,
                   sensitivity::Solves                                 solves,
                   std::optional<state::ContactState<dim>>            &solved_on);

/// Estimate the error in the energy norm alone, as estimate() does. Collective.
template <int dim>
EnergyEstimate estimate_energy(const state::StateSolver<dim>  &solver,
                               const state::ContactState<dim> &state);
} // namespace snug::accuracy

#endif
