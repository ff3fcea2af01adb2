#include <snug/app/interrupt.h>
#include <snug/app/optimize.h>
#include <snug/scene/read_scene.h>

#include <ostream>

namespace snug::app {
template <int dim>
Optimize<dim>::Optimize(Workshop<dim> &workshop, bool restart)
  : workshop(workshop)
  , restart(restart)
  , history(workshop.path("history.csv"), workshop.basis->n_variables())
{
  choose_constraints();
  // its scale is that of the first design, whatever a journal replays
  if (workshop.scene.optimization.combine == "worst" && workshop.n_load_cases() > 1)
    {
      if (first.empty())
        first = workshop.solve(workshop.basis->start());
      workshop.combined_objective(first);
    }
}

template <int dim>
void Optimize<dim>::choose_constraints()
{
  for (const auto &[name, limit] : workshop.scene.optimization.constraints)
    constraints.push_back(make_constraint(name, limit));
}

template <int dim>
typename Optimize<dim>::Constraint Optimize<dim>::make_constraint(const std::string &name,
                                                                  const std::string &limit)
{
  const auto of    = scene::constraint_name(workshop.scene, name);
  const auto bound = optimization::read_limit(limit);
  Constraint constraint{name, workshop.make_response(of.response), of.load_case.value_or(0),
                        bound.value, bound.side};
  if (!bound.of_initial)
    return constraint;
  state::ContactState<dim> geometry;
  geometry.positions  = workshop.positions(workshop.basis->start());
  const bool of_state = constraint.response->needs_solution();
  if (of_state && first.empty())
    first = workshop.solve(workshop.basis->start());
  constraint.target *=
    constraint.response->value(*workshop.solver, of_state ? first[constraint.load_case] : geometry);
  return constraint;
}

template <int dim>
optimization::Evaluation Optimize<dim>::evaluate(const Design &design)
{
  if (paired_anew)
    warm_starts.clear();
  workshop.context.progress("solving the contact problem ...");
  last        = workshop.solve(design, warm_starts);
  last_design = design;
  warm_starts.clear();
  for (const auto &state : last)
    warm_starts.push_back({state.dual.lambda, state.dual.active});
  // after a replay the search goes on elsewhere
  const bool is_start = design == workshop.basis->start() && !paired_anew;
  if (is_start)
    first = last;

  optimization::Evaluation                      evaluation;
  std::vector<typename Workshop<dim>::Measured> responses;
  evaluation.objective = workshop.combined_objective(last).value;
  for (const Constraint &constraint : constraints)
    {
      const auto &state = last[constraint.load_case];
      evaluation.constraints.push_back(
        constraint.sign() *
        (constraint.response->value(*workshop.solver, state) - constraint.target));
      responses.push_back({constraint.response.get(), constraint.load_case});
    }
  auto parameters = workshop.scene.gradient;
  if (parameters.method == "energy") // not for every constraint
    parameters.method = "auto";
  last_gradients           = workshop.gradients(last, responses, design, parameters);
  const auto &of_objective = last_gradients.of_response.front();
  evaluation.gradient      = of_objective.values;
  if (is_start)
    {
      first_shape_gradient = of_objective.shape;
      if (!of_objective.reason.empty())
        workshop.context.out() << "auto takes " << of_objective.method
                               << " for the objective: " << of_objective.reason << std::endl;
    }
  note_weak_contacts();
  for (unsigned int i = 0; i < responses.size(); ++i)
    {
      evaluation.jacobian.push_back(last_gradients.of_response[1 + i].values);
      for (double &entry : evaluation.jacobian.back())
        entry *= constraints[i].sign();
    }
  double active = 0., f_mults = last_gradients.f_mults;
  for (const auto &state : last)
    {
      active += state.active_contacts;
      f_mults += state.f_mults;
    }
  evaluation.notes = {active, f_mults, workshop.context.seconds(),
                      last.front().least_scaled_jacobian};
  return evaluation;
}

template <int dim>
void Optimize<dim>::note_weak_contacts()
{
  unsigned int weak_contacts = 0;
  for (const auto &state : last)
    weak_contacts += state.weak_contacts;
  for (const auto &gradient : last_gradients.of_response)
    if (!gradient.differentiable)
      workshop.warn(
        {one_sided_warning(weak_contacts) + "; going on with those of the strongly active ones"});
}

template <int dim>
void Optimize<dim>::report(const optimization::Iteration &iteration)
{
  io::HistoryLine line;
  line.iteration            = iterations_done + iteration.number;
  line.objective            = iteration.evaluation.objective;
  line.constraint_violation = iteration.constraint_violation;
  line.projected_gradient   = iteration.projected_gradient;
  line.active_contacts      = iteration.evaluation.notes[0];
  line.f_mults              = iteration.evaluation.notes[1];
  line.seconds              = iteration.evaluation.notes[2];
  line.scaled_jacobian      = iteration.evaluation.notes[3];
  line.design               = iteration.x;
  if (line.iteration == 0)
    workshop.context.out() << io::log_header() << std::endl;
  workshop.context.out() << io::log_line(line) << std::endl;
  everywhere(workshop.context.communicator(), [&]() {
    if (workshop.context.rank() == 0)
      history.add(line);
  });
  // a replay solves nothing that could be drawn
  const unsigned int every = workshop.scene.optimization.draw_every;
  if (every > 0 && line.iteration > 0 && line.iteration % every == 0 && last_design == iteration.x)
    draw_last(line.iteration);
}

template <int dim>
void Optimize<dim>::open_journal()
{
  auto settings            = journal_settings();
  settings.save_warm_start = [this](unsigned int, const std::string &path) {
    save_warm_start(path);
  };
  settings.load_warm_start = [this](unsigned int, const std::string &path) {
    load_warm_start(path);
  };
  journal = std::make_unique<optimization::Journal>(settings, [this](const Design &x) {
    check_interrupts(workshop.context.communicator());
    return evaluate(x);
  });
}

/// One run of the optimizer; counts and the first objective go on from
/// those of @p before.
template <int dim>
optimization::OptimizationResult
Optimize<dim>::search(const Design &start, const optimization::OptimizationResult &before)
{
  optimization::DesignProblem problem;
  problem.lower    = workshop.basis->lower_bounds();
  problem.upper    = workshop.basis->upper_bounds();
  problem.start    = start;
  problem.evaluate = [this](const Design &x) {
    auto evaluation = journal->evaluate(x);
    paired_anew     = false;
    return evaluation;
  };
  for (const Constraint &constraint : constraints)
    {
      problem.constraint_scales.push_back(constraint.target == 0. ? 1.
                                                                  : std::abs(constraint.target));
      problem.relations.push_back(constraint.side == optimization::Limit::Side::equal
                                    ? optimization::Relation::equal
                                    : optimization::Relation::at_most);
    }
  optimization::Hooks hooks;
  hooks.on_iteration = [this](const optimization::Iteration &iteration) { report(iteration); };
  hooks.log = [this](const std::string &line) { workshop.context.out() << line << std::endl; };
  auto parameters = workshop.scene.optimization;
  parameters.maximum_evaluations -= before.evaluations;
  auto result = optimization::minimize(problem, parameters, hooks);
  result.iterations += before.iterations;
  result.evaluations += before.evaluations;
  if (before.evaluations > 0)
    result.objective_initial = before.objective_initial;
  return result;
}

/// Draw and summarize the first design with its own pairing, once. After a
/// replay it has not been solved in this run.
template <int dim>
void Optimize<dim>::draw_first()
{
  if (!first_summaries.empty())
    return;
  if (first.empty())
    first = workshop.solve(workshop.basis->start());
  workshop.draw(0., first, first_shape_gradient);
  // a pairing anew ends what else there is to know of them
  for (const auto &state : first)
    first_summaries.push_back(workshop.summarize(state));
}

/// Draw the design that was evaluated last, unless its picture is there.
template <int dim>
void Optimize<dim>::draw_last(const unsigned int iteration)
{
  draw_first();
  if (iteration == 0 || iteration > drawn)
    workshop.draw(iteration, last, last_gradients.of_response.front().shape);
  drawn = iteration;
}

/// Pair contact at @p design. @return false if slave nodes are where they
/// were paired.
template <int dim>
bool Optimize<dim>::pair_anew(const Design &design)
{
  const double unmoved = 1e-3;
  const double drift   = workshop.drift(design);
  if (drift < unmoved)
    return false;
  draw_first();
  workshop.context.out() << "contact is paired anew: the design moved slave nodes off the "
                            "points they were paired with by up to "
                         << drift << " of a face" << std::endl;
  workshop.solver->pair(workshop.positions(design));
  last.clear();
  paired_anew = true;
  return true;
}

template <int dim>
std::string Optimize<dim>::run()
{
  open_journal();
  auto result = search(workshop.basis->start(), {});
  for (unsigned int round = 0;
       round < workshop.scene.contact.update_pairing && result.success &&
       result.evaluations < workshop.scene.optimization.maximum_evaluations && pair_anew(result.x);
       ++round)
    {
      iterations_done = result.iterations;
      result          = search(result.x, result);
    }
  finish(result);
  return optimization::complaint(result, workshop.scene.optimization);
}

template <int dim>
void Optimize<dim>::finish(const optimization::OptimizationResult &result)
{
  draw_first();
  // the last one evaluated may be another, or all were replayed
  if (last.empty() || last_design != result.x)
    evaluate(result.x);
  const auto &of_objective = last_gradients.of_response.front();
  draw_last(result.iterations);
  workshop.export_shape(result.x);

  io::Summary summary;
  summary.task = "optimize";
  for (auto &state : last)
    {
      if (workshop.scene.report_linear_reference)
        state.linear_f_mults = workshop.solver->linear_f_mults(state);
      workshop.warn(state);
    }
  workshop.summarize_states(first_summaries, last, summary);
  io::Summary::Gradient gradient;
  gradient.method         = of_objective.method;
  gradient.reason         = of_objective.reason;
  gradient.differentiable = of_objective.differentiable;
  gradient.f_mults        = last_gradients.f_mults;
  gradient.seconds        = last_gradients.seconds;
  gradient.values         = result.evaluation.gradient;
  summary.gradient        = gradient;
  summary.optimization    = io::summarize(result, workshop.scene.optimization.algorithm);
  workshop.write_summary(summary);
  workshop.context.out() << "stopped: " << result.stop_reason << " after " << result.iterations
                         << " iterations and " << result.evaluations << " evaluations\n"
                         << workshop.scene.optimization.objective << ' ' << result.objective_initial
                         << " -> " << result.objective_final;
  for (unsigned int c = 0; c < last.size(); ++c)
    workshop.context.out() << (last.size() == 1
                                 ? std::string()
                                 : ", load case " + workshop.scene.load_cases[c].name)
                           << ", peak pressure " << first[c].max_pressure << " -> "
                           << last[c].max_pressure << ", active contacts "
                           << first[c].active_contacts << " -> " << last[c].active_contacts;
  workshop.context.out() << std::endl;
}

template class Optimize<2>;
template class Optimize<3>;
} // namespace snug::app
