#include <snug/app/adaptation.h>
#include <snug/app/cost_report.h>
#include <snug/app/interrupt.h>
#include <snug/app/mesh_checks.h>
#include <snug/app/model_report.h>
#include <snug/app/optimize.h>
#include <snug/app/read_deck.h>
#include <snug/app/sensitivity.h>
#include <snug/app/serve.h>
#include <snug/app/state_report.h>
#include <snug/app/study.h>
#include <snug/base/errors.h>
#include <snug/base/gather.h>
#include <snug/base/petsc_options.h>
#include <snug/cad/import_cad.h>
#include <snug/cad/translate.h>
#include <snug/deck/translation.h>
#include <snug/feti/sparse_factor.h>
#include <snug/io/fields.h>
#include <snug/io/mesh_summary.h>
#include <snug/io/summary.h>
#include <snug/io/text_file.h>
#include <snug/mesh_file/deck_text.h>
#include <snug/scene/json_scene.h>
#include <snug/scene/read_scene.h>

#include <petscblaslapack.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>

namespace snug::app {
namespace {
template <int dim>
void report(const ShapeProblem<dim>            &problem,
            Results<dim>                       &results,
            typename ShapeProblem<dim>::States &states)
{
  auto &out = problem.context.out(Verbosity::quiet);
  for (auto &state : states)
    {
      if (problem.scene.report_linear_reference)
        state.linear_f_mults = problem.solver->linear_f_mults(state);
      print_state(problem, state);
      for (const auto &[name, value] : results.response_values(state))
        {
          const auto quantity = scene::response_called(problem.scene, name)->quantity;
          out << "response " << name << (quantity == name ? "" : " (" + quantity + ")") << ": "
              << value << scene::unit_after_number(problem.scene, name) << std::endl;
        }
    }
  results.warn(states);
}

template <int dim>
void estimate_in(RunContext &context, const scene::Scene &scene, const unsigned int ranks)
{
  const auto mesh = timed_mesh<dim>(context, scene);
  print_cost_estimate(context, scene, *mesh, ranks > 0 ? ranks : context.n_ranks(), true);
}

/// Write the entries and the bodies without a load into the directory 'model' of the output
/// directory, for a picture. Collective.
template <int dim>
void write_model(RunContext                                &context,
                 const ShapeProblem<dim>                   &problem,
                 const typename mesh::BodyMesh<dim>::Field &positions)
{
  scene::Scene scene = problem.scene;
  scene.output_directory += "/model";
  scene.output.fields.clear();
  io::prepare_output(context, scene);
  std::vector<std::string> names;
  for (const auto &body : scene.bodies)
    names.push_back(body.name);
  state::ContactState<dim> at_rest;
  at_rest.positions = positions;
  at_rest.displacement.resize(positions.size());
  const auto &model = problem.solver->model();
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    io::FieldOutput<dim>(io::output_directories(scene)[problem.n_load_cases() > 1 ? c + 1 : 0],
                         scene.output, names)
      .write({*problem.mesh, problem.tearing, model.bodies, model.load_cases[c]}, 0., at_rest);
}

template <int dim>
io::Json validate_in(RunContext &context, const scene::Scene &scene, const bool writes)
{
  auto mesh = timed_mesh<dim>(context, scene);
  print_cost_estimate(context, scene, *mesh, context.n_ranks(), false);
  print_notes(scene, context.out());
  print_cad_faces(scene, context.out(Verbosity::quiet));
  const auto summary = io::summarize_mesh(scene, *mesh);
  print(summary, context.out(Verbosity::quiet));
  context.warn("mesh file", import_warnings(scene));
  context.warn("refinement", refinement_warnings(scene, *mesh));
  const ShapeProblem<dim> problem(context, scene, std::move(mesh));
  print_pairs(problem);
  warn_of_model(problem);
  problem.check_overlaps();
  const auto positions = problem.positions(problem.shapes->start());
  // Formulas of loads may have no value where only some ranks look.
  for (unsigned int c = 0; c < problem.n_load_cases(); ++c)
    with_file_context(scene, [&]() {
      throw_collectively(context.communicator(), [&]() { problem.solver->loads(positions, c); });
    });
  if (writes)
    write_model(context, problem, positions);
  return {{"valid", true},
          {"file", scene.file},
          {"bodies", io::bodies_part(summary)},
          {"pairs", pairs_part(problem)},
          {"warnings", io::warnings_part(context.warnings())}};
}

void print_program(RunContext &context)
{
  const auto info = io::program_info(context);
  context.out() << "Snug " << info.version << ", deal.II " << info.dealii << ", PETSc "
                << info.petsc << ", BLAS " << info.blas << std::endl;
  if (!io::blas_warning(info).empty())
    context.warn({"BLAS", io::blas_warning(info)});
}

/// Analyse the initial design on the mesh of the scene, or on a mesh that meets the targets, and
/// differentiate there if the task asks for it. Return why the targets are not met; empty: they
/// are. Collective.
template <int dim>
std::string analyse(RunContext &context, const scene::Scene &scene, const bool advise)
{
  const bool          has_targets = !scene.accuracy.targets.empty();
  Adaptation<dim>     adaptation(context, scene);
  AdaptedProblem<dim> adapted;
  std::string         failure_reason;
  if (has_targets)
    {
      adaptation.start();
      io::remove_earlier_results(context, scene);
      failure_reason = adaptation.reach_and_verify();
      adapted        = adaptation.release();
    }
  else
    {
      auto mesh = timed_mesh<dim>(context, scene);
      print_cost_estimate(context, scene, *mesh, context.n_ranks(), false);
      adapted.problem = std::make_unique<ShapeProblem<dim>>(context, scene, std::move(mesh));
      adapted.problem->check_overlaps();
      io::remove_earlier_results(context, scene);
    }
  auto        &problem = *adapted.problem;
  auto        &states  = adapted.states;
  Results<dim> results(problem);
  if (has_targets)
    {
      results.summary.accuracy = adaptation.summary;
      results.print_work();
    }
  results.print_header();
  if (!has_targets)
    {
      context.progress("solving the contact problem ...");
      states = problem.solve(problem.shapes->start());
    }
  report(problem, results, states);
  std::optional<typename ShapeProblem<dim>::Field> shape_gradient;
  if (scene.task == scene::Task::sensitivity && !advise)
    {
      const Sensitivity<dim> sensitivity(problem, results, states);
      shape_gradient           = sensitivity.shape_gradient;
      results.summary.gradient = sensitivity.gradient;
      sensitivity.write_all(results.path("gradients.csv"));
      results.export_shape(problem.shapes->start());
    }
  // Responses that are no targets are estimated if the estimates of all responses are asked for.
  const bool all_errors = scene.accuracy.estimate == accuracy::Estimate::responses;
  results.add_last(0., states, shape_gradient,
                   all_errors ? std::vector<MeshError>() : adapted.errors);
  if (advise)
    results.advise(states);
  results.write_summary();
  return results.failure_reason(failure_reason);
}

/// Print the peak memory of the largest rank and its memory after each stage. Collective.
void print_memory(RunContext &context)
{
  const auto memory = io::collect_memory(context);
  context.out() << "peak memory: " << std::round(memory.largest) << " MB" << std::endl;
  auto &out = context.out(Verbosity::debug);
  out << "private memory after each stage [MB]:";
  for (const auto &[stage, used] : memory.stages)
    out << ' ' << stage << ' ' << std::round(used);
  out << std::endl;
}

template <int dim>
void run_task(RunContext &context, const scene::Scene &scene, const Options &options)
{
  io::prepare_output(context, scene);
  print_program(context);
  const auto failure_reason = scene.task == scene::Task::optimize && !options.advise
                                ? optimize<dim>(context, scene, options.restart)
                                : analyse<dim>(context, scene, options.advise);
  print_memory(context);
  context.out(Verbosity::quiet) << "results in " << scene.output_directory << ", "
                                << context.seconds() << " s" << std::endl;
  if (!failure_reason.empty())
    throw SolveError(failure_reason);
}

/// Warn of PETSc options that were not used, because a misspelt option would not be noticed
/// otherwise. Collective.
void warn_of_unused_petsc_options(RunContext &context)
{
  for (const auto &option : petsc::unused_options(context.communicator()))
    context.warn({"PETSc option", "PETSc option " + option + " was not used"});
}

/// Make OpenBLAS allocate its buffer, after a check that there is memory for the buffer. Otherwise
/// OpenBLAS would allocate at the first call that needs the buffer, and retry indefinitely if there
/// is no memory. @throws std::bad_alloc.
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
    throw InputError(scene.file + ": option '--restart' continues an " +
                     "optimization, but 'Task' = " + to_text(scene.task));
  if (scene.dimension == 2)
    run_task<2>(context, scene, options);
  else
    run_task<3>(context, scene, options);
  warn_of_unused_petsc_options(context);
}

io::Json validate(RunContext &context, const scene::Scene &scene, const bool writes)
{
  return scene.dimension == 2 ? validate_in<2>(context, scene, writes)
                              : validate_in<3>(context, scene, writes);
}

namespace {
/// Return the parameter file of a CAD file. Collective. @throws InputError also if the file was to
/// be run, because it has no loads.
std::string translate_cad(const Options &options, const RunContext &context)
{
  if (!options.translate)
    throw InputError(
      options.file + " is a CAD file, which has no supports and loads; 'snug --translate " +
      options.file + " > model.prm' prints a parameter file to which they can be added");
  return made_on_first_rank(context.communicator(), [&]() { return cad::translate(options.file); });
}

/// Print a parameter file on standard output, which has no log. Collective.
void print_translation(const RunContext &context, const std::string &text)
{
  if (context.rank() == 0)
    std::cout << text << std::flush;
}

/// Read the file of @p options and do what they ask. JSON goes to the descriptor @p answers.
void run_file(const Options &options, RunContext &context, const int answers)
{
  if (cad::is_cad_file(options.file))
    {
      print_translation(context, translate_cad(options, context));
      return;
    }
  const MPI_Comm     communicator = context.communicator();
  scene::SceneSource source       = {options.file,
                                     "",
                                     options.sets,
                                     options.output,
                                     [](const std::string &file) { return scene::read_text(file); },
                                     &context};
  const auto         is_model     = [&]() {
    return std::filesystem::path(options.file).extension() == ".prm" || scene::is_json(source.text);
  };
  // Decks may be long, so only rank 0 has their texts.
  const auto translation = made_on_first_rank(communicator, [&]() {
    source.text = scene::read_text(options.file, scene::TextSource::any);
    return options.translate && is_model() ? deck::Translation()
                                           : translate_deck(source, options.translate);
  });
  source.text            = broadcast(communicator, source.text);
  source.file            = broadcast(communicator, source.file);
  if (options.translate)
    {
      std::ostringstream text;
      if (is_model())
        scene::print(scene::read_scene(source), text);
      else
        text << source.text;
      print_translation(context, text.str());
      return;
    }
  const scene::Scene scene = scene::read_scene(source);
  report_translation(context, options, translation);
  feti::check_factor_options(scene.feti.factorization);
  if (options.serve)
    serve(context, source, scene, answers);
  else if (options.estimate)
    scene.dimension == 2 ? estimate_in<2>(context, scene, options.ranks)
                         : estimate_in<3>(context, scene, options.ranks);
  else if (options.validate)
    {
      const auto found = validate(context, scene, !options.output.empty());
      context.out(Verbosity::quiet) << options.file << " is valid" << std::endl;
      if (options.json && context.rank() == 0)
        io::write_line(answers, found);
    }
  else
    run_study(context, scene, options);
}
} // namespace

int run(const Options &options)
{
  reserve_blas_buffer();
  const int  answers = options.serve || options.json ? divert_standard_output() : -1;
  RunContext context(MPI_COMM_WORLD, options.translate ? std::cerr : std::cout);
  try
    {
      run_file(options, context, answers);
    }
  catch (const std::exception &error)
    {
      if (options.json && context.rank() == 0)
        io::write_line(answers, {{"valid", false},
                                 {"file", options.file},
                                 {"error", io::error_part(error)}});
      throw;
    }
  return 0;
}
} // namespace snug::app
