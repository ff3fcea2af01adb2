#ifndef snug_app_served_model_h
#define snug_app_served_model_h

#include <snug/app/objective.h>
#include <snug/io/answer.h>

namespace snug::app {
using io::Json;

/// This class answers the requests of a server about one model; doc/serve.md describes requests and
/// answers. All members are collective. An error leaves the object as it was.
template <int dim>
class ServedModel
{
public:
  using Design = typename ShapeProblem<dim>::Design;

  /// Make the problem of @p scene. The cells of @p earlier are used again if its entries of meshes
  /// are equal. @throws InputError naming the file, also if the scene has targets of the accuracy,
  /// and SolveError if a limit is relative to a first design without a state.
  ServedModel(RunContext &context, const scene::Scene &scene, const ServedModel *earlier = nullptr);

  /// Return whether the cells are those of the earlier model.
  bool keeps_mesh() const { return has_earlier_mesh; }

  /// Return variables, limits, load cases, responses, objective, constraints and sizes.
  Json describe() const;

  /// Return the values, and what else is requested, of a design. @throws RequestError, TangledMesh,
  /// SolveError.
  Json evaluate(const Json &request);

  /// Write the files of a run that analyses a design, and those of its shape, and return their
  /// names. @throws the same errors, and InputError if the output directory cannot be written to.
  Json write(const Json &request);

  /// Search contact anew at a design. @throws the same errors.
  Json pair(const Json &request);

private:
  using States = typename ShapeProblem<dim>::States;

  Design                                                design(const Json &request) const;
  const States                                         &analyse(const Design &design, bool is_cold);
  std::vector<typename Objective<dim>::ConstraintValue> constraints() const;
  std::vector<unsigned int>                             wanted_gradients(const Json &request) const;
  /// Return the values of all outputs, the objective and the constraints.
  Json values(const States &states) const;
  void add_gradients(const Design                    &design,
                     const std::vector<unsigned int> &wanted,
                     bool                             all,
                     Json                            &answer);
  /// Add the estimated discretization errors of all outputs that have an estimate.
  void add_errors(const States &states, Json &answer);

  RunContext                                           &context;
  scene::Scene                                          scene;
  std::vector<std::string>                              meshes; ///< text of the mesh entries
  std::shared_ptr<const mesh::Forest<dim>>              forest;
  bool                                                  has_earlier_mesh = false;
  std::unique_ptr<ShapeProblem<dim>>                    problem;
  std::unique_ptr<Analyses<dim>>                        analyses;
  std::unique_ptr<Objective<dim>>                       objective;
  Design                                                paired;
  bool                                                  last_is_cold = false;
  std::vector<std::string>                              names; ///< of the responses
  std::vector<std::unique_ptr<response::Response<dim>>> responses;
  /// the responses of one load case after the other, and their names in answers
  sensitivity::MeasuredResponses<dim> outputs;
  std::vector<std::string>            output_names;
};
} // namespace snug::app

#endif
