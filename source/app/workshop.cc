#include <snug/app/inventory.h>
#include <snug/app/workshop.h>
#include <snug/io/shape_export.h>
#include <snug/state/assumptions.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace snug::app {
std::string one_sided_warning(const unsigned int weak_contacts)
{
  return std::to_string(weak_contacts) +
         " contacts are weakly active (neither force nor gap): what "
         "depends on the displacement has only one-sided derivatives";
}

template <int dim>
Workshop<dim>::Workshop(RunContext                          &context,
                        const scene::Scene                  &scene,
                        std::unique_ptr<mesh::BodyMesh<dim>> the_mesh)
  : context(context), scene(scene), mesh(std::move(the_mesh))
{
  {
    const RunContext::Timer timer(context, "setup");
    check_distances(scene, *mesh);
    tearing = mesh::tear(*mesh);
    shape::BodyNames names;
    for (const auto &body : scene.bodies)
      names.names.push_back(body.name);
    basis = made_of(scene, [&]() {
      return std::make_unique<shape::Shapes<dim>>(*mesh, names, scene.shapes);
    });
  }
  solver = made_of(scene, [&]() {
    return std::make_unique<state::StateSolver<dim>>(*mesh, tearing, build_model(scene, *mesh),
                                                     positions(basis->start()), context);
  });
  made_of(scene, [&]() {
    state::check_overlaps(solver->contact().pairs(), solver->contact().overlaps());
  });
  objective = make_response(scene.optimization.objective);
  for (const auto &response : scene.responses)
    responses.push_back(make_response(response.name));
  if (n_load_cases() == 1)
    add_pictures(scene.output_directory);
  else
    for (const auto &load_case : scene.load_cases)
      add_pictures(path(load_case.name));
}

template <int dim>
void Workshop<dim>::add_pictures(const std::string &directory)
{
  pictures.emplace_back();
  pictures.back().fields =
    std::make_unique<io::FieldOutput<dim>>(*mesh, tearing, solver->model().bodies, directory);
  pictures.back().contact = std::make_unique<io::ContactOutput<dim>>(
    typename io::ContactOutput<dim>::Sources{*mesh, solver->surface(), solver->contact().pairs(),
                                             solver->contact().places(),
                                             solver->contact().shared_nodes()},
    directory);
}

template <int dim>
unsigned int Workshop<dim>::n_load_cases() const
{
  return solver->model().load_cases.size();
}

template <int dim>
typename Workshop<dim>::Field Workshop<dim>::positions(const std::vector<double> &design) const
{
  return sensitivity::positions(*mesh, *basis, design);
}

template <int dim>
std::unique_ptr<response::Response<dim>> Workshop<dim>::make_response(const std::string &name) const
{
  auto response = response::make_response<dim>(*scene::response_called(scene, name));
  made_of(scene, [&]() { response->check(*solver); });
  return response;
}

template <int dim>
std::vector<std::pair<std::string, double>>
Workshop<dim>::response_values(const state::ContactState<dim> &state) const
{
  std::vector<std::pair<std::string, double>> result;
  for (unsigned int i = 0; i < responses.size(); ++i)
    result.emplace_back(scene.responses[i].name, responses[i]->value(*solver, state));
  return result;
}

template <int dim>
io::Summary::State Workshop<dim>::summarize(const state::ContactState<dim> &state) const
{
  auto result      = io::summarize(state);
  result.responses = response_values(state);
  return result;
}

template <int dim>
std::vector<state::ContactState<dim>> Workshop<dim>::solve(const std::vector<double>        &design,
                                                           const std::vector<qp::WarmStart> &starts)
{
  std::vector<state::ContactState<dim>> states;
  const auto                            x = positions(design);
  for (unsigned int c = 0; c < n_load_cases(); ++c)
    states.push_back(made_of(scene, [&]() {
      return solver->solve(x, starts.empty() ? qp::WarmStart() : starts[c], c);
    }));
  return states;
}

template <int dim>
void Workshop<dim>::draw(double                                       time,
                         const std::vector<state::ContactState<dim>> &states,
                         const std::optional<Field>                  &shape_gradient)
{
  const RunContext::Timer timer(context, "output");
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      pictures[c].fields->write(time, states[c], shape_gradient ? &*shape_gradient : nullptr);
      pictures[c].contact->write(time, states[c]);
    }
}

template <int dim>
void Workshop<dim>::print_header()
{
  const auto info = io::program_info(context);
  auto      &out  = context.out();
  out << "Snug " << info.version << ", deal.II " << info.dealii << ", PETSc " << info.petsc
      << ", BLAS " << info.blas << '\n';
  if (!io::blas_warning(info).empty())
    out << "warning: " << io::blas_warning(info) << '\n';
  out << scene.bodies.size() << " bodies, " << mesh->n_global_cells() << " cells, "
      << dim * mesh->n_global_free_nodes() << " unknowns, " << tearing.n_global << " subdomains, "
      << solver->gluing().n_contact_rows() << " contact rows of " << solver->gluing().n_rows()
      << " dual rows, " << basis->n_variables() << " design variables, " << context.n_ranks()
      << " ranks" << std::endl;
  print_import_notes(scene, out);
  const auto               &pairs = solver->contact().pairs();
  std::vector<unsigned int> rows(pairs.size(), 0);
  for (const auto &place : solver->contact().places())
    ++rows[place.pair];
  for (unsigned int p = 0; p < pairs.size(); ++p)
    out << "contact " << pairs[p].name() << ", "
        << (pairs[p].obstacle ? "obstacle" : pairs[p].parameters.method) << ", " << rows[p]
        << " rows" << std::endl;
  warn(state::overlap_warnings(pairs, solver->contact().overlaps()));
}

template <int dim>
void Workshop<dim>::warn(const state::ContactState<dim> &state)
{
  warn(state::warnings(state.assumptions));
}

template <int dim>
void Workshop<dim>::warn(const std::vector<std::string> &lines)
{
  for (const std::string &line : lines)
    if (std::find(warnings.begin(), warnings.end(), line) == warnings.end())
      {
        warnings.push_back(line);
        context.out() << "warning: " << line << std::endl;
      }
}

template <int dim>
double Workshop<dim>::drift(const std::vector<double> &design) const
{
  const auto x       = solver->surface().gather(positions(design));
  double     largest = 0.;
  for (const double drift : solver->contact().drifts(x, solver->contact().rows(x)))
    largest = std::max(largest, drift);
  return largest;
}

template <int dim>
void Workshop<dim>::summarize_states(const std::vector<io::Summary::State>       &initial,
                                     const std::vector<state::ContactState<dim>> &states,
                                     io::Summary                                 &summary) const
{
  summary.state = summarize(states.front());
  if (!initial.empty())
    summary.initial_state = initial.front();
  if (states.size() == 1)
    return;
  for (unsigned int c = 0; c < states.size(); ++c)
    {
      io::Summary::LoadCase load_case;
      load_case.name   = scene.load_cases[c].name;
      load_case.weight = scene.load_cases[c].weight;
      load_case.state  = summarize(states[c]);
      if (!initial.empty())
        load_case.initial_state = initial[c];
      summary.load_cases.push_back(load_case);
    }
}

template <int dim>
void Workshop<dim>::write_summary(io::Summary &summary)
{
  summary.program               = io::program_info(context);
  summary.mesh                  = io::summarize(*mesh, tearing);
  summary.mesh.dual_rows        = solver->gluing().n_rows();
  summary.mesh.contact_rows     = solver->gluing().n_contact_rows();
  summary.mesh.kernel_dimension = solver->feti().n_kernel();
  summary.work                  = context.total_work();
  summary.times                 = io::collect_times(context);
  if (!io::blas_warning(summary.program).empty())
    summary.warnings.push_back(io::blas_warning(summary.program));
  summary.warnings.insert(summary.warnings.end(), warnings.begin(), warnings.end());
  everywhere(context.communicator(), [&]() {
    if (context.rank() == 0)
      summary.write(path("summary.json"));
  });
}

template <int dim>
void Workshop<dim>::export_shape(const std::vector<double> &design)
{
  if (basis->n_variables() == 0)
    return;
  const RunContext::Timer  timer(context, "output");
  const mesh::Surface<dim> faces(*mesh, basis->faces());
  const auto               at_faces = faces.gather(positions(design));
  const auto               points   = basis->control_points(design);
  everywhere(context.communicator(), [&]() {
    if (context.rank() != 0)
      return;
    io::write_surface(path("surface"), faces, at_faces);
    io::write_control_points(path("control-points.csv"), points);
  });
}

template <int dim>
std::string Workshop<dim>::path(const std::string &name) const
{
  return scene.output_directory + "/" + name;
}

template class Workshop<2>;
template class Workshop<3>;
} // namespace snug::app
