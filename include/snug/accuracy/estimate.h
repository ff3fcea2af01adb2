#ifndef snug_accuracy_estimate_h
#define snug_accuracy_estimate_h

#include <snug/response/response.h>
#include <snug/sensitivity/gradient_parameters.h>

#include <optional>

namespace snug::accuracy {
/// Estimated distance of a displacement u_h on a mesh from the exact displacement u.
struct EnergyEstimate
{
  /// eta_K of the cells of this rank, eta_K^2 = a(e, e) by LocalErrors
  std::vector<double> cells;
  /// eta = (sum eta_K^2)^(1/2) ~ |u - u_h|, |v|^2 = a(v, v) [(force length)^(1/2)]
  double error = 0.;
  /// eta / (|u_h|^2 + eta^2)^(1/2); 0 if there is no strain
  double relative = 0.;
};

/**
 * Estimated difference of a response J(u_h, p_h) on a mesh from J(u, p):
 * @f[ J - J_h \approx \sum_K \bigl(a_K(e_u, e_z) + \tfrac s2 a_K(e_u, e_u)\bigr)
 *     - B(u_h, z) - \tfrac s2 B(u_h, u_h)
 *     + \int q_\eta\,(g - n\cdot[u_h])\,dA
 *     + \lambda\cdot c(z + s u_h) - \int p_h\,n\cdot[z + s u_h]\,dA + J(p_h) - J_h. @f]
 * e_u and e_z are the local errors of the state and of
 *   z = (adjoint of J) - s u_h - (motion),
 * with s and motion of response::FieldDerivative. B is that of SurfaceLayer, q_eta are the contact
 * forces of the adjoint per area, and c are the contact rows. The last difference is that between J
 * of the pressures between nodes and J of the pressures that J reads. At degree 2 its absolute
 * value enters, and the two terms before it are left out.
 */
struct ResponseEstimate
{
  double cells   = 0.; ///< signed sum over cells, minus the contribution B of the surface layer
  double contact = 0.; ///< signed sum of the integrals, the sum over rows and the last difference
  double reading = 0.; ///< the last difference if it is not part of contact
  /// estimated effect of data that the mesh does not resolve: the work of LoadResidual on the
  /// adjoint and, for pressures, RoughPressure
  double data = 0.;
  /// contributions of this rank's cells to both sums, as absolute values
  std::vector<double> indicators;

  /// Return the sums and indicators of the contributions of this rank's cells, with those of
  /// contact times @p factor. Collective.
  static ResponseEstimate of_cells(const std::vector<double> &cells,
                                   const std::vector<double> &contact,
                                   double                     factor,
                                   MPI_Comm                   comm);

  /// Add the contributions @p of_cells, times @p factor, to the error of the data. Collective.
  void add_data(const std::vector<double> &of_cells, double factor, MPI_Comm comm);

  /// Return max(|cells + contact|, |cells|/2, |contact|/2) + |reading| + data; NaN for responses
  /// without an estimate. The maximum covers cells and contact that cancel by chance.
  double error() const;
};

/// All estimates at one state.
struct Estimates
{
  EnergyEstimate                energy;
  std::vector<ResponseEstimate> responses;
};

/**
 * Estimate the error in the energy norm and the errors of responses. One block solve gives the
 * adjoints of all responses that need a solve. The solver leaves jumps between subdomains. If they
 * make more than a tenth of an estimated error, as near Poisson's ratio one half, the estimate
 * would measure the error of the solver. In this case the state and the adjoints are solved again
 * to smaller tolerances, as far as the solver can. Collective.
 * @param[out] solved_on the state that is estimated, if it is not @p state.
 * @throws SolveError if the adjoints cannot be solved at all.
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
