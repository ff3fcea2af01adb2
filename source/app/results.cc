#include <snug/accuracy/targets.h>
#include <snug/app/mesh_checks.h>
#include <snug/app/model_report.h>
#include <snug/app/offsets.h>
#include <snug/app/results.h>
#include <snug/contact/pair_geometry.h>
#include <snug/io/mesh_export.h>
#include <snug/io/qp_export.h>
#include <snug/io/text_file.h>
#include <snug/state/symmetry_planes.h>
#include <snug/state/validity_checks.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace snug::app {
template <int dim>
Results<dim>::Results(const ShapeProblem<dim> &of) : problem(&of)
{
  summary.task  = to_text(of.scene.task);
  summary.units = io::summarize_units(of.scene);
  std::vector<std::string> body_names;
  for (const auto &body : of.scene.bodies)
    body_names.push_back(body.name);
  for (unsigned int c = 0; c < of.n_load_cases(); ++c)
    {
      const std::string directory = of.n_load_cases() == 1
                                      ? problem->scene.output_directory
                                      : path(problem->scene.load_cases[c].name);
      pictures.push_back({io::FieldOutput<dim>(directory, problem->scene.output, body_names),
                          io::ContactOutput<dim>(directory, problem->scene.output, body_names)});
    }
}

template <int dim>
void Results<dim>::print_header()
{
  auto      &out       = problem->context.out();
  const auto mesh_rows = counted_rows();
  out << counted(problem->scene.bodies.size(), "body", "bodies") << ", "
      << counted(problem->mesh->n_global_cells(), "cell") << ", "
      << counted(dim * problem->mesh->n_global_free_nodes(), "unknown") << ", "
      << counted(problem->tearing.n_global, "subdomain") << ", "
      << counted(mesh_rows.contact, "contact condition") << ", "
      << counted(mesh_rows.all, "constraint") << " in all, "
      << counted(problem->shapes->n_variables(), "design variable") << ", "
      << counted(problem->context.n_ranks(), "MPI process", "MPI processes") << std::endl;
  print_notes(problem->scene, out);
  print_pairs(*problem);
  auto &context = problem->context;
  context.warn("mesh file", import_warnings(problem->scene));
  context.warn("refinement", refinement_warnings(problem->scene, *problem->mesh));
  context.warn("offset", offset_warnings(*problem));
  warn_of_model(*problem);
}

template <int dim>
void Results<dim>::print_work() const
{
  unsigned long f_mults = 0;
  for (const auto &mesh : summary.accuracy->meshes)
    f_mults += mesh.f_mults;
  problem->context.out(Verbosity::quiet)
    << (summary.accuracy->met ? "targets met" : "targets not met") << ": "
    << counted(summary.accuracy->meshes.size(), "mesh", "meshes") << ", "
    << counted(f_mults, "F-mult") << std::endl;
  auto &out = problem->context.out(Verbosity::debug);
  out << "time of each stage [s]:";
  for (const auto *stage :
       {"setup", "assembly", "factorization", "soft modes", "solve", "accuracy"})
    out << ' ' << stage << ' ' << problem->context.seconds(stage);
  out << std::endl;
}

template <int dim>
void Results<dim>::warn(const States &states)
{
  for (const auto &state : states)
    {
      for (const auto &warning : state::warnings(state.validity))
        problem->context.warn(warning);
      problem->context.warn("free body", state.free_bodies);
    }
  if (std::all_of(states.begin(), states.end(), state::is_at_rest<dim>))
    problem->context.warn(
      {"no load", "all displacements are zero: no load case has a force, pressure, moment, "
                  "weight, prescribed displacement or overlap"});
}

template <int dim>
void Results<dim>::warn_of_weak_contacts(const States &states, const std::string &more)
{
  unsigned int weak_contacts = 0;
  for (const auto &state : states)
    weak_contacts += state.weak_contacts;
  problem->context.warn(
    {"weak contact",
     counted(weak_contacts, "contact is", "contacts are") +
       " weakly active (neither force nor gap, or about to slip): functions of the displacement "
       "have only one-sided derivatives" +
       more,
     double(weak_contacts), 0.});
}

template <int dim>
std::vector<std::pair<std::string, double>>
Results<dim>::response_values(const state::ContactState<dim> &state) const
{
  std::vector<std::pair<std::string, double>> result;
  for (unsigned int i = 0; i < problem->responses.size(); ++i)
    result.emplace_back(problem->scene.responses[i].name,
                        problem->responses[i]->value(*problem->solver, state));
  return result;
}

/// Export the quadratic program of the first load case.
template <int dim>
void Results<dim>::export_first_qp(const States &states)
{
  if (!problem->scene.output.export_qp)
    return;
  const auto &state  = states.front();
  auto       &solver = *problem->solver;
  solver.restore(state); // may factorize, which has a stage of its own
  const auto             &feti = solver.feti(state);
  const RunContext::Timer timer(problem->context, "output");
  io::export_qp(path("qp"), feti, solver.gluing(0).layout(), state.u, state.dual.lambda);
}

template <int dim>
void Results<dim>::add_first(const States &states, const std::optional<Field> &shape_gradient)
{
  export_first_qp(states);
  draw(0., states, shape_gradient);
  // The states become invalid with a new contact search.
  for (const auto &state : states)
    first_states.push_back(io::summarize(state, response_values(state)));
}

/// Return and print the estimated errors of @p states. If they cannot be estimated, warn and return
/// none, because the states are results all the same. Collective.
template <int dim>
std::vector<MeshError> Results<dim>::estimate(const States &states)
{
  try
    {
      auto errors = mesh_errors(*problem, states, problem->scene.accuracy.estimate);
      for (const std::string &line : described(*problem, states, errors))
        problem->context.out(Verbosity::quiet) << line << std::endl;
      return errors;
    }
  catch (const SolveError &error)
    {
      problem->context.warn(
        {"no estimate", std::string("no estimate of the discretization error: ") + error.what()});
      return {};
    }
}

template <int dim>
void Results<dim>::add_last(const double                  time,
                            const States                 &states,
                            const std::optional<Field>   &shape_gradient,
                            const std::vector<MeshError> &known)
{
  if (first_states.empty())
    export_first_qp(states);
  last_errors        = known.empty() ? estimate(states) : known;
  const auto &errors = last_errors;
  draw(time, states, shape_gradient, errors);
  export_meshes(states.front());
  not_valid.clear();
  for (const auto &state : states)
    if (not_valid.empty())
      not_valid = state::why_not_valid(state.validity);
  // A new contact search may follow before the summary is written.
  count_rows();
  const auto summarized = [&](const unsigned int c) {
    std::optional<io::Summary::Accuracy> accuracy;
    if (const auto *of_case = find_errors(errors, c))
      {
        accuracy = {of_case->energy.error, of_case->energy.relative, {}};
        for (const auto &[name, of_response] : of_case->responses)
          accuracy->responses.emplace_back(name, of_response.error());
      }
    return io::summarize(states[c], response_values(states[c]), accuracy);
  };
  summary.state = summarized(0);
  if (!first_states.empty())
    summary.initial_state = first_states.front();
  if (states.size() == 1)
    return;
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      io::Summary::LoadCase load_case;
      load_case.name   = problem->scene.load_cases[c].name;
      load_case.weight = problem->scene.load_cases[c].weight;
      load_case.state  = summarized(c);
      if (!first_states.empty())
        load_case.initial_state = first_states[c];
      summary.load_cases.push_back(load_case);
    }
}

template <int dim>
void Results<dim>::advise(const States &states)
{
  const RunContext::Timer               timer(problem->context, "advice");
  std::vector<accuracy::EnergyEstimate> estimates;
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      const auto *known = find_errors(last_errors, c);
      estimates.push_back(known ? known->energy
                                : accuracy::estimate_energy(*problem->solver, states[c]));
    }
  advice::AdviceInput<dim> input{problem->scene, *problem->solver, *problem->shapes, states,
                                 estimates};
  double                   smallest = std::numeric_limits<double>::infinity();
  for (const auto &[response, text] : problem->scene.accuracy.targets)
    if (const auto target = accuracy::read_target(text); target.relative)
      smallest = std::min(smallest, target.value);
  if (std::isfinite(smallest))
    input.target = smallest;
  summary.advice = advice::collect(input);
  auto &out      = problem->context.out(Verbosity::quiet);
  for (const auto &item : *summary.advice)
    {
      out << "advice, " << item.kind << ": " << item.text;
      if (item.saving > 1.)
        out << "; " << item.saving << " times "
            << (item.saves == "time" ? "less time" : "fewer unknowns");
      if (item.error >= 0.)
        out << "; error " << 100. * item.error << " %";
      out << std::endl;
    }
  if (summary.advice->empty())
    out << "advice: none" << std::endl;
}

/// Return the numbers of rows. Rows of gluing and supports, which all positions share, count once.
template <int dim>
typename Results<dim>::RowCounts Results<dim>::counted_rows() const
{
  RowCounts rows;
  for (const unsigned int c : problem->solver->positions())
    {
      const auto &gluing = problem->solver->gluing(c);
      rows.contact += gluing.n_contact_rows();
      rows.all += c == 0 ? gluing.n_rows() : gluing.n_contact_rows();
    }
  return rows;
}

template <int dim>
void Results<dim>::count_rows()
{
  summary.mesh                  = io::summarize(*problem->mesh, problem->tearing);
  const auto rows               = counted_rows();
  summary.mesh.constraints      = rows.all;
  summary.mesh.contact_rows     = rows.contact;
  summary.mesh.clusters         = problem->solver->n_clusters();
  summary.mesh.rigid_body_modes = problem->solver->n_kernel();
}

template <int dim>
void Results<dim>::write_summary()
{
  auto &context    = problem->context;
  summary.program  = io::program_info(context);
  summary.work     = context.total_work();
  summary.times    = io::collect_times(context);
  summary.memory   = io::collect_memory(context);
  summary.warnings = context.warnings();
  if (context.n_ranks() > 1)
    {
      summary.balance = io::collect_balance(context, *problem->mesh, problem->tearing,
                                            problem->solver->gluing(0).layout());
      if (const auto note = io::balance_note(*summary.balance); !note.empty())
        context.out() << note << std::endl;
    }
  throw_collectively(context.communicator(), [&]() {
    if (context.rank() == 0)
      {
        summary.write(path("summary.json"));
        if (!summary.load_cases.empty())
          io::write_text_file(path("load_cases.csv"), summary.load_case_table());
      }
  });
}

template <int dim>
std::string Results<dim>::failure_reason(const std::string &reason) const
{
  if (!reason.empty() || not_valid.empty() || problem->scene.accept_large_displacements)
    return reason;
  return "the result is not valid: " + not_valid +
         ", but small displacements are assumed; 'Accept large displacements' = true accepts it";
}

template class Results<2>;
template class Results<3>;
} // namespace snug::app
