#ifndef snug_advice_advice_h
#define snug_advice_advice_h

#include <snug/accuracy/estimate.h>
#include <snug/scene/scene.h>
#include <snug/shape/shapes.h>
#include <snug/state/state_solver.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace snug::advice {
/// A simplification that a scene allows, or a feature that it lacks. The program only prints it.
struct Advice
{
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string kind; ///< "symmetry plane", "rigid body", ...
  std::string text; ///< what to do, and why
  /// how many times fewer unknowns, or less time of a state, the scene takes with the advice
  /// taken; 1: it is no cheaper
  double saving = 1.;
  /// relative, of energies and forces: what taking it costs, or of facets and locking what
  /// leaving it costs
  double error = unknown;
  /// "unknowns" or "time"
  std::string saves = "unknowns";
};

/// A scene as it was built, and its states in all load cases with their estimates.
template <int dim>
struct Subject
{
  const scene::Scene                          &scene;
  const state::StateSolver<dim>               &solver;
  const shape::Shapes<dim>                    &shapes;
  const std::vector<state::ContactState<dim>> &states;
  const std::vector<accuracy::EnergyEstimate> &estimates;
  double                                       target = 0.01; ///< relative error that is welcome

  /// The estimated relative error in the energy norm, of all load cases.
  double largest_error() const
  {
    double relative = 0.;
    for (const auto &estimate : estimates)
      relative = std::max(relative, estimate.relative);
    return relative;
  }

  const mesh::BodyMesh<dim> &mesh() const { return solver.mesh(); }
  const state::Model<dim>   &model() const { return solver.model(); }
};

/// @name Parts of give()
/// @{

/// "symmetry plane" and "body of revolution". Collective.
template <int dim>
std::vector<Advice> symmetries(const Subject<dim> &subject);

/// "too many subdomains" and "locking". Collective.
template <int dim>
std::vector<Advice> settings(const Subject<dim> &subject);

/// "rigid body" and "idle region". Collective.
template <int dim>
std::vector<Advice> needless_cells(const Subject<dim> &subject);

/// "mesh finer than needed", "facets" and "corner". Collective.
template <int dim>
std::vector<Advice> mesh_advice(const Subject<dim> &subject);
/// @}

/// All there is to say of a scene, see doc/advice.md. Collective.
template <int dim>
std::vector<Advice> give(const Subject<dim> &subject);
} // namespace snug::advice

#endif
