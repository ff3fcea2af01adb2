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
/// A simplification that a model allows, or a weakness of the model. The program only prints it.
struct Advice
{
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string kind; ///< "symmetry plane", "rigid body", ... as in doc/advice.md
  std::string text; ///< recommended change and its reason
  /// factor by which the number of unknowns, or the time of a state, decreases if the advice is
  /// followed; 1: no decrease
  double saving = 1.;
  /// relative error of energies and forces that the change introduces; for facets and locking the
  /// error of the model without the change
  double      error = unknown;
  std::string saves = "unknowns"; ///< or "time"
};

/// A model with its states in all load cases and their estimated discretization errors.
template <int dim>
struct AdviceInput
{
  const scene::Scene                          &scene;
  const state::StateSolver<dim>               &solver;
  const shape::Shapes<dim>                    &shapes;
  const std::vector<state::ContactState<dim>> &states;
  const std::vector<accuracy::EnergyEstimate> &estimates;
  double                                       target = 0.01; ///< acceptable relative error

  /// Return the maximum over all load cases of the estimated relative error in the energy norm.
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

/// Return the advice "symmetry plane" for each plane (symmetry_planes.cc). Collective.
template <int dim>
std::vector<Advice> symmetry_planes(const AdviceInput<dim> &input);

/// Return the advice "body of revolution" for at most one axis (revolution.cc). Collective.
std::vector<Advice> revolution(const AdviceInput<3> &input);

/// Return the advice "rigid body" and "unstressed region" (unstressed_regions.cc). Collective.
template <int dim>
std::vector<Advice> unstressed_regions(const AdviceInput<dim> &input);

/// Return the advice "needless friction" (friction.cc). It solves the states without friction.
/// Collective.
template <int dim>
std::vector<Advice> needless_friction(const AdviceInput<dim> &input);

/// Return all advice on a model, see doc/advice.md. Collective.
template <int dim>
std::vector<Advice> collect(const AdviceInput<dim> &input);
} // namespace snug::advice

#endif
