#include <snug/app/results.h>
#include <snug/io/mesh_export.h>
#include <snug/io/text_file.h>
#include <snug/mesh/shared_nodes.h>

#include <algorithm>

namespace snug::app {
namespace {
/// Return the nodal forces of the first load case at @p positions. Collective.
template <int dim>
typename mesh::BodyMesh<dim>::Field
nodal_forces(const ShapeProblem<dim> &problem, const typename mesh::BodyMesh<dim>::Field &positions)
{
  const auto         &mesh  = *problem.mesh;
  const auto          loads = problem.solver->loads(positions, 0);
  std::vector<double> values(dim * mesh.n_local_nodes());
  for (unsigned int s = 0; s < loads.size(); ++s)
    {
      const auto &nodes = problem.solver->tearing().subdomains[s].nodes;
      for (unsigned int i = 0; i < dim * nodes.size(); ++i)
        values[dim * nodes[i / dim] + i % dim] += loads[s](i);
    }
  mesh::sum_at_shared_nodes(mesh, dim, values);
  typename mesh::BodyMesh<dim>::Field forces(mesh.n_local_nodes());
  for (unsigned int i = 0; i < values.size(); ++i)
    forces[i / dim][i % dim] = values[i];
  return forces;
}
} // namespace

template <int dim>
void Results<dim>::export_meshes(const state::ContactState<dim> &state)
{
  const auto &formats = problem->scene.output.meshes;
  if (formats.empty())
    return;
  const RunContext::Timer timer(problem->context, "output");
  const auto              wants = [&](const std::string &format) {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  };
  const auto &mesh = *problem->mesh;
  const auto  whole =
    io::gather_mesh<dim>(mesh, state.positions, nodal_forces(*problem, state.positions));
  const auto               frames = problem->solver->held().frames(state.positions);
  std::vector<std::string> lines;
  throw_collectively(problem->context.communicator(), [&]() {
    if (problem->context.rank() != 0)
      return;
    if (wants("msh") && whole.hanging.empty())
      io::write_text_file(path("bodies.msh"), io::msh_text(mesh, problem->scene, whole));
    else if (wants("msh"))
      lines.push_back("bodies.msh is not written, because the mesh has hanging nodes: of local "
                      "refinement, or of tetrahedra, prisms or triangles of degree 2");
    if (wants("inp"))
      {
        const auto deck = io::deck_text<dim>(*problem->solver, problem->scene, whole, frames);
        io::write_text_file(path("bodies.inp"), deck.text);
        for (const auto &line : deck.left_out)
          lines.push_back("bodies.inp lacks: " + line);
      }
  });
  problem->context.warn("export", lines);
}

template void Results<2>::export_meshes(const state::ContactState<2> &);
template void Results<3>::export_meshes(const state::ContactState<3> &);
} // namespace snug::app
