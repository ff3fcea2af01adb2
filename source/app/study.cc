#include <snug/advice/cost.h>
#include <snug/app/adaptation.h>
#include <snug/app/interrupt.h>
#include <snug/app/inventory.h>
#include <snug/app/optimize.h>
#include <snug/app/sensitivity.h>
#include <snug/app/study.h>
#include <snug/base/errors.h>
#include <snug/base/petsc_options.h>
#include <snug/feti/sparse_factor.h>
#include <snug/io/summary.h>
#include <snug/io/text_file.h>
#include <snug/scene/read_scene.h>
#include <snug/state/symmetry_planes.h>

#include <petscblaslapack.h>

#include <cmath>
#include <iostream>
#include <new>
#include <sstream>

namespace snug::app {
namespace {
/// States on the way to targets are solved no better than the error of their mesh asks for.
template <int dim>
void print_certificate(std::ostream &out, const state::ContactState<dim> &state)
{
  const auto &errors = state.certificate;
  out << "certificate";
  if (state.tolerance > qp::SolverParameters().relative_tolerance)
    out << " of a solution to the relative tolerance " << state.tolerance << " only";
  out << ": equilibrium " << errors.equilibrium << ", continuity " << errors.continuity
      << ", penetration " << errors.penetration << ", negative pressure "
      << errors.negative_pressure << ", complementarity " << errors.complementarity << std::endl;
}

/// In the plane only the last component.
template <int dim>
std::string moment_text(const dealii::Tensor<1, 3> &moment)
{
  std::ostringstream text;
  if (dim == 2)
    text << moment[2];
  else
    text << moment;
  return text.str();
}

template <int dim>
void print_state(std::ostream &out, const state::ContactState<dim> &state)
{
  out << "least scaled Jacobian of a cell " << state.least_scaled_jacobian << "\nenergy "
      << state.energy << ", compliance " << state.compliance << ", strain energy "
      << state.strain_energy << "\ncontact force (" << state.contact_force << "), area "
      << state.contact_area << ", peak pressure " << state.max_pressure << ", "
      << state.active_contacts << " active and " << state.weak_contacts << " weakly active of "
      << state.contact.size() << " contact rows, distance to degeneracy "
      << state.degeneracy_distance << '\n';
  for (const auto &pair : state.pairs)
    out << "  on " << pair.name << ": force (" << pair.force << "), moment ("
        << moment_text<dim>(pair.moment) << ") about (" << pair.centre << "), area "
        << pair.contact_area << ", peak pressure " << pair.max_pressure << " at (" << pair.peak
        << ") on faces of " << pair.peak_size << ", " << pair.active_contacts << " active of "
        << pair.rows << " rows\n";
  for (const auto &reaction : state.reactions)
    out << "  support " << reaction.name << ": force (" << reaction.force << "), moment ("
        << moment_text<dim>(reaction.moment) << ") about (" << reaction.centre << ")\n";
  out << "loads (" << state.load << "), with supports and obstacles (" << state.balance << ")\n";
  out << state.dual.method << ": " << state.dual.outer_iterations << " outer iterations, "
      << state.f_mults << " F-mults\n";
  print_certificate(out, state);
}

template <int dim>
void report(const ShapeProblem<dim>            &problem,
            Results<dim>                       &results,
            typename ShapeProblem<dim>::States &states)
{
  auto &out = problem.context.out();
  for (auto &state : states)
    {
      if (problem.scene.report_linear_reference)
        state.linear_f_mults = problem.solver->linear_f_mults(state);
      if (states.size() > 1)
        out << "load case " << problem.scene.load_cases[state.load_case].name << ": ";
      print_state(out, state);
      for (const auto &[name, value] : results.response_values(state))
        out << name << ' ' << value << std::endl;
    }
  results.warn(states);
}

template <int dim>
typename ShapeProblem<dim>::States solve_start(ShapeProblem<dim> &problem, Results<dim> &results)
{
  problem.context.progress("solving the contact problem ...");
  auto states = problem.solve(problem.shapes->start());
  report(problem, results, states);
  return states;
}

template <int dim>
void run_state(ShapeProblem<dim> &problem, Results<dim> &results, const bool advise)
{
  const auto states = solve_start(problem, results);
  results.add_last(0., states);
  if (advise)
    results.advise(states);
  results.write_summary();
}

template <int dim>
void run_sensitivity(ShapeProblem<dim> &problem, Results<dim> &results)
{
  const auto             states = solve_start(problem, results);
  const Sensitivity<dim> sensitivity(problem, results, states);
  results.add_last(0., states, sensitivity.shape_gradient);
  results.summary.gradient = sensitivity.gradient;
  results.write_summary();
}

/// That of the scene and, if there are several, those of load cases.
std::vector<std::string> output_directories(const scene::Scene &scene)
{
  std::vector<std::string> directories = {scene.output_directory};
  if (scene.load_cases.size() > 1)
    for (const auto &load_case : scene.load_cases)
      directories.push_back(scene.output_directory + "/" + load_case.name);
  return directories;
}

void prepare_output(const RunContext &context, const scene::Scene &scene)
{
  for (const auto &directory : output_directories(scene))
    io::make_output_directory(context, directory);
  everywhere(context.communicator(), [&]() {
    std::ostringstream text;
    scene::print(scene, text);
    if (context.rank() == 0)
      io::write_text_file(scene.output_directory + "/parameters.prm", text.str());
  });
}

/// Print the estimated cost of a run with @p mesh on @p ranks ranks. Collective.
template <int dim>
void print_estimate(RunContext                &context,
                    const scene::Scene        &scene,
                    const mesh::BodyMesh<dim> &mesh,
                    const unsigned int         ranks,
                    const bool                 stages)
{
  const auto counts = advice::count(scene, mesh);
  everywhere(context.communicator(), [&]() {
    if (context.rank() == 0)
      made_of(scene, [&]() {
        print(advice::estimate_cost(scene, counts, ranks, advice::machine_speed()), stages,
              context.out());
      });
  });
}

template <int dim>
void estimate_in(RunContext &context, const scene::Scene &scene, const unsigned int ranks)
{
  const auto mesh = timed_mesh<dim>(context, scene);
  print_estimate(context, scene, *mesh, ranks > 0 ? ranks : context.n_ranks(), true);
}

template <int dim>
void validate_in(RunContext &context, const scene::Scene &scene)
{
  auto mesh = timed_mesh<dim>(context, scene);
  print_estimate(context, scene, *mesh, context.n_ranks(), false);
  print_import_notes(scene, context.out());
  print(take_inventory(scene, *mesh), context.out());
  for (const auto &line : unrefined(scene, *mesh))
    context.out() << "warning: " << line << '\n';
  const ShapeProblem<dim> problem(context, scene, std::move(mesh));
  for (const auto &line : state::symmetry_warnings(*problem.mesh, problem.solver->model().supports,
                                                   problem.solver->contact().pairs()))
    context.out() << "warning: " << line << '\n';
  problem.check_overlaps();
  const auto positions = problem.positions(problem.shapes->start());
  // Formulas of loads may have no value where only some ranks look.
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    made_of(scene, [&]() {
      everywhere(context.communicator(), [&]() { problem.solver->loads(positions, c); });
    });
}

void print_program(RunContext &context)
{
  const auto info = io::program_info(context);
  context.out() << "Snug " << info.version << ", deal.II " << info.dealii << ", PETSc "
                << info.petsc << ", BLAS " << info.blas << std::endl;
  if (!io::blas_warning(info).empty())
    context.out() << "warning: " << io::blas_warning(info) << std::endl;
}

/// A state on the mesh that its targets ask for. @return why they are not met; empty: they are.
template <int dim>
std::string run_adapted(RunContext &context, const scene::Scene &scene)
{
  Adaptation<dim> adaptation(context, scene);
  io::remove_results(context, output_directories(scene));
  const auto   complaint = adaptation.settle();
  Results<dim> results(adaptation.problem());
  results.summary.task     = to_text(scene.task);
  results.summary.accuracy = adaptation.summary;
  results.print_work();
  results.print_header();
  report(adaptation.problem(), results, adaptation.states());
  // responses that are no targets are estimated if all are asked for
  results.add_last(0., adaptation.states(), {},
                   scene.accuracy.estimate == accuracy::Estimate::responses
                     ? std::vector<MeshError>()
                     : adaptation.errors());
  results.write_summary();
  return complaint;
}

/// A design on the meshes that its targets ask for.
template <int dim>
std::string run_adapted_search(RunContext &context, const scene::Scene &scene, const bool restart)
{
  if (!restart)
    io::remove_results(context, output_directories(scene));
  return optimize_to_targets<dim>(context, scene, restart);
}

template <int dim>
std::string run_given(RunContext &context, const scene::Scene &scene, const Options &options)
{
  auto mesh = timed_mesh<dim>(context, scene);
  print_estimate(context, scene, *mesh, context.n_ranks(), false);
  ShapeProblem<dim> problem(context, scene, std::move(mesh));
  problem.check_overlaps();
  if (!options.restart)
    io::remove_results(context, output_directories(scene));
  Results<dim> results(problem);
  results.summary.task = to_text(scene.task);
  results.print_header();
  std::string complaint;
  switch (options.advise ? scene::Task::state : scene.task)
    {
      case scene::Task::state:
        run_state(problem, results, options.advise);
        break;
      case scene::Task::sensitivity:
        run_sensitivity(problem, results);
        break;
      case scene::Task::optimize:
        catch_interrupts();
        complaint = optimize(problem, results, options.restart);
        break;
    }
  return complaint;
}

/// Of the largest rank, stage by stage. Collective.
void print_memory(RunContext &context)
{
  const auto memory = io::collect_memory(context);
  context.out() << "memory " << std::round(memory.largest) << " MB";
  const char *separator = "; without what ranks share, at the ";
  for (const auto &[stage, used] : memory.stages)
    {
      context.out() << separator << (stage == "start" ? "" : "end of ") << stage << " "
                    << std::round(used);
      separator = ", ";
    }
  context.out() << std::endl;
}

template <int dim>
void run_task(RunContext &context, const scene::Scene &scene, const Options &options)
{
  prepare_output(context, scene);
  print_program(context);
  std::string complaint;
  if (scene.accuracy.targets.empty())
    complaint = run_given<dim>(context, scene, options);
  else if (scene.task == scene::Task::optimize)
    complaint = run_adapted_search<dim>(context, scene, options.restart);
  else
    complaint = run_adapted<dim>(context, scene);
  print_memory(context);
  context.out() << "results in " << scene.output_directory << ", " << context.seconds() << " s"
                << std::endl;
  if (!complaint.empty())
    throw SolveError(complaint);
}

/// A misspelt one would not show otherwise.
void warn_of_unused_petsc_options(RunContext &context)
{
  for (const auto &option : petsc::unused_options(context.communicator()))
    context.out() << "warning: PETSc option " << option << " was not used" << std::endl;
}

/// OpenBLAS takes its buffer at the first call that needs one, and tries for ever where there
/// is no memory: have it at once, if there is some.
void reserve_blas_buffer()
{
  const std::size_t more_than_it_takes = std::size_t(256) << 20;
  ::operator delete(::operator new(more_than_it_takes));
  PetscBLASInt n   = 1, info;
  double       one = 1.;
  LAPACKpotrf_("L", &n, &one, &n, &info);
}
} // namespace

void run_study(RunContext &context, const scene::Scene &given, const Options &options)
{
  auto scene = given;
  if (options.advise)
    {
      scene.accuracy.estimate = accuracy::Estimate::energy;
      scene.accuracy.targets.clear(); // advice is on the mesh as given
      if (options.output.empty())
        scene.output_directory += "/advice"; // the results of runs stay
    }
  if (options.restart && scene.task != scene::Task::optimize)
    throw InputError(scene.file + ": option '--restart' goes on with an " +
                     "optimization, but 'Task' = " + to_text(scene.task));
  if (scene.dimension == 2)
    run_task<2>(context, scene, options);
  else
    run_task<3>(context, scene, options);
  warn_of_unused_petsc_options(context);
}

void validate(RunContext &context, const scene::Scene &scene)
{
  if (scene.dimension == 2)
    validate_in<2>(context, scene);
  else
    validate_in<3>(context, scene);
}

int run(const Options &options)
{
  reserve_blas_buffer();
  RunContext         context(MPI_COMM_WORLD, std::cout);
  const scene::Scene scene = scene::read_scene(
    {options.file, scene::read_text(options.file, MPI_COMM_WORLD, scene::TextSource::any),
     options.sets, options.output,
     [](const std::string &file) { return scene::read_text(file, MPI_COMM_WORLD); }});
  feti::check_factor_options(scene.feti.factorization);
  if (options.estimate)
    scene.dimension == 2 ? estimate_in<2>(context, scene, options.ranks)
                         : estimate_in<3>(context, scene, options.ranks);
  else if (options.validate)
    {
      validate(context, scene);
      context.out() << options.file << " is valid" << std::endl;
    }
  else
    run_study(context, scene, options);
  return 0;
}
} // namespace snug::app
