#ifndef snug_app_adaptation_h
#define snug_app_adaptation_h

#include <snug/accuracy/demand.h>
#include <snug/app/mesh_error.h>
#include <snug/io/summary.h>

#include <optional>
#include <set>

namespace snug::app {
/// A mesh that was made for targets, and the analysis of a design on this mesh.
template <int dim>
struct AdaptedProblem
{
  std::unique_ptr<ShapeProblem<dim>>                    problem;
  typename ShapeProblem<dim>::States                    states    = {};
  std::vector<std::unique_ptr<response::Response<dim>>> responses = {}; ///< of the targets
  std::vector<MeshError>          errors   = {}; ///< per load case; empty: not known
  std::vector<accuracy::Measured> measured = {}; ///< of the demands
};

/**
 * Adaptive refinement for a design. Each mesh is refined from the mesh before where its errors are
 * large, until the targets are met. The analysis on a mesh starts from the contact forces on the
 * mesh before, to a solver tolerance that follows the discretization error. Contact faces that lie
 * opposite to each other are kept at one size. The states on which the marked cells depend change
 * within the solver tolerance when the subdomains change. The subdomains therefore do not depend on
 * the number of ranks, and neither do the meshes.
 */
template <int dim>
class Adaptation
{
public:
  using States       = typename ShapeProblem<dim>::States;
  using Design       = typename ShapeProblem<dim>::Design;
  using RefinedCells = std::set<dealii::CellId>;

  /// @p context and @p scene must outlive this object and the problems that it makes.
  Adaptation(RunContext &context, const scene::Scene &scene) : context(context), scene(scene) {}

  /// Make the first mesh for @p design, or for the initial design if @p design is empty, and solve
  /// there. The first mesh is the mesh of the scene with @p cells refined. Earlier meshes and the
  /// summary are discarded. Collective. @throws InputError, SolveError.
  void start(const Design &design = {}, const RefinedCells &cells = {});

  /// Refine until errors are at most @p factor times the targets. Return why they are not; empty:
  /// they are. Collective. @throws SolveError.
  std::string reach(double factor);

  /// Refine until errors are at most the targets, and verify() where `Verify` asks for it, or by
  /// default where that is cheap. Return why the targets are not met; empty: they are. Collective.
  /// @throws SolveError.
  std::string settle();

  /// Compare with the mesh on which all cells are refined. Return why the targets are not met
  /// there; empty: they are. Collective. @throws SolveError.
  std::string verify();
  /// Return the refined cells of the mesh on which verify() missed the targets; empty if it did
  /// not.
  const RefinedCells &finer_cells() const { return finer; }

  /// Return the problem of the mesh on which the targets are met, or else of the last mesh.
  const ShapeProblem<dim> &problem() const { return *solved->problem; }
  States                  &states() { return solved->states; }
  /// Return the errors of states(), in the responses of the targets. Empty if a contact has
  /// too few faces for an estimate.
  const std::vector<MeshError> &errors() const { return solved->errors; }
  /// Return the cells that are refined beyond the scene's own refinement.
  const RefinedCells &cells() const { return refined; }

  /// Return the value of the objective and its error, which is NaN if the objective is no target.
  /// Collective.
  accuracy::Measured objective() const;

  /// Hand over the last mesh and its analysis. Its solver has the tolerance of the scene again. The
  /// next call must be start().
  AdaptedProblem<dim> release();

  io::Summary::Adaptation summary;

private:
  using Mesh  = std::unique_ptr<mesh::BodyMesh<dim>>;
  using Stage = AdaptedProblem<dim>;

  RunContext                        &context;
  const scene::Scene                &scene;
  Design                             at; ///< the design; empty: the initial design
  std::vector<accuracy::Demand>      demands;
  std::unique_ptr<mesh::Forest<dim>> forest;
  RefinedCells                       in_forest;   ///< cells refined in the forest
  RefinedCells                       refined;     ///< of the last mesh
  std::optional<RefinedCells>        first_cells; ///< refined in the first mesh of the scene
  RefinedCells                       finer;       ///< see finer_cells()
  double                             began;       ///< when the last mesh was begun [s]
  unsigned int n_doubtful = 0; ///< number of last meshes on which contact or gaps were not resolved
  std::unique_ptr<Stage> solved;
  std::unique_ptr<Stage> finer_stage; ///< mesh of finer_cells()
  bool finer_is_enough = true; ///< errors on the finer mesh of verify() are below the targets
  std::vector<std::string> unresolved; ///< gaps that are not resolved, as log lines

  static unsigned long     unknowns(const mesh::BodyMesh<dim> &mesh);
  static double            tolerance(const Stage &stage);
  const mesh::Forest<dim> &forest_with(const RefinedCells &cells);
  Mesh                     matched_mesh(RefinedCells &cells);
  Mesh                     first_mesh(const RefinedCells &cells);
  std::unique_ptr<Stage>   stage(Mesh mesh, double tolerance) const;
  void                     set_demands();
  void                     solve(Stage &stage, const std::vector<qp::WarmStart> &starts) const;
  void                     measure(Stage &stage) const;
  void                     estimate(Stage &stage) const;
  std::unique_ptr<Stage>   solve_next(Mesh mesh);
  void                     report(const Stage &stage);
  Design                   design(const Stage &stage) const;
  bool                     is_at_rest() const;
  bool                     reads_pressure() const;
  bool                     is_met(unsigned int demand) const;
  double                   least() const;
  double                   first_tolerance(const RefinedCells &cells) const;
  double                   next_tolerance() const;
  bool                     is_rough() const;
  bool                     fits(const mesh::BodyMesh<dim> &mesh) const;
  void        add(const std::vector<dealii::CellId> &marked, RefinedCells &cells) const;
  bool        add_doubtful(RefinedCells &cells);
  double      rough_part() const;
  void        resolve_data();
  bool        is_to_be_verified() const;
  void        add_marked(RefinedCells &cells) const;
  void        add_marked_beside(RefinedCells &cells);
  std::string failure();
  std::string noted();
  std::string go_on(RefinedCells &cells);
  std::string missed(const std::string &advice) const;
  std::string unbounded_at_edge();
};
} // namespace snug::app

#endif
