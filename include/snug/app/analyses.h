#ifndef snug_app_analyses_h
#define snug_app_analyses_h

#include <snug/app/shape_problem.h>
#include <snug/app/warm_start_extrapolation.h>

#include <optional>
#include <string>

namespace snug::app {
/// This struct holds the states of a design in all load cases, and gradients there.
template <int dim>
struct Analysis
{
  typename ShapeProblem<dim>::Design design;
  typename ShapeProblem<dim>::States states;
  /// of `measured` responses in load cases; empty until Analyses::gradients() computes them
  sensitivity::Gradients<dim>         gradients = {};
  sensitivity::MeasuredResponses<dim> measured  = {};
};

/**
 * This class analyses the designs of a shape problem, and keeps the last analysis. The solver
 * starts from forces extrapolated from earlier designs, which changes values within the tolerance
 * of the solver only. All members are collective, except for last().
 */
template <int dim>
class Analyses
{
public:
  using Design = typename ShapeProblem<dim>::Design;
  using States = typename ShapeProblem<dim>::States;

  /// @p problem must outlive this object.
  explicit Analyses(ShapeProblem<dim> &problem);

  /// Solve a design, and keep its forces as a start for later ones. With @p is_cold the result does
  /// not depend on earlier designs, bit for bit. After an error the last analysis is that before.
  /// @throws TangledMesh, SolveError.
  Analysis<dim> &solve(const Design &design, bool is_cold = false);

  /// Return the analysis of @p design, which is solved unless it is the last one. It is valid until
  /// another design is analysed or contact is searched. @throws TangledMesh, SolveError.
  Analysis<dim> &at(const Design &design);

  /// Return the gradients of @p measured responses at @p design. Calls with the same design and
  /// responses as the last call return the gradients of that call, also with other parameters.
  /// Afterwards the solver is at the geometry of its states.
  const sensitivity::Gradients<dim> &gradients(const Design                              &design,
                                               const sensitivity::MeasuredResponses<dim> &measured,
                                               const sensitivity::GradientParameters &parameters);

  /// Return the last analysis if it is that of @p design, else null, as during the replay of a
  /// journal.
  const Analysis<dim> *last(const Design &design) const
  {
    return current && current->design == design ? &*current : nullptr;
  }

  /// Return the states of the first design. If they are not known, they are solved without starts,
  /// see ShapeProblem::solve(). The last contact search must have been at the first design.
  const States &first_states();

  /// Run a new contact search at @p design, after which earlier states are invalid.
  void pair(const Design &design);

  /// Let the solver at designs near @p design start from forces of each load case, n_owned x 1.
  void start_from(const Design &design, const std::vector<qp::MultiVector> &forces)
  {
    starts.add(design, forces);
  }

  /// Return the forces of earlier designs as bytes, from which remember() restores them bit for
  /// bit; it returns false, without any forces, if the bytes are not those of this problem.
  std::string memory() const { return starts.bytes(); }
  bool        remember(const std::string &bytes);

private:
  ShapeProblem<dim>           &problem;
  WarmStartExtrapolation       starts;
  States                       of_first;
  std::optional<Analysis<dim>> current;
};
} // namespace snug::app

#endif
