#ifndef snug_app_adaptation_h
#define snug_app_adaptation_h

#include <snug/accuracy/adaptation.h>
#include <snug/app/mesh_error.h>
#include <snug/io/summary.h>

#include <set>

namespace snug::app {
/**
 * Meshes of a scene, each refined where the one before has errors, until the targets are met: a
 * problem of its own for each, solved from the contact forces of the one before and only as exactly
 * as its mesh deserves. Contact faces that meet are kept at one size.
 */
template <int dim>
class Adaptation
{
public:
  using States = typename ShapeProblem<dim>::States;

  /// Makes the first mesh; @p context must outlive this. Collective. @throws InputError.
  Adaptation(RunContext &context, const scene::Scene &scene);

  /// @return why the targets are not met; empty: they are. Collective.
  /// @throws SolveError.
  std::string run();

  /// Of the mesh the targets are met on, or else the last.
  const ShapeProblem<dim> &problem() const { return *solved->problem; }
  States                  &states() { return solved->states; }
  /// Of these, in the responses of the targets; empty where a contact is too narrow.
  const std::vector<MeshError> &errors() const { return solved->errors; }

  io::Summary::Adaptation summary;

private:
  using Mesh         = std::unique_ptr<mesh::BodyMesh<dim>>;
  using RefinedCells = std::set<dealii::CellId>;

  struct Measured
  {
    double value, error;
  };

  /// A mesh and what is solved on it.
  struct Stage
  {
    scene::Scene                       scene; ///< with its cells and its tolerance
    std::unique_ptr<ShapeProblem<dim>> problem                      = nullptr;
    States                             states                       = {};
    std::vector<std::unique_ptr<response::Response<dim>>> responses = {}; ///< of the targets
    std::vector<MeshError> errors   = {}; ///< per load case; empty: not trusted
    std::vector<Measured>  measured = {}; ///< of the demands
  };

  /// A target in one load case.
  struct Demand
  {
    std::string         name;             ///< with the load case, if there are several
    unsigned int        load_case, place; ///< of the target in the entry
    accuracy::Target    target;
    bool                is_energy;
    std::vector<double> errors = {}; ///< on the last meshes that were refined for it
    std::vector<double> values = {}; ///< on the same
  };

  RunContext            &context;
  scene::Scene           scene;
  std::vector<Demand>    demands;
  RefinedCells           refined; ///< of the last mesh
  double                 began;   ///< to make it [s]
  std::unique_ptr<Stage> solved;

  Mesh                   matched_mesh(RefinedCells &cells);
  std::unique_ptr<Stage> stage(Mesh mesh, const RefinedCells &cells, double tolerance);
  void                   solve(Stage &stage, const std::vector<qp::WarmStart> &starts) const;
  void                   estimate(Stage &stage) const;
  std::unique_ptr<Stage> solve_next(Mesh mesh, const RefinedCells &cells);
  void                   report(const Stage &stage);
  bool                   is_at_rest() const;
  bool                   is_met(unsigned int demand) const;
  double                 next_tolerance() const;
  bool                   fits(const mesh::BodyMesh<dim> &mesh) const;
  void                   add(const std::vector<dealii::CellId> &marked, RefinedCells &cells) const;
  bool                   add_doubtful(RefinedCells &cells) const;
  void                   add_marked(RefinedCells &cells) const;
  std::string            failure();
  std::string            missed(const std::string &advice) const;
  std::string            verify();
};
} // namespace snug::app

#endif
