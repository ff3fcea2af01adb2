#include <snug/accuracy/surface_residual.h>
#include <snug/accuracy/transfer.h>
#include <snug/accuracy/underresolved_contact.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>
#include <snug/contact/joined_pairs.h>
#include <snug/contact/matching.h>
#include <snug/mesh/refined_cells.h>
#include <snug/state/validity_checks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>

namespace snug::app {
/// Cells are chosen by what the states before tell, which subdomains change by as much as the
/// tolerance: the same subdomains on any ranks make the same meshes.
template <int dim>
Adaptation<dim>::Adaptation(RunContext         &context,
                            const scene::Scene &of_user,
                            const Design       &design,
                            const RefinedCells &cells)
  : context(context), scene(of_user), at(design), refined(cells)
{
  scene.tearing.at_least_ranks = false;
  const auto &targets          = scene.accuracy.targets;
  double      tolerance        = accuracy::first_tolerance;
  // cells that were refined for the targets have errors of their size
  if (!cells.empty())
    for (const auto &target : targets)
      tolerance =
        std::min(tolerance, accuracy::step_tolerance(accuracy::read_target(target.second).value,
                                                     false, least()));
  resolve_data();
  // in two steps: the first adds to the cells
  auto mesh = matched_mesh(refined);
  solved    = stage(std::move(mesh), refined, tolerance);
  if (cells.empty())
    solved->problem->check_overlaps();
  for (unsigned int j = 0; j < targets.size(); ++j)
    for (unsigned int c = 0; c < solved->problem->n_load_cases(); ++c)
      demands.push_back(
        {(scene.load_cases.size() > 1 ? scene.load_cases[c].name + "." : "") + targets[j].first, c,
         j, accuracy::read_target(targets[j].second),
         solved->problem->make_response(targets[j].first)->stationary(),
         solved->problem->make_response(targets[j].first)->reads_pressure()});
  solve(*solved, {});
}

template <int dim>
typename Adaptation<dim>::Design Adaptation<dim>::design(const Stage &stage) const
{
  return at.empty() ? stage.problem->shapes->start() : at;
}

template <int dim>
scene::Scene Adaptation<dim>::adapted_scene() const
{
  auto result            = solved->scene;
  result.state_tolerance = scene.state_tolerance;
  return result;
}

template <int dim>
scene::Scene Adaptation<dim>::scene_with(const RefinedCells &cells) const
{
  auto       result = scene;
  const auto given  = std::make_shared<const RefinedCells>(cells);
  for (auto &body : result.bodies)
    body.mesh.refined = given;
  return result;
}

template <int dim>
accuracy::Measured Adaptation<dim>::objective()
{
  const auto combined = solved->problem->combined_objective(solved->states);
  return {combined.value, objective_error(scene, combined.factors, solved->errors)};
}

/// As many as faces that meet may be levels apart at first, or nearly so. Where the cells of two
/// bodies do not end together, each pass moves a change of size on by a face, and on the other body
/// then as well: without a limit to the end of the side.
constexpr unsigned int most_passes = 8;

/// The mesh of the scene with @p cells refined, and with those added that are coarser than what
/// they meet. Collective.
template <int dim>
typename Adaptation<dim>::Mesh Adaptation<dim>::matched_mesh(RefinedCells &cells)
{
  began = context.seconds();
  const RunContext::Timer timer(context, "setup");
  for (unsigned int pass = 0;; ++pass)
    {
      const auto                  given = cells;
      const auto                  with  = scene_with(cells);
      auto                        mesh  = build_mesh<dim>(with, context.communicator());
      const auto                  pairs = build_model(with, *mesh).pairs;
      const mesh::Surface<dim>    surface(*mesh, contact::boundaries_of(pairs));
      const faces::FaceShape<dim> shape(mesh->degree());
      for (const auto &joined :
           contact::join_pairs(surface, shape, pairs, surface.reference_positions()))
        add(mesh::gather_cells(*mesh, surface.cells_of(
                                        contact::coarse_faces(surface, shape, joined.pair,
                                                              surface.reference_positions()))),
            cells);
      if (cells == given || pass == most_passes)
        {
          cells = given;
          return mesh;
        }
    }
}

template <int dim>
std::unique_ptr<typename Adaptation<dim>::Stage>
Adaptation<dim>::stage(Mesh mesh, const RefinedCells &cells, const double tolerance)
{
  auto result                   = std::make_unique<Stage>(Stage{scene_with(cells)});
  result->scene.state_tolerance = tolerance;
  result->problem = std::make_unique<ShapeProblem<dim>>(context, result->scene, std::move(mesh));
  if (!at.empty())
    result->problem->solver->pair(result->problem->positions(at));
  return result;
}

/// States and the values of the targets. Collective.
template <int dim>
void Adaptation<dim>::solve(Stage &stage, const std::vector<qp::WarmStart> &starts) const
{
  auto &problem = *stage.problem;
  context.progress("solving the contact problem ...");
  stage.states = problem.solve(design(stage), starts);
  for (const auto &target : scene.accuracy.targets)
    stage.responses.push_back(problem.make_response(target.first));
  measure(stage);
}

/// The values of the targets, without errors. Collective.
template <int dim>
void Adaptation<dim>::measure(Stage &stage) const
{
  stage.measured.clear();
  for (const auto &demand : demands)
    stage.measured.push_back(
      {stage.responses[demand.place]->value(*stage.problem->solver, stage.states[demand.load_case]),
       std::numeric_limits<double>::infinity()});
}

/// The errors of a mesh on which they have a meaning; states that are not solved well enough for
/// it are solved on. Collective.
template <int dim>
void Adaptation<dim>::estimate(Stage &stage) const
{
  const RunContext::Timer                      timer(context, "accuracy");
  const auto                                  &targets = scene.accuracy.targets;
  std::vector<const response::Response<dim> *> responses;
  for (const auto &response : stage.responses)
    responses.push_back(response.get());
  stage.errors.clear();
  for (auto &state : stage.states)
    {
      std::optional<state::ContactState<dim>> solved_on;
      auto estimates = accuracy::estimate(*stage.problem->solver, state, responses,
                                          scene.gradient.solves, solved_on);
      if (solved_on)
        state = std::move(*solved_on);
      MeshError error{std::move(estimates.energy), {}};
      for (unsigned int j = 0; j < targets.size(); ++j)
        error.responses.emplace_back(targets[j].first, std::move(estimates.responses[j]));
      stage.errors.push_back(std::move(error));
    }
  measure(stage);
  for (unsigned int d = 0; d < demands.size(); ++d)
    stage.measured[d].error =
      stage.errors[demands[d].load_case].responses[demands[d].place].second.error();
}

/// Another mesh, solved from the states of the last. Collective.
template <int dim>
std::unique_ptr<typename Adaptation<dim>::Stage>
Adaptation<dim>::solve_next(Mesh mesh, const RefinedCells &cells)
{
  auto                       next = stage(std::move(mesh), cells, next_tolerance());
  std::vector<qp::WarmStart> starts;
  for (const auto &state : solved->states)
    starts.push_back(accuracy::transferred(*solved->problem->solver, state, *next->problem->solver,
                                           next->problem->positions(design(*next))));
  try
    {
      solve(*next, starts);
    }
  catch (const SolveError &)
    {
      solve(*next, {}); // the forces of a coarse mesh may lead astray
    }
  return next;
}

/// Without loads there is rounding, of which nothing can be estimated.
template <int dim>
bool Adaptation<dim>::is_at_rest() const
{
  return std::all_of(solved->states.begin(), solved->states.end(), state::is_at_rest<dim>);
}

template <int dim>
bool Adaptation<dim>::is_met(const unsigned int demand) const
{
  const auto &estimate = solved->measured[demand];
  return is_at_rest() || estimate.error <= demands[demand].allowed(estimate);
}

/// The user's.
template <int dim>
double Adaptation<dim>::least() const
{
  return scene.state_tolerance.value_or(qp::SolverParameters().relative_tolerance);
}

template <int dim>
double Adaptation<dim>::next_tolerance() const
{
  double tolerance = std::max(least(), accuracy::first_tolerance);
  for (unsigned int d = 0; d < demands.size(); ++d)
    tolerance = std::min(tolerance, demands[d].tolerance(solved->measured[d], least()));
  return tolerance;
}

/// That of all states.
template <int dim>
double Adaptation<dim>::tolerance(const Stage &stage)
{
  double largest = 0.;
  for (const auto &state : stage.states)
    largest = std::max(largest, state.tolerance);
  return largest;
}

/// The states are known less well than the errors, as where the first mesh is better than needed.
template <int dim>
bool Adaptation<dim>::is_rough() const
{
  return tolerance(*solved) > 10. * next_tolerance();
}

template <int dim>
bool Adaptation<dim>::fits(const mesh::BodyMesh<dim> &mesh) const
{
  return unknowns(mesh) <= scene.accuracy.maximum_unknowns;
}

template <int dim>
std::string Adaptation<dim>::reach(const double factor)
{
  for (auto &demand : demands)
    demand.factor = factor;
  while (true)
    {
      RefinedCells cells    = refined;
      const bool   doubtful = !is_at_rest() && add_doubtful(cells);
      n_doubtful            = doubtful ? n_doubtful + 1 : 0;
      std::string why;
      if (!doubtful)
        {
          estimate(*solved);
          why = failure();
        }
      else
        for (unsigned int d = 0; d < demands.size(); ++d)
          demands[d].pass(solved->measured[d].value);
      report(*solved);
      if (!why.empty())
        return why;
      if (!doubtful)
        {
          add_marked(cells);
          summary.met = true;
          for (unsigned int d = 0; d < demands.size(); ++d)
            summary.met = summary.met && is_met(d);
          if (summary.met && !is_rough())
            {
              for (const auto &line : unresolved)
                context.out() << "warning: " << line << std::endl;
              return "";
            }
        }
      else if (n_doubtful > 1)
        add_marked_beside(cells);
      if (cells == refined && !is_rough())
        return missed("allow more 'Maximum levels', or ask for less");
      why = go_on(cells);
      if (!why.empty())
        return missed(why);
    }
}

/// To the mesh of @p cells. @return why there is none; empty: it is solved. Collective.
template <int dim>
std::string Adaptation<dim>::go_on(RefinedCells &cells)
{
  try
    {
      auto mesh = matched_mesh(cells);
      if (!fits(*mesh))
        return "the next mesh has " + std::to_string(unknowns(*mesh)) +
               " unknowns: allow more 'Maximum unknowns', or ask for less";
      // The mesh that is solved from goes only when the next one is solved.
      auto next = solve_next(std::move(mesh), cells);
      solved    = std::move(next);
      refined   = cells;
      return "";
    }
  // The scene is right, as the meshes before were solved.
  catch (const InputError &error)
    {
      return std::string("the next mesh cannot be solved: ") + error.what();
    }
  catch (const SolveError &error)
    {
      return std::string("the next mesh cannot be solved: ") + error.what();
    }
}

template class Adaptation<2>;
template class Adaptation<3>;
} // namespace snug::app
