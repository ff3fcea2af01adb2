#include <snug/state/cell_gradients.h>
#include <snug/state/contact_results.h>
#include <snug/state/point_results.h>

namespace snug::state {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// Add values at nodes to the gradient. Hanging nodes count as independent positions, here and
/// below, because the columns of the shape basis contain the displacements of hanging nodes.
template <int dim>
void add_to_nodes(const std::vector<unsigned int>     &nodes,
                  const Nodes<dim>                    &values,
                  typename mesh::BodyMesh<dim>::Field &gradient)
{
  for (unsigned int a = 0; a < nodes.size(); ++a)
    gradient[nodes[a]] += values[a];
}

/// Call add(s, i, values) for every loaded face i of every subdomain s of this rank, and add its
/// values at the nodes of the face to the gradient.
template <int dim, typename Add>
void add_loaded_faces(const state::StateSolver<dim>       &solver,
                      const Add                           &add,
                      typename mesh::BodyMesh<dim>::Field &gradient)
{
  for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
    {
      const auto &faces = solver.assemblers()[s]->loaded_faces();
      for (unsigned int i = 0; i < faces.size(); ++i)
        {
          const auto &nodes = solver.mesh().boundary_faces()[faces[i]].nodes;
          Nodes<dim>  values(nodes.size());
          add(s, i, values);
          add_to_nodes<dim>(nodes, values, gradient);
        }
    }
}
} // namespace

/// Visit the cells in the order of subdomains and cells, without communication.
template <int dim>
void for_each_cell(const state::StateSolver<dim>                             &solver,
                   const std::string                                         &body,
                   const std::function<void(unsigned int s, unsigned int i)> &work)
{
  const auto &names = solver.model().body_names;
  for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
    {
      const auto &cells = solver.assemblers()[s]->cells();
      for (unsigned int i = 0; i < cells.size(); ++i)
        if (body.empty() || body == names[solver.mesh().cells()[cells[i]].body])
          work(s, i);
    }
}

template <int dim>
void add_to_cell_nodes(const state::StateSolver<dim>       &solver,
                       unsigned int                         s,
                       unsigned int                         i,
                       const Nodes<dim>                    &values,
                       typename mesh::BodyMesh<dim>::Field &gradient)
{
  const unsigned int cell = solver.assemblers()[s]->cells()[i];
  add_to_nodes<dim>(solver.mesh().cells()[cell].nodes, values, gradient);
}

template <int dim>
void add_stiffness_gradient(const state::StateSolver<dim>       &solver,
                            const state::ContactState<dim>      &state,
                            const feti::PrimalVectors           &w,
                            double                               factor,
                            typename mesh::BodyMesh<dim>::Field &gradient)
{
  const auto add = [&](unsigned int s, unsigned int i) {
    const auto &assembler = *solver.assemblers()[s];
    // Take u from the vector of the subdomain, in which masters act for hanging nodes.
    const auto u = assembler.cell_values(i, state.u[s].column(0));
    Nodes<dim> values(u.size());
    assembler.element().add_energy_gradient(assembler.cell_field(i, state.positions),
                                            assembler.material(i), u,
                                            assembler.cell_values(i, w[s].column(0)), factor,
                                            values);
    add_to_cell_nodes(solver, s, i, values, gradient);
  };
  for_each_cell<dim>(solver, "", add);
}

template <int dim>
void add_load_gradient(const state::StateSolver<dim>       &solver,
                       const state::ContactState<dim>      &state,
                       const feti::PrimalVectors           &w,
                       double                               factor,
                       typename mesh::BodyMesh<dim>::Field &gradient)
{
  const auto add = [&](unsigned int s, unsigned int i) {
    const auto &assembler = *solver.assemblers()[s];
    if (!assembler.has_cell_loads(state.load_case))
      return;
    const auto X = assembler.cell_field(i, state.positions);
    Nodes<dim> values(X.size());
    assembler.add_cell_load_gradient(i, X, state.load_case,
                                     assembler.cell_values(i, w[s].column(0)), factor, values);
    add_to_cell_nodes(solver, s, i, values, gradient);
  };
  for_each_cell<dim>(solver, "", add);

  // Pressures, tractions and body forces contribute per cell. A resultant is spread over the whole
  // boundary, so each node changes the load on all of it; see add_work_gradient().
  const auto tractions = solver.resultants().tractions(state.positions);
  const auto add_face  = [&](unsigned int s, unsigned int i, Nodes<dim> &values) {
    const auto &assembler = *solver.assemblers()[s];
    solver.face_load().add_force_gradient(assembler.face_field(i, state.positions),
                                           assembler.face_load_values(i, state.load_case, tractions),
                                           assembler.face_values(i, w[s].column(0)), factor, values);
  };
  add_loaded_faces(solver, add_face, gradient);
  solver.resultants().add_work_gradient(state.load_case, state.positions,
                                        state::nodal_values(solver, w, 0), factor, gradient);
}

template <int dim>
void add_constraint_gradient(const state::StateSolver<dim>       &solver,
                             const state::ContactState<dim>      &state,
                             typename mesh::BodyMesh<dim>::Field &gradient)
{
  const auto         &surface = solver.surface();
  std::vector<double> forces;
  for (const auto &point : state.contact)
    forces.push_back(point.force);
  // Contact data are replicated, and the gradient at surface nodes is complete on all ranks. Each
  // rank adds its own nodes only, because otherwise the sum over ranks would count the gradient
  // repeatedly.
  const auto at_surface =
    solver.contact(state.load_case)
      .energy_gradient(state.surface_positions, state.surface_displacement, {forces});
  surface.add_owned(at_surface, gradient);
  const auto of_rows = solver.gluing(state.load_case).row_forces(state.dual.lambda).front();
  surface.add_owned(solver.ties().energy_gradient(state.surface_positions,
                                                  state.surface_displacement, of_rows.ties),
                    gradient);
  if (!solver.points().empty())
    surface.add_owned(solver.points().energy_gradient(state.surface_positions,
                                                      point_motions(solver, state.u, 0),
                                                      of_rows.all,
                                                      solver.rows(state.positions, state.load_case),
                                                      solver.contact(state.load_case)),
                      gradient);
  // reactions() treats contact rows as if they were not projected off the held directions, as
  // energy_gradient() above does.
  if (solver.held().follow_positions())
    solver.held().add_energy_gradient(state.positions, state.displacement,
                                      solver.gluing(state.load_case)
                                        .reactions(state.dual.lambda,
                                                   solver.rows(state.positions, state.load_case)),
                                      gradient);
}

#define SNUG_INSTANTIATE(dim)                                                                    \
  template void for_each_cell(const state::StateSolver<dim> &, const std::string &,              \
                              const std::function<void(unsigned int, unsigned int)> &);          \
  template void add_to_cell_nodes(const state::StateSolver<dim> &, unsigned int, unsigned int,   \
                                  const Nodes<dim> &, mesh::BodyMesh<dim>::Field &);             \
  template void add_stiffness_gradient(const state::StateSolver<dim> &,                          \
                                       const state::ContactState<dim> &,                         \
                                       const feti::PrimalVectors &, double,                      \
                                       mesh::BodyMesh<dim>::Field &);                            \
  template void add_load_gradient(const state::StateSolver<dim> &,                               \
                                  const state::ContactState<dim> &, const feti::PrimalVectors &, \
                                  double, mesh::BodyMesh<dim>::Field &);                         \
  template void add_constraint_gradient(const state::StateSolver<dim> &,                         \
                                        const state::ContactState<dim> &,                        \
                                        mesh::BodyMesh<dim>::Field &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
