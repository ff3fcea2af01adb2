#include <snug/app/build_model.h>
#include <snug/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <random/checks.h>
#include <random/dense_algebra.h>
#include <random/whole_bodies.h>

#include <algorithm>
#include <cmath>

namespace snug::test {
namespace {
/// Tolerance of forces, displacements, gaps and energies. States are solved to 1e-9.
const double agreement = 1e-6;

/// Result of Snug for a scene.
template <int dim>
struct Answer
{
  std::string refusal; ///< empty: solved
  Vector      u, forces;
  double      energy = 0.;
  bool        moves  = false; ///< bodies are free to
};

/// By the unknowns and rows of @p whole. Collective.
template <int dim>
void order(const WholeBodies<dim>         &whole,
           const state::StateSolver<dim>  &solver,
           const state::ContactState<dim> &state,
           Answer<dim>                    &answer)
{
  const auto         &mesh = solver.mesh();
  const auto         &x    = mesh.reference_positions();
  const unsigned int  n    = whole.problem.f.size();
  std::vector<double> sums(2 * n, 0.); // values and how many ranks gave one
  for (const auto &cell : mesh.cells())
    for (const unsigned int node : cell.nodes)
      {
        const auto first =
          whole.unknown_of_node.find(WholeBodies<dim>::key(mesh.body_of_node(node), x[node]));
        // hanging nodes have no unknowns
        for (unsigned int d = 0; d < dim && first != whole.unknown_of_node.end(); ++d)
          {
            sums[first->second + d]     = state.displacement[node][d];
            sums[n + first->second + d] = 1.;
          }
      }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), int(sums.size()), MPI_DOUBLE, MPI_SUM,
                mesh.communicator());
  answer.u.reinit(n);
  for (unsigned int i = 0; i < n; ++i)
    answer.u(i) = sums[i] / sums[n + i];
  answer.forces.reinit(whole.problem.contact.size());
  const auto surface = solver.surface().gather(x);
  for (unsigned int i = 0; i < state.contact.size(); ++i)
    {
      const auto &place = solver.contact(0).places()[i];
      const auto  row =
        whole.row_of_slave.find(WholeBodies<dim>::key(place.pair, surface[place.slave]));
      // rows that supports hold entirely have no force
      if (row != whole.row_of_slave.end())
        answer.forces(row->second) = state.contact[i].force;
    }
  answer.energy = state.energy;
  answer.moves  = !state.free_bodies.empty();
}

template <int dim>
Answer<dim>
answer_of(const scene::Scene &scene, const WholeBodies<dim> &whole, unsigned long &f_mults)
{
  std::ostringstream      log;
  RunContext              context(MPI_COMM_WORLD, log);
  const auto              mesh    = app::build_mesh<dim>(scene, MPI_COMM_WORLD);
  const auto              tearing = mesh::tear(*mesh, scene.tearing.cluster_edge);
  state::StateSolver<dim> solver(*mesh, tearing, app::build_model(scene, *mesh),
                                 mesh->reference_positions(), context);
  Answer<dim>             answer;
  try
    {
      const auto state = solver.solve(mesh->reference_positions(), qp::WarmStart());
      f_mults          = state.f_mults;
      order(whole, solver, state, answer);
    }
  catch (const SolveError &error)
    {
      answer.refusal = error.what();
    }
  return answer;
}

/// Return whether the message names a body that may move.
bool names_escape(const std::string &message, const scene::Scene &scene, const Verdict &verdict)
{
  for (unsigned int b = 0; b < scene.bodies.size(); ++b)
    if (message.find("no equilibrium: body " + scene.bodies[b].name +
                     " is not held against its load") == 0)
      return verdict.may_move[b];
  return false;
}

/// Fills in the errors; what is wrong, if anything.
std::string compare(const DenseProblem  &problem,
                    const DenseSolution &dense,
                    const Vector        &u,
                    const Vector        &forces,
                    Outcome             &outcome)
{
  Vector nodal(problem.f.size()), difference = u;
  double deepest = 0., pulling = 0.;
  for (unsigned int i = 0; i < problem.contact.size(); ++i)
    {
      add(forces(i), problem.contact[i], nodal);
      deepest = std::max(deepest, times(problem.contact[i], u) - problem.contact[i].bound);
      pulling = std::max(pulling, -forces(i));
      if (dense.is_unique)
        outcome.force_error =
          std::max(outcome.force_error, std::abs(forces(i) - dense.forces(i)) / dense.force);
    }
  nodal -= dense.nodal;
  outcome.force_error =
    dense.force > 0. ? std::max(outcome.force_error, nodal.linfty_norm() / dense.force) : 0.;
  difference -= dense.u;
  if (dense.length > 0.)
    outcome.displacement_error = without(dense.free, difference).linfty_norm() / dense.length;
  if (outcome.force_error > agreement)
    return "forces differ";
  if (outcome.displacement_error > agreement)
    return "displacements differ";
  if (deepest > agreement * dense.length)
    return "penetrates";
  if (pulling > agreement * dense.force)
    return "pulls";
  return "";
}

template <int dim>
Outcome check(const scene::Scene &scene)
{
  Outcome                outcome;
  const WholeBodies<dim> whole(scene);
  DenseOracle            oracle(whole.problem);
  const auto             verdict = oracle.verdict();
  const auto             answer  = answer_of<dim>(scene, whole, outcome.f_mults);
  const auto             end     = [&outcome](Outcome::Kind kind, const std::string &message) {
    outcome.kind    = kind;
    outcome.message = message;
    return outcome;
  };
  if (verdict.kind == Verdict::undecided)
    return end(Outcome::undecided, "rate of escape " + std::to_string(verdict.rate));
  if (verdict.kind == Verdict::escape)
    return names_escape(answer.refusal, scene, verdict)
             ? end(Outcome::refused, "")
             : end(Outcome::wrong,
                   "no equilibrium, but: " + (answer.refusal.empty() ? "solved" : answer.refusal));
  if (!answer.refusal.empty())
    return end(Outcome::wrong, "there is an equilibrium, but: " + answer.refusal);
  DenseSolution dense;
  try
    {
      dense = oracle.solve();
    }
  catch (const std::exception &error)
    {
      return end(Outcome::undecided, error.what());
    }
  auto message = compare(whole.problem, dense, answer.u, answer.forces, outcome);
  // both energies are those of the bodies where they were put, free or not
  if (message.empty() &&
      std::abs(answer.energy - dense.energy) > agreement * dense.force * dense.length)
    message = "energies differ";
  if (message.empty() && answer.moves != (dense.free.n() > 0) &&
      (dense.free_is_sure || verdict.kind == Verdict::neutral))
    message = answer.moves ? "free to move, but held" : "held, but free to move";
  if (!message.empty())
    return end(Outcome::wrong, message);
  return end(answer.moves ? Outcome::neutral : Outcome::solved, "");
}
} // namespace

Outcome check_scene(const std::string &name, const std::string &text)
{
  try
    {
      const auto scene = scene::read_scene({name, text, {}, ""});
      return scene.dimension == 2 ? check<2>(scene) : check<3>(scene);
    }
  catch (const InputError &error)
    {
      Outcome outcome;
      outcome.message = error.what();
      return outcome;
    }
}
} // namespace snug::test
