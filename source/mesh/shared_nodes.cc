#include <snug/base/assertions.h>
#include <snug/mesh/shared_nodes.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace snug::mesh {
template <int dim>
void sum_at_shared_nodes(const mesh::BodyMesh<dim> &mesh,
                         unsigned int               n_components,
                         std::vector<double>       &values)
{
  SNUG_ASSERT_EQUAL(values.size(), std::size_t(n_components) * mesh.n_local_nodes());
  const MPI_Comm            comm = mesh.communicator();
  const unsigned int        rank = dealii::Utilities::MPI::this_mpi_process(comm);
  std::vector<unsigned int> own, all;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
      all.push_back(mesh.global_node(node));
      if (mesh.owner(node) == rank)
        own.push_back(all.back());
    }
  const auto       n = dealii::Utilities::MPI::sum<unsigned long>(own.size(), comm);
  dealii::IndexSet owned(n), relevant(n);
  owned.add_indices(own.begin(), own.end());
  relevant.add_indices(all.begin(), all.end());

  // compress() adds in the order of ranks after all messages have arrived, so that the sums are
  // reproducible bit by bit.
  dealii::LinearAlgebra::distributed::Vector<double> sum(owned, relevant, comm);
  for (unsigned int c = 0; c < n_components; ++c)
    {
      sum.zero_out_ghost_values();
      for (unsigned int node = 0; node < all.size(); ++node)
        sum(all[node]) = values[std::size_t(n_components) * node + c];
      sum.compress(dealii::VectorOperation::add);
      sum.update_ghost_values();
      for (unsigned int node = 0; node < all.size(); ++node)
        values[std::size_t(n_components) * node + c] = sum(all[node]);
    }
}

template <int dim>
Field<dim> owners_values(const BodyMesh<dim> &mesh, const Field<dim> &field)
{
  const unsigned int  rank = dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
  std::vector<double> values(static_cast<std::size_t>(dim) * mesh.n_local_nodes(), 0.);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.owner(node) == rank)
      for (unsigned int c = 0; c < dim; ++c)
        values[dim * node + c] = field[node][c];
  sum_at_shared_nodes(mesh, dim, values);
  Field<dim> result(mesh.n_local_nodes());
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      result[node][c] = values[dim * node + c];
  return result;
}

template Field<2> owners_values(const BodyMesh<2> &, const Field<2> &);
template Field<3> owners_values(const BodyMesh<3> &, const Field<3> &);
template void sum_at_shared_nodes(const mesh::BodyMesh<2> &, unsigned int, std::vector<double> &);
template void sum_at_shared_nodes(const mesh::BodyMesh<3> &, unsigned int, std::vector<double> &);
} // namespace snug::mesh
