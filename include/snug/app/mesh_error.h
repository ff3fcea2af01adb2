#ifndef snug_app_mesh_error_h
#define snug_app_mesh_error_h

#include <snug/accuracy/estimate.h>
#include <snug/app/shape_problem.h>

namespace snug::app {
/// This struct holds the estimated discretization errors of one state.
struct MeshError
{
  unsigned int                                                    load_case;
  accuracy::EnergyEstimate                                        energy;
  std::vector<std::pair<std::string, accuracy::ResponseEstimate>> responses; ///< by name
};

/// Return the estimated errors that @p asked, such as `Accuracy/Estimate` of the scene, requests;
/// empty: none requested. Errors in the energy norm alone are estimated for the load case with the
/// largest strain energy, errors of responses for all load cases. Collective. @throws SolveError.
template <int dim>
std::vector<MeshError> mesh_errors(const ShapeProblem<dim>                  &problem,
                                   const typename ShapeProblem<dim>::States &states,
                                   accuracy::Estimate                        asked);

/// Return the errors of a load case, or null if they are not estimated.
const MeshError *find_errors(const std::vector<MeshError> &errors, unsigned int load_case);

/// Return the error of the objective of load cases combined with @p factors; NaN: not estimated.
double objective_error(const scene::Scene           &scene,
                       const std::vector<double>    &factors,
                       const std::vector<MeshError> &errors);

/// Return @p errors as lines of the log, relative to the values of @p states where these are not 0.
template <int dim>
std::vector<std::string> described(const ShapeProblem<dim>                  &problem,
                                   const typename ShapeProblem<dim>::States &states,
                                   const std::vector<MeshError>             &errors);
} // namespace snug::app

#endif
