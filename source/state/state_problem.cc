#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/state/axis_checks.h>
#include <snug/state/cell_checks.h>
#include <snug/state/state_problem.h>
#include <snug/state/subdomain_table.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

namespace snug::state {
namespace {
/// Return which motions of reference points a load case holds, one flag per unknown.
std::vector<bool> held_motions(const std::vector<PointLoad> &points)
{
  std::vector<bool> result;
  for (const auto &point : points)
    for (const auto &value : point.held)
      result.push_back(value.has_value());
  return result;
}
} // namespace

template <int dim>
StateProblem<dim>::StateProblem(const mesh::BodyMesh<dim> &mesh,
                                const mesh::Tearing       &the_tearing,
                                const Model<dim>          &the_model,
                                const Field               &positions,
                                RunContext                &context)
  : mesh(mesh)
  , tearing(with_points(the_tearing, mesh, the_model))
  , model(with_lengths(the_model, mesh))
  , context(context)
  , face_load(mesh.degree(), mesh.idealization())
  , resultants(mesh, face_load, model.load_cases)
  , concentrated(mesh, model.load_cases)
  , surface(mesh, glued_boundaries(model))
  , springs(mesh, model, face_load, positions)
  , factor_cache(model.feti.factorization, context)
{
  for (const auto &body : model.bodies)
    elements.emplace_back(mesh.degree(), mesh.idealization(), body.formulation);
  const RunContext::Timer timer(context, "setup");
  boxes = body_boxes(mesh);
  for (const auto &point : model.points)
    boxes.push_back({point.place, point.length});
  if (mesh.idealization().is_axisymmetric())
    check_radii(mesh, model.body_names);
  throw_collectively(context.communicator(), [&]() { check_cells(mesh, model, elements); });
  held = std::make_unique<supports::DirichletConstraints<dim>>(mesh, model.supports,
                                                               model.load_cases.size(), positions,
                                                               model.point_supports);
  make_positions();
  const auto x          = surface.gather(positions);
  const auto directions = held->directions(surface, positions);
  for_each_position([&](PositionProblem<dim> &at) {
    at.contact = std::make_unique<contact::Contact<dim>>(surface, model.pairs, mesh.degree(), x,
                                                         directions, at.position);
  });
  ties   = std::make_unique<Ties<dim>>(surface, model.ties, mesh.degree(), x, directions);
  points = std::make_unique<ReferencePoints<dim>>(mesh, surface, model, *ties, x);
  systems.resize(tearing.subdomains.size());
  for (unsigned int s = 0; s < systems.size(); ++s)
    {
      const auto &subdomain = tearing.subdomains[s];
      const auto  element   = std::min(subdomain.body, mesh.n_bodies() - 1); // any for a point
      assemblers.push_back(std::make_unique<Assembler<dim>>(mesh, subdomain, model,
                                                            elements[element], face_load,
                                                            concentrated));
      systems[s].body        = subdomain.body;
      systems[s].K           = factor_cache.patterns.of(assemblers[s]->sparsity());
      systems[s].fixing_dofs = assemblers[s]->fixing_dofs(positions);
      systems[s].compact     = assemblers[s]->is_compact(positions);
    }
  glue(positions);
}

/// Make one problem for each position. Load cases of equal position that hold the same motions of
/// reference points share it.
template <int dim>
void StateProblem<dim>::make_positions()
{
  for (unsigned int c = 0; c < model.load_cases.size(); ++c)
    {
      const auto &load_case = model.load_cases[c];
      const auto  found     = std::find_if(problems.begin(), problems.end(), [&](const auto &at) {
        return at->position == load_case.position &&
               held_motions(model.load_cases[at->first_case].points) ==
                 held_motions(load_case.points);
      });
      problem_of_case.push_back(narrow<unsigned int>(found - problems.begin()));
      if (found == problems.end())
        problems.push_back(std::make_unique<PositionProblem<dim>>(load_case.position, c));
    }
}

/// Call @p pair for each position. An error of the input names the load case.
template <int dim>
void StateProblem<dim>::for_each_position(
  const std::function<void(PositionProblem<dim> &)> &pair) const
{
  for (unsigned int i = 0; i < problems.size(); ++i)
    try
      {
        pair(*problems[i]);
      }
    catch (const InputError &error)
      {
        throw InputError(error.text() + place_of(model, problems[i]->first_case), error.place(),
                         error.wrong());
      }
}

/// Build everything that depends on which nodes are paired.
template <int dim>
void StateProblem<dim>::glue(const Field &x)
{
  forget();
  shared = feti::SharedOperators(systems.size());
  std::vector<RowCoefficients<dim>> rows;
  for (const auto &at : problems)
    rows.push_back(rows_of(*at, x));
  const auto table = subdomain_table(mesh, tearing, model);
  for (auto &system : systems)
    system.boundary.clear();
  for (unsigned int i = 0; i < problems.size(); ++i)
    {
      auto &at = *problems[i];
      at.structure.reset(); // refers to the old gluing
      at.gluing           = std::make_unique<Gluing<dim>>(mesh, tearing, surface, *held, rows[i],
                                                          at.contact->tangents(), model, at.first_case);
      at.structure        = std::make_unique<const feti::DualStructure>(at.gluing->layout(), table,
                                                                        model.feti, factor_cache);
      const auto &contact = *at.contact;
      at.pairs_of_rows    = {{}, narrow<unsigned int>(contact.pairs().size()), dim};
      for (const unsigned int row : at.gluing->contact_of_row())
        at.pairs_of_rows.of_row.push_back(row < contact.n_rows() ? contact.places()[row].pair
                                                                 : at.pairs_of_rows.n);
      for (unsigned int s = 0; s < systems.size(); ++s)
        {
          const auto                before = systems[s].boundary, mine = at.gluing->boundary(s);
          std::vector<unsigned int> all;
          std::set_union(before.begin(), before.end(), mine.begin(), mine.end(),
                         std::back_inserter(all));
          systems[s].boundary = all;
        }
    }
  paired_at = x;
}

/// Destroy the matrices and loads of the present geometry, except factorizations and soft modes.
template <int dim>
void StateProblem<dim>::forget()
{
  loaded_problems.clear();
  loaded_problems.resize(model.load_cases.size());
  slips_before.assign(model.load_cases.size(), {});
  for (auto &at : problems)
    at->linearization.reset();
  shared.clusters.reset();
  shared.deflation.reset();
  present.positions.clear();
}

template <int dim>
void StateProblem<dim>::pair(const Field &x)
{
  const RunContext::Timer timer(context, "setup");
  const auto              on_surface = surface.gather(x);
  const auto              directions = held->directions(surface, x);
  for_each_position([&](PositionProblem<dim> &at) { at.contact->pair(on_surface, directions); });
  ties->pair(on_surface, directions);
  glue(x);
}

template <int dim>
std::vector<bool> StateProblem<dim>::moved_subdomains(const Field &positions) const
{
  std::vector<bool> moved(systems.size(), present.positions.empty());
  for (unsigned int s = 0; s < systems.size() && !present.positions.empty(); ++s)
    for (const unsigned int cell : tearing.subdomains[s].cells)
      for (const unsigned int node : mesh.cells()[cell].nodes)
        if (positions[node] != present.positions[node])
          moved[s] = true;
  return moved;
}

/// Return the minimum scaled Jacobian of each subdomain. The stored values stay unchanged, because
/// a later subdomain may be tangled, and the geometry is then not taken.
template <int dim>
std::vector<double> StateProblem<dim>::checked_jacobians(const Field             &positions,
                                                         const std::vector<bool> &moved)
{
  if (mesh.idealization().is_axisymmetric())
    check_axis(mesh, positions, boxes);
  auto result = scaled_jacobians;
  result.resize(systems.size());
  for (unsigned int s = 0; s < systems.size(); ++s)
    if (moved[s])
      {
        const auto &element = assemblers[s]->element();
        double      quality = 1., jacobian = 1.;
        for (unsigned int i = 0; i < assemblers[s]->cells().size(); ++i)
          {
            const auto X     = assemblers[s]->cell_field(i, positions);
            const auto own   = element.qualities(X);
            quality          = std::min(quality, own.first);
            jacobian         = std::min(jacobian, own.second);
            const auto found = flaw_of_cell(model.body_names[systems[s].body], X.front(), quality,
                                            jacobian, model.least_scaled_jacobian);
            if (!found.empty())
              throw TangledMesh(found + "; reduce the bounds of the shape");
          }
        result[s] = jacobian;
      }
  return result;
}

template <int dim>
void StateProblem<dim>::assemble(const Field &positions, const std::vector<bool> &moved)
{
  const auto tractions = resultants.tractions(positions);
  loads.resize(model.load_cases.size());
  const auto assemble_subdomain = [&](const unsigned int s) {
    auto &system = systems[s];
    if (moved[s])
      {
        assemblers[s]->stiffness(positions, system.K);
        assemblers[s]->rigid_modes(positions, boxes[system.body].centre, boxes[system.body].length,
                                   system.R, system.Z);
        ++context.work.assembled_subdomains;
      }
    if (moved[s] || assemblers[s]->has_resultants())
      for (unsigned int c = 0; c < loads.size(); ++c)
        {
          const auto f = assemblers[s]->load(positions, c, tractions);
          // At the first geometry all subdomains have moved.
          if (loads[c].size() == s)
            loads[c].emplace_back(system.n_dofs());
          std::copy(f.begin(), f.end(), loads[c][s].column(0));
        }
  };
  throw_collectively(context.communicator(), [&]() {
    for (unsigned int s = 0; s < systems.size(); ++s)
      assemble_subdomain(s);
  });
}

/// Assemble the matrices and loads at @p x, unless they are the present ones.
template <int dim>
void StateProblem<dim>::go_to(const Field &x)
{
  const auto moved     = moved_subdomains(x);
  const int  any_moved = std::find(moved.begin(), moved.end(), true) != moved.end();
  if (dealii::Utilities::MPI::max(any_moved, context.communicator()) == 0)
    return;
  const RunContext::Timer timer(context, "assembly");
  std::vector<double>     jacobians;
  throw_collectively(context.communicator(), [&]() { jacobians = checked_jacobians(x, moved); });
  scaled_jacobians = jacobians;
  jacobians.push_back(1.); // for a rank without cells
  forget();
  // Only one set of matrices and factors exists at a time. The factors of moved subdomains go back
  // to the cache, which keeps their symbolic parts.
  for (unsigned int s = 0; s < systems.size(); ++s)
    if (moved[s])
      {
        shared.factors[s].reset();
        shared.joints[s].reset();
      }
  present.least_scaled_jacobian =
    dealii::Utilities::MPI::min(*std::min_element(jacobians.begin(), jacobians.end()),
                                context.communicator());
  assemble(x, moved);
  present.positions = x;
}

/// Compute the linearization of a position at the present geometry, unless it is known.
template <int dim>
void StateProblem<dim>::linearize(PositionProblem<dim> &at)
{
  if (at.linearization)
    return;
  at.rows = rows_of(at, present.positions);
  if (at.contact->has_friction())
    at.cones = at.gluing->cones(*at.contact, at.contact->areas(surface.gather(present.positions)));
  feti::ConstraintRows B(systems.size());
  for (unsigned int s = 0; s < systems.size(); ++s)
    at.gluing->fill_B(s, at.rows, B[s]);
  at.linearization =
    std::make_unique<const feti::Linearization>(*at.structure, systems, std::move(B), shared,
                                                at.gluing->compliances(at.rows));
  shared = at.linearization->shared();
}

template <int dim>
void StateProblem<dim>::set(const Field               &x,
                            const unsigned int         load_case,
                            const std::vector<double> &slips)
{
  // The soft modes and their directions refer to the rows of the first position, so its
  // linearization is the first one of every geometry.
  PositionProblem<dim> &first = *problems.front();
  // Find the soft modes at the positions of the pairing, and not at those at which states happen to
  // be requested, so that a run that was interrupted finds the same soft modes again.
  if (!shared.soft_modes && first.structure->seeks_soft_modes(systems))
    {
      go_to(paired_at);
      linearize(first);
      if (first.linearization->prefers_subdomains())
        {
          context.out()
            << "subdomains are not joined to clusters, because the soft modes of single "
               "subdomains save more iterations"
            << std::endl;
          tearing.clusters = {};
          glue(Field(paired_at));
          go_to(paired_at);
          linearize(first);
        }
    }
  go_to(x);
  linearize(first);
  PositionProblem<dim> &at = *problems[problem_of_case[load_case]];
  linearize(at);
  // The slips before a step are those of a state, which may have been solved more accurately since.
  if (loaded_problems[load_case] && slips_before[load_case] == slips)
    return;
  check_vanished_rows(load_case);
  auto g = at.gluing->right_hand_side(at.rows, load_case);
  if (!slips.empty())
    at.gluing->add_step(slips, load_case, g);
  slips_before[load_case] = slips;
  loaded_problems[load_case] =
    std::make_unique<const feti::LoadedProblem>(*at.linearization, loads[load_case], std::move(g),
                                                &at.pairs_of_rows, at.cones);
}

template <int dim>
const feti::LoadedProblem &StateProblem<dim>::loaded(const Field       &positions,
                                                     const unsigned int load_case) const
{
  const auto moved = moved_subdomains(positions);
  SNUG_ASSERT(std::find(moved.begin(), moved.end(), true) == moved.end() &&
                loaded_problems[load_case],
              "the problem is at another geometry or load case");
  return *loaded_problems[load_case];
}

template <int dim>
RowCoefficients<dim> StateProblem<dim>::rows(const Field &x, const unsigned int load_case) const
{
  return rows_of(of(load_case), x);
}

template <int dim>
RowCoefficients<dim> StateProblem<dim>::rows_of(const PositionProblem<dim> &at,
                                                const Field                &x) const
{
  const auto on_surface = surface.gather(x);
  auto       contact    = at.contact->rows(on_surface);
  auto       tangents   = at.contact->tangent_rows(on_surface, contact);

  RowCoefficients<dim> result{std::move(contact), std::move(tangents),    held->frames(x),
                              springs.rows(x),    ties->rows(on_surface), points->rows()};
  result.points = points->entries(on_surface, result, *at.contact);
  return result;
}

template <int dim>
void StateProblem<dim>::check_vanished_rows(unsigned int load_case) const
{
  const PositionProblem<dim> &at     = of(load_case);
  double                      length = 0.;
  for (const auto &box : boxes)
    length = std::max(length, box.length);
  for (const unsigned int i : at.gluing->vanished_rows())
    if (at.gluing->gap(i, at.rows, load_case) < -1e-10 * length)
      {
        std::ostringstream text;
        text << "no equilibrium: contact row " << i << " has an overlap of "
             << -at.gluing->gap(i, at.rows, load_case)
             << ", but supports hold its nodes in the contact direction";
        throw SolveError(text.str());
      }
}

template class StateProblem<2>;
template class StateProblem<3>;
} // namespace snug::state
