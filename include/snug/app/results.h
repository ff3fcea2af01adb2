#ifndef snug_app_results_h
#define snug_app_results_h

#include <snug/app/mesh_error.h>
#include <snug/io/contact_output.h>
#include <snug/io/fields.h>
#include <snug/io/output_directory.h>
#include <snug/io/summary.h>

namespace snug::app {
template <int dim>
class DesignedFace;

/**
 * This class writes the results of a run to the output directory and to the log: pictures, the
 * summary, the final shape and warnings. It reads a shape problem and does not change it.
 */
template <int dim>
class Results
{
public:
  using Field  = typename ShapeProblem<dim>::Field;
  using States = typename ShapeProblem<dim>::States;

  explicit Results(const ShapeProblem<dim> &problem);

  /// Set the problem of all following results: the same scene on another mesh.
  void watch(const ShapeProblem<dim> &other)
  {
    problem = &other;
    node_numbers.reset();
  }

  /// Print the sizes of the problem, its contact pairs, and warnings about the input. Collective.
  void print_header();

  /// Print the numbers of meshes and F-mults that were needed for the targets, and the times.
  void print_work() const;

  /// Warn where the model is doubtful at @p states.
  void warn(const States &states);

  /// Warn where derivatives at @p states are one-sided; @p more ends the line.
  void warn_of_weak_contacts(const States &states, const std::string &more = "");

  /// Draw a design, unless its time is positive and that of the last picture. Collective.
  void draw(double                        time,
            const States                 &states,
            const std::optional<Field>   &shape_gradient,
            const std::vector<MeshError> &errors = {});

  /// Draw and summarize the first of several designs, with the shape
  /// gradient (this rank's share) if there is one. Collective.
  void add_first(const States &states, const std::optional<Field> &shape_gradient);

  /// Return the summarized states of the first design. They are empty before add_first().
  const std::vector<io::Summary::State> &first() const { return first_states; }

  /// Draw and summarize the last design, or the only one, with its shape gradient and the errors of
  /// its mesh. The errors are estimated if @p errors is empty. Collective.
  void add_last(double                        time,
                const States                 &states,
                const std::optional<Field>   &shape_gradient = {},
                const std::vector<MeshError> &errors         = {});

  /// Return the discretization errors of all load cases, as estimated or given to add_last().
  const std::vector<MeshError> &errors() const { return last_errors; }

  /// Print the advice on the scene with these states, and add it to the summary. Collective.
  void advise(const States &states);

  /// Write the shaped faces and the control points of a design, if the scene has design variables.
  /// Collective.
  void export_shape(const std::vector<double> &design);

  /// Return the name and the value of each response of the scene. Collective.
  std::vector<std::pair<std::string, double>>
  response_values(const state::ContactState<dim> &state) const;

  /// Fill in program, mesh, work and times and write summary.json.
  /// Collective.
  void write_summary();

  /// Return what is wrong with the result: @p reason, or, if it is empty, that large displacements
  /// make the states of add_last() wrong and the scene does not accept them; empty: nothing.
  std::string failure_reason(const std::string &reason) const;

  /// Return the path of the file @p name in the output directory.
  std::string path(const std::string &name) const
  {
    return problem->scene.output_directory + "/" + name;
  }

  io::Summary summary; ///< its task, gradient and optimization are the task's

private:
  /// This struct holds numbers of rows in all positions of the bodies.
  struct RowCounts
  {
    unsigned int contact = 0, all = 0;
  };

  RowCounts counted_rows() const;
  /// Set the sizes of the mesh, the numbers of rows and the kernel dimension in the summary.
  void                   count_rows();
  void                   export_first_qp(const States &states);
  std::vector<MeshError> estimate(const States &states);
  /// Write the shaped faces as a STEP file. For one rank.
  void export_profile(const std::vector<DesignedFace<dim>> &designed);
  /// Write the solid of each body from a CAD file with its shaped faces as a STEP file, or a
  /// warning with the reason why there is no valid one. For one rank.
  void export_solids(const std::vector<DesignedFace<dim>> &designed);
  /// Print the faces of the STEP file in the summary, and warnings after them.
  void report_profile(std::vector<std::string> lines);
  /// Write the 'Meshes' of the scene at the positions of @p state. Collective.
  void export_meshes(const state::ContactState<dim> &state);

  /// Return WholeMesh::number_of of the mesh. Collective.
  const std::vector<unsigned int> &numbers_of_nodes();

  /// This struct holds the writers of one load case.
  struct Pictures
  {
    io::FieldOutput<dim>   fields;
    io::ContactOutput<dim> contact;
  };

  const ShapeProblem<dim> *problem;
  std::vector<Pictures>    pictures;   ///< per load case
  double                   drawn = 0.; ///< the time drawn last
  std::string              not_valid;  ///< why the states of add_last() are not valid, or empty
  std::vector<io::Summary::State> first_states; ///< per load case
  std::vector<MeshError>          last_errors;  ///< of add_last()
  /// numbers_of_nodes() of the mesh of the problem, after the first call
  std::optional<std::vector<unsigned int>> node_numbers;
};
} // namespace snug::app

#endif
