#include <snug/accuracy/cell_fields.h>
#include <snug/mesh/shared_nodes.h>
#include <snug/state/thermal.h>

namespace snug::accuracy {
template <int dim>
CellFields<dim>::CellFields(const state::StateSolver<dim>  &solver,
                            const state::ContactState<dim> &state)
  : local_positions(mesh::owners_values(solver.mesh(), state.positions))
  , displacement(mesh::owners_values(solver.mesh(), state.displacement))
  , solver(solver)
  , loads(solver.model().load_cases[state.load_case].bodies)
{
  for (const auto &body : solver.model().bodies)
    elements.emplace_back(solver.mesh().degree(), solver.mesh().idealization(), body.formulation);
}

template <int dim>
typename CellFields<dim>::Nodes CellFields<dim>::at_cell(const unsigned int cell,
                                                         const Field       &field) const
{
  const auto &nodes = solver.mesh().known_cell(cell).nodes;
  Nodes       result;
  result.reserve(nodes.size());
  for (const unsigned int node : nodes)
    result.push_back(field[node]);
  return result;
}

template <int dim>
const elasticity::Material &CellFields<dim>::material(const unsigned int cell) const
{
  const auto &the_cell = solver.mesh().known_cell(cell);
  return solver.model().bodies[the_cell.body].material(the_cell);
}

template <int dim>
typename CellFields<dim>::Strained
CellFields<dim>::strained(const unsigned int cell, const Field &u, const double thermal) const
{
  const unsigned int body = solver.mesh().known_cell(cell).body;
  Strained           result{at_cell(cell, u), {}};
  if (thermal != 0. && loads[body].temperature)
    if (const auto full =
          state::thermal_strain<dim>(loads[body], material(cell),
                                     at_cell(cell, solver.mesh().reference_positions())))
      result.thermal = [=](const auto &shape) { return thermal * full(shape); };
  return result;
}

template <int dim>
std::vector<typename CellFields<dim>::Stresses>
CellFields<dim>::stresses(const unsigned int                          cell,
                          const std::vector<LoadedDisplacement<dim>> &of,
                          const Shapes                               &at) const
{
  std::vector<Strained> all;
  all.reserve(of.size());
  for (const auto &one : of)
    all.push_back(strained(cell, one.displacement, one.thermal));
  return elements[solver.mesh().known_cell(cell).body].stresses(positions(cell), material(cell),
                                                                all, at);
}

template <int dim>
std::vector<typename CellFields<dim>::Stresses>
CellFields<dim>::fluxes(const unsigned int                          cell,
                        const std::vector<LoadedDisplacement<dim>> &of,
                        const Shapes                               &at) const
{
  const unsigned int body   = solver.mesh().known_cell(cell).body;
  const auto        &name   = solver.model().body_names[body];
  auto               result = stresses(cell, of, at);
  for (unsigned int i = 0; i < of.size(); ++i)
    if (const auto *more = of[i].more;
        more && more->stress && (more->body.empty() || name == more->body))
      {
        const auto sigma =
          elements[body]
            .stresses(positions(cell), material(cell), {strained(cell, displacement, 1.)}, at)
            .front();
        for (unsigned int q = 0; q < at.size(); ++q)
          result[i][q] -= more->stress(material(cell), sigma[q]);
      }
  return result;
}

template class CellFields<2>;
template class CellFields<3>;
} // namespace snug::accuracy
