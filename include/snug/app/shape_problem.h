#ifndef snug_app_shape_problem_h
#define snug_app_shape_problem_h

#include <snug/app/build_model.h>
#include <snug/optimization/combination.h>
#include <snug/sensitivity/combined_gradients.h>
#include <snug/shape/shapes.h>

#include <memory>

namespace snug::app {
/**
 * This class represents the shape problem of a scene, whatever its task: elastic bodies in
 * contact, in all load cases, whose shape depends on a design, and the
 * responses of these bodies. It writes no files.
 */
template <int dim>
class ShapeProblem
{
public:
  using Field  = typename mesh::BodyMesh<dim>::Field;
  using Design = std::vector<double>;
  /// States of one design in all load cases.
  using States = std::vector<state::ContactState<dim>>;

  /// Make the subdomains, the shapes, the solver and the responses on @p mesh. Contact is searched
  /// at the start design. Collective. @throws InputError naming the file.
  ShapeProblem(RunContext                          &context,
               const scene::Scene                  &scene,
               std::unique_ptr<mesh::BodyMesh<dim>> mesh);

  /// Check the initial overlaps of all pairs. Their limit is relative to the face size; therefore
  /// only the mesh that the user gave is checked, and no finer meshes.
  /// @throws InputError, see state::check_overlaps().
  void check_overlaps() const;

  /// Return the node positions of a design. Collective.
  Field positions(const Design &design) const { return shape::positions(*mesh, *shapes, design); }

  unsigned int n_load_cases() const { return solver->model().load_cases.size(); }

  /// Return the states of a design in all load cases, each solved from its start in @p starts.
  /// Without starts, a load case starts from an earlier load case, see StateSolver::scaled_start(),
  /// or cold. Collective. @throws SolveError.
  States solve(const Design &design, const std::vector<qp::WarmStart> &starts = {});

  /// Return the names of reported_values(): the objective and the responses of the scene by their
  /// names, after the name of the load case and a dot if there are several load cases.
  std::vector<std::string> value_names() const;

  /// Return the values of the objective and of the responses in each load case. Collective.
  std::vector<double> reported_values(const States &states) const;

  /// Return the weight of a load case.
  double weight(unsigned int load_case) const;

  /// Return the objective, combined of its values in @p states. Collective.
  optimization::Combined combined_objective(const States &states) const;

  /// Return the response called @p name. Collective. @throws InputError if the
  /// scene has nothing that the response could measure.
  std::unique_ptr<response::Response<dim>> make_response(const std::string &name) const;

  /// Return the argument of combined_gradients() for @p states. All arguments must outlive the
  /// result.
  sensitivity::LoadCases<dim> load_cases(const States                          &states,
                                         const Design                          &design,
                                         const sensitivity::GradientParameters &parameters) const;

  /// Return the maximum distance, in faces, by which a design has moved slave nodes away from the
  /// points that they are paired with. Collective.
  double drift(const Design &design) const;

  RunContext                              &context;
  const scene::Scene                      &scene;
  std::unique_ptr<mesh::BodyMesh<dim>>     mesh;
  mesh::Tearing                            tearing;
  std::unique_ptr<shape::Shapes<dim>>      shapes;
  std::unique_ptr<state::StateSolver<dim>> solver;
  std::unique_ptr<response::Response<dim>> objective;
  /// those of the scene, in its order
  std::vector<std::unique_ptr<response::Response<dim>>> responses;
};
} // namespace snug::app

#endif
