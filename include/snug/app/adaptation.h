#ifndef snug_app_adaptation_h
#define snug_app_adaptation_h

#include <snug/accuracy/demand.h>
#include <snug/app/mesh_error.h>
#include <snug/io/summary.h>

#include <set>

namespace snug::app {
/**
 * Meshes of a scene at a design, each refined where the one before has errors, until the targets
 * are met: a problem of its own for each, solved from the contact forces of the one before and only
 * as exactly as its mesh deserves. Contact faces that meet are kept at one size.
 */
template <int dim>
class Adaptation
{
public:
  using States       = typename ShapeProblem<dim>::States;
  using Design       = typename ShapeProblem<dim>::Design;
  using RefinedCells = std::set<dealii::CellId>;

  /// Makes the first mesh, that of the scene with @p cells refined, and solves at @p design, or at
  /// the start if there is none; @p context must outlive this. Collective.
  /// @throws InputError, SolveError.
  Adaptation(RunContext         &context,
             const scene::Scene &scene,
             const Design       &design = {},
             const RefinedCells &cells  = {});

  /// Refine until errors are at most @p factor times the targets.
  /// @return why they are not; empty: they are. Collective. @throws SolveError.
  std::string reach(double factor);

  /// Refine until errors are at most the targets, and verify() where `Verify` asks for it, or by
  /// default where that is cheap. @return why not; empty: they are. Collective. @throws SolveError.
  std::string settle();

  /// Compare with the mesh on which all cells are refined. @return why the targets are not met
  /// there; empty: they are. Collective. @throws SolveError.
  std::string verify();
  /// Return the refined cells of the mesh on which verify() missed the targets; empty: none missed.
  const RefinedCells &finer_cells() const { return finer; }

  /// Return the problem on the mesh that meets the targets, or else on the last mesh.
  const ShapeProblem<dim> &problem() const { return *solved->problem; }
  States                  &states() { return solved->states; }
  /// Return the errors of states() in the target responses; empty where a contact is too narrow.
  const std::vector<MeshError> &errors() const { return solved->errors; }

  /// The value of the objective and its error; none (NaN) if it is no target. Collective.
  accuracy::Measured objective();
  /// Refined beyond the scene's own.
  const RefinedCells &cells() const { return refined; }
  /// The scene with these; it is solved as exactly as the user's.
  scene::Scene adapted_scene() const;

  io::Summary::Adaptation summary;

private:
  using Mesh = std::unique_ptr<mesh::BodyMesh<dim>>;

  /// A mesh and what is solved on it.
  struct Stage
  {
    scene::Scene                       scene; ///< with its cells and its tolerance
    std::unique_ptr<ShapeProblem<dim>> problem                      = nullptr;
    States                             states                       = {};
    std::vector<std::unique_ptr<response::Response<dim>>> responses = {}; ///< of the targets
    std::vector<MeshError>          errors   = {}; ///< per load case; empty: not trusted
    std::vector<accuracy::Measured> measured = {}; ///< of the demands
  };

  RunContext                   &context;
  scene::Scene                  scene;
  Design                        at; ///< empty: the start
  std::vector<accuracy::Demand> demands;
  RefinedCells                  refined;        ///< of the last mesh
  RefinedCells                  finer;          ///< see finer_cells()
  double                        began;          ///< to make it [s]
  unsigned int                  n_doubtful = 0; ///< meshes, the last ones, see add_doubtful()
  std::unique_ptr<Stage>        solved;
  std::unique_ptr<Stage>        finer_stage;            ///< that of finer_cells()
  bool                          finer_is_enough = true; ///< by the error that verify() has found
  std::vector<std::string>      unresolved;             ///< gaps, in the words of the log

  static unsigned long   unknowns(const mesh::BodyMesh<dim> &mesh);
  static double          tolerance(const Stage &stage);
  Mesh                   matched_mesh(RefinedCells &cells);
  std::unique_ptr<Stage> stage(Mesh mesh, const RefinedCells &cells, double tolerance);
  void                   solve(Stage &stage, const std::vector<qp::WarmStart> &starts) const;
  void                   measure(Stage &stage) const;
  void                   estimate(Stage &stage) const;
  std::unique_ptr<Stage> solve_next(Mesh mesh, const RefinedCells &cells);
  void                   report(const Stage &stage);
  Design                 design(const Stage &stage) const;
  bool                   is_at_rest() const;
  bool                   reads_pressure() const;
  bool                   is_met(unsigned int demand) const;
  double                 least() const;
  double                 next_tolerance() const;
  bool                   is_rough() const;
  bool                   fits(const mesh::BodyMesh<dim> &mesh) const;
  void                   add(const std::vector<dealii::CellId> &marked, RefinedCells &cells) const;
  bool                   add_doubtful(RefinedCells &cells);
  double                 rough_part() const;
  scene::Scene           scene_with(const RefinedCells &cells) const;
  void                   resolve_data();
  bool                   is_to_be_verified() const;
  void                   add_marked(RefinedCells &cells) const;
  void                   add_marked_beside(RefinedCells &cells);
  std::string            failure();
  std::string            noted();
  std::string            go_on(RefinedCells &cells);
  std::string            missed(const std::string &advice) const;
  std::string            unbounded_at_edge();
};
} // namespace snug::app

#endif
