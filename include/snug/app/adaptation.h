#ifndef snug_app_adaptation_h
#define snug_app_adaptation_h

#include <snug/accuracy/demand.h>
#include <snug/app/adaptive_meshes.h>
#include <snug/app/mesh_error.h>
#include <snug/io/summary.h>

#include <optional>

namespace snug::app {
/// This struct holds a mesh that was made for targets, and the analysis of a design on this mesh.
template <int dim>
struct AdaptedProblem
{
  std::unique_ptr<ShapeProblem<dim>>                    problem;
  typename ShapeProblem<dim>::States                    states    = {};
  std::vector<std::unique_ptr<response::Response<dim>>> responses = {}; ///< of the targets
  std::vector<MeshError>          errors   = {}; ///< per load case; empty: not known
  std::vector<accuracy::Measured> measured = {}; ///< per Demand
};

/**
 * This class refines meshes adaptively for a design. Each mesh is refined from the mesh before
 * where its errors are large, until the targets are met: bodies of CAD files are meshed anew, and
 * the cells of other bodies are divided. A target in one load case is a Demand
 * (accuracy/demand.h). The analysis on a mesh starts from the contact forces on the mesh before, to
 * a solver tolerance that follows the discretization error. Contact faces that lie opposite to each
 * other are kept at one size. Marked cells depend on states, and states depend within the solver
 * tolerance on the subdomains. Subdomains, and so meshes, are therefore the same on any number of
 * ranks up to the number of subdomains of `Subdomains = auto`.
 *
 * Members that choose cells are defined in adaptation_marking.cc, those that compare with a finer
 * mesh in adaptation_verification.cc, those that report results and failures in
 * adaptation_report.cc, and all others in adaptation.cc.
 */
template <int dim>
class Adaptation
{
public:
  using States = typename ShapeProblem<dim>::States;
  using Design = typename ShapeProblem<dim>::Design;

  /// Keep a reference to @p context and a copy of @p scene. @p context and this object must outlive
  /// the problems that it makes.
  Adaptation(RunContext &context, const scene::Scene &scene)
    : context(context), meshes(context, scene), scene(meshes.scene())
  {}

  /// Make the first mesh for @p design, or for the initial design if @p design is empty, and solve
  /// there. The first mesh is the mesh of the scene with @p refinement. Earlier problems and
  /// the summary are discarded; the forest is kept. Collective. @throws InputError, SolveError.
  void start(const Design &design = {}, const Refinement &refinement = {});

  /// Refine until errors are at most @p factor times the targets. Return why they are not; empty:
  /// they are. Collective. @throws SolveError.
  std::string reach(double factor);

  /// Refine until errors are at most the targets, and verify() where `Verify` asks for it, or by
  /// default where that is cheap. Return why the targets are not met; empty: they are. Collective.
  /// @throws SolveError.
  std::string reach_and_verify();

  /// Compare with the mesh on which all cells are refined, whatever `Verify` says. Return why the
  /// targets are not met there; empty: they are, or the analysis on that mesh failed and `Verify`
  /// is not true. Collective. @throws SolveError.
  std::string verify();
  /// Return the refinement of the mesh on which verify() last missed the targets since start();
  /// empty if it never did.
  const Refinement &finer_refinement() const { return finer; }

  /// Return the problem of the mesh on which the targets are met, or else of the last mesh.
  const ShapeProblem<dim> &problem() const { return *solved->problem; }
  States                  &states() { return solved->states; }
  /// Return the errors of states(), in the responses of the targets. Empty if a contact has
  /// too few faces for an estimate.
  const std::vector<MeshError> &errors() const { return solved->errors; }
  /// Return the refinement of the last mesh.
  const Refinement &refinement() const { return last_refinement; }

  /// Return the value of the objective and its error, which is NaN if the objective is no target.
  /// Collective.
  accuracy::Measured objective() const;

  /// Hand over the last mesh and its analysis. Its solver has the tolerance of the scene again. The
  /// next call must be start().
  AdaptedProblem<dim> release();

  io::Summary::Adaptation summary;

private:
  using Mesh    = std::unique_ptr<mesh::BodyMesh<dim>>;
  using Adapted = AdaptedProblem<dim>;

  RunContext                   &context;
  AdaptiveMeshes<dim>           meshes;
  const scene::Scene           &scene;        ///< that of the meshes
  Design                        given_design; ///< empty: the initial design
  std::vector<accuracy::Demand> demands;
  Refinement                    last_refinement; ///< of the last mesh
  Refinement                    finer;           ///< see finer_refinement()
  /// number of successive meshes, up to the last one, on which contact or gaps were not resolved
  unsigned int             n_underresolved = 0;
  std::unique_ptr<Adapted> solved;
  std::unique_ptr<Adapted> finer_problem; ///< on the mesh of finer_refinement()
  bool finer_is_enough = true; ///< errors on the finer mesh of verify() are below the targets
  std::vector<std::string> unresolved_gaps; ///< gaps that are not resolved, as log lines

  static double            tolerance(const Adapted &adapted);
  std::unique_ptr<Adapted> make_problem(Mesh mesh, double tolerance) const;
  void                     set_demands();
  void                     solve(Adapted &adapted, const std::vector<qp::WarmStart> &starts) const;
  void                     measure(Adapted &adapted) const;
  void                     estimate(Adapted &adapted) const;
  std::unique_ptr<Adapted> solve_next(Mesh mesh);
  void                     report(const Adapted &adapted);
  Design                   design(const Adapted &adapted) const;
  bool                     is_at_rest() const;
  bool                     reads_pressure() const;
  bool                     is_met(unsigned int demand) const;
  double                   minimum_tolerance() const;
  double                   first_tolerance(const Refinement &refinement) const;
  double                   next_tolerance() const;
  bool                     is_solver_too_inexact() const;
  bool                     add_underresolved(Refinement &to);
  double                   allowed_roughness() const;
  bool                     is_to_be_verified() const;
  void                     add_marked(Refinement &to) const;
  void                     add_marked_despite_narrow_contact(Refinement &to);
  std::string              failure_reason();
  std::string              record_errors();
  std::string              solve_on();
  std::string              solve_refined(Refinement &next);
  std::string              missed_targets(const std::string &advice) const;
  std::string              unbounded_at_edge();
};
} // namespace snug::app

#endif
