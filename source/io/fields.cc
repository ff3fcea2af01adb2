#include <snug/base/run_context.h>
#include <snug/elasticity/stress.h>
#include <snug/io/fields.h>
#include <snug/io/nodal_stress.h>
#include <snug/io/patch_list.h>
#include <snug/io/text_file.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/mpi.h>

namespace snug::io {
namespace {
/// Shares of a node gradient summed over ranks, those of hanging nodes
/// given to their masters: zero where it is null. Collective.
/// Shares live where their cells are; a picture needs the sum at every node.
template <int dim>
std::vector<double> summed(const mesh::BodyMesh<dim>                 &mesh,
                           const typename mesh::BodyMesh<dim>::Field *gradient)
{
  std::vector<double> values(dim * mesh.n_local_nodes());
  // null on all ranks or on none, since the sum below is collective
  if (gradient == nullptr)
    return values;
  auto field = *gradient;
  // samples and hanging nodes follow the nodes of their faces and their masters
  mesh.distribute_samples(field);
  mesh.distribute_hanging(field);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      values[dim * node + c] = field[node][c];
  mesh::sum_at_shared_nodes(mesh, dim, values);
  return values;
}

/// The components of all quantities of FieldOutput at one node.
/// In the order of the quantities in write(). Stresses of sections too have 3 x 3 components.
template <int dim>
std::vector<double> field_values(const state::ContactState<dim>      &state,
                                 const dealii::SymmetricTensor<2, 3> &stress,
                                 const dealii::Tensor<1, dim>        &design_displacement,
                                 unsigned int                         node,
                                 const std::vector<double>           &cell_values)
{
  std::vector<double> values;
  for (unsigned int c = 0; c < dim; ++c)
    values.push_back(state.displacement[node][c]);
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      values.push_back(stress[i][j]);
  // of the smoothed stress, not the mean of the cells' own
  values.push_back(elasticity::von_mises(stress));
  values.insert(values.end(), cell_values.begin(), cell_values.end());
  for (unsigned int c = 0; c < dim; ++c)
    values.push_back(design_displacement[c]);
  return values;
}

/// Global ids, so that subdomains of different ranks get different colours.
template <int dim>
std::vector<unsigned int> subdomain_of_cell(const mesh::BodyMesh<dim> &mesh,
                                            const mesh::Tearing       &tearing)
{
  std::vector<unsigned int> result(mesh.cells().size());
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    for (const unsigned int cell : tearing.subdomains[s].cells)
      result[cell] = tearing.first_id + s;
  return result;
}
} // namespace

template <int dim>
void FieldOutput<dim>::write(const Sources                             &of,
                             double                                     time,
                             const state::ContactState<dim>            &state,
                             const typename mesh::BodyMesh<dim>::Field *shape_gradient,
                             const std::vector<double>                 *errors)
{
  const auto           &mesh      = of.mesh;
  const auto            subdomain = subdomain_of_cell(mesh, of.tearing);
  const auto            gradient  = summed(mesh, shape_gradient);
  const auto            stress = nodal_stress(mesh, of.bodies, state.positions, state.displacement);
  const unsigned int    n_regions = n_stress_regions(mesh);
  std::vector<Quantity> quantities{{"displacement", dim},
                                   {"stress", 9},
                                   {"von_mises", 1},
                                   {"body", 1},
                                   {"region", 1},
                                   {"subdomain", 1},
                                   {"design_displacement", dim}};
  if (shape_gradient != nullptr)
    quantities.push_back({"shape_gradient", dim});
  if (errors != nullptr)
    quantities.push_back({"error", 1});
  PatchList<dim, dim> patches(quantities);
  for (unsigned int k = 0; k < mesh.cells().size(); ++k)
    {
      const auto                         &cell = mesh.cells()[k];
      std::vector<dealii::Tensor<1, dim>> points;
      std::vector<std::vector<double>>    values;
      for (const unsigned int node : cell.nodes)
        {
          // on the design, before deformation
          points.push_back(state.positions[node]);
          values.push_back(
            field_values(state, stress[node * n_regions + cell.region],
                         state.positions[node] - mesh.reference_positions()[node], node,
                         {double(cell.body), double(cell.region), double(subdomain[k])}));
          if (shape_gradient != nullptr)
            values.back().insert(values.back().end(), gradient.begin() + dim * node,
                                 gradient.begin() + dim * (node + 1));
          if (errors != nullptr)
            values.back().push_back((*errors)[k]);
        }
      patches.add(points, values);
    }

  const MPI_Comm           comm = mesh.communicator();
  const auto               rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const std::string        stem = "solution-" + padded(series.size(), 4);
  std::vector<std::string> pieces;
  for (unsigned int r = 0; r < dealii::Utilities::MPI::n_mpi_processes(comm); ++r)
    // the .pvtu names the files of all ranks
    pieces.push_back(stem + "." + padded(r, 4) + ".vtu");
  series.emplace_back(time, stem + ".pvtu");
  everywhere(comm, [&] {
    write_text_file(directory + "/" + pieces[rank], patches.vtu());
    if (rank != 0)
      return;
    write_text_file(directory + "/" + stem + ".pvtu", patches.pvtu(pieces));
    write_text_file(directory + "/solution.pvd", pvd(series));
  });
}

template class FieldOutput<2>;
template class FieldOutput<3>;
} // namespace snug::io
