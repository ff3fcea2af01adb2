#ifndef snug_app_workshop_h
#define snug_app_workshop_h

#include <snug/app/build_model.h>
#include <snug/io/contact_output.h>
#include <snug/io/fields.h>
#include <snug/io/summary.h>
#include <snug/optimization/combination.h>
#include <snug/sensitivity/gradient.h>
#include <snug/sensitivity/one_sided.h>
#include <snug/shape/shapes.h>

#include <memory>

namespace snug::app {
/// "3 contacts are weakly active: ..." for the log and the summary.
std::string one_sided_warning(unsigned int weak_contacts);

/**
 * What every task of a scene works with: mesh, tearing, shape basis,
 * state solver and the writers of results.
 */
template <int dim>
class Workshop
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// Makes all but the mesh and leaves no files. Collective.
  /// @throws InputError naming the file.
  Workshop(RunContext                          &context,
           const scene::Scene                  &scene,
           std::unique_ptr<mesh::BodyMesh<dim>> mesh);

  /// Node positions of a design.
  Field positions(const std::vector<double> &design) const;

  unsigned int n_load_cases() const;

  /// The states of a design in all load cases, each from its start; no
  /// starts: cold. Collective. @throws SolveError.
  std::vector<state::ContactState<dim>> solve(const std::vector<double>        &design,
                                              const std::vector<qp::WarmStart> &starts = {});

  /// The objective, combined of its values in the states of all load
  /// cases. The scale of 'worst' is that of the first states combined.
  /// Collective.
  optimization::Combined combined_objective(const std::vector<state::ContactState<dim>> &states);

  /// The response called @p name. Collective. @throws InputError if the
  /// scene has nothing it could measure.
  std::unique_ptr<response::Response<dim>> make_response(const std::string &name) const;

  /// A response besides the objective.
  struct Measured
  {
    const response::Response<dim> *response;
    unsigned int                   load_case; ///< it is measured in
  };

  /// The gradient of the objective, combined over the states of all load
  /// cases, and after it those of @p others. Collective.
  sensitivity::Gradients<dim> gradients(const std::vector<state::ContactState<dim>> &states,
                                        const std::vector<Measured>                 &others,
                                        const std::vector<double>                   &design,
                                        const sensitivity::GradientParameters       &parameters);

  /// One-sided derivatives of the objective, combined like gradients().
  /// Collective.
  sensitivity::OneSided one_sided_gradients(const std::vector<state::ContactState<dim>> &states,
                                            const std::vector<double>                   &design);

  /// Add the states of all load cases to the pictures, with the shape
  /// gradient (this rank's share) if there is one. Collective.
  void draw(double                                       time,
            const std::vector<state::ContactState<dim>> &states,
            const std::optional<Field>                  &shape_gradient = {});

  /// Print what was read. Collective.
  void print_header();

  /// Warn where the model is doubtful at a state: print a line, and keep
  /// it for the summary, once.
  void warn(const state::ContactState<dim> &state);

  /// The same for any lines.
  void warn(const std::vector<std::string> &lines);

  /// How far a design moved slave nodes off the points they are paired
  /// with, in faces. Collective.
  double drift(const std::vector<double> &design) const;

  /// Fill in program, mesh, work and times and write summary.json.
  /// Collective.
  void write_summary(io::Summary &summary);

  /// The optimized surface and the control points. Collective.
  void export_shape(const std::vector<double> &design);

  /// Name and value of each response of the scene. Collective.
  std::vector<std::pair<std::string, double>>
  response_values(const state::ContactState<dim> &state) const;

  /// A state and the values of the scene's responses. Collective.
  io::Summary::State summarize(const state::ContactState<dim> &state) const;

  /// The states of all load cases in a summary: the first one as its
  /// state, all of them if there are several. @p initial, those of the
  /// first design, may be empty. Collective.
  void summarize_states(const std::vector<io::Summary::State>       &initial,
                        const std::vector<state::ContactState<dim>> &states,
                        io::Summary                                 &summary) const;

  /// File @p name of the output directory.
  std::string path(const std::string &name) const;

  RunContext                              &context;
  const scene::Scene                      &scene;
  std::unique_ptr<mesh::BodyMesh<dim>>     mesh;
  mesh::Tearing                            tearing;
  std::unique_ptr<shape::Shapes<dim>>      basis;
  std::unique_ptr<state::StateSolver<dim>> solver;
  std::unique_ptr<response::Response<dim>> objective;
  /// those of the scene, in its order
  std::vector<std::unique_ptr<response::Response<dim>>> responses;

private:
  std::vector<double> bound_widths() const;

  std::vector<std::string> warnings;

  /// Writers of one load case.
  struct Pictures
  {
    std::unique_ptr<io::FieldOutput<dim>>   fields;
    std::unique_ptr<io::ContactOutput<dim>> contact;
  };

  void add_pictures(const std::string &directory);

  std::vector<Pictures> pictures;             ///< per load case
  double                objective_scale = 0.; ///< 0: not known yet
};
} // namespace snug::app

#endif
