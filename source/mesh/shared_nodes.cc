#include <snug/mesh/shared_nodes.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace snug::mesh {
namespace {
/// Values of some nodes on their way between a rank and an owner.
struct NodeValues
{
  std::vector<unsigned int> nodes; ///< global
  std::vector<double>       values;

  template <typename Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &nodes &values;
  }
};
} // namespace

template <int dim>
void sum_at_shared_nodes(const mesh::BodyMesh<dim> &mesh,
                         unsigned int               n_components,
                         std::vector<double>       &values)
{
  AssertDimension(values.size(), std::size_t(n_components) * mesh.n_local_nodes());
  const MPI_Comm     comm = mesh.communicator();
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
  const auto         at   = [&](unsigned int node) {
    return values.begin() + std::size_t(n_components) * node;
  };

  std::map<unsigned int, NodeValues> to_owner;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.owner(node) != rank)
      {
        NodeValues &message = to_owner[mesh.owner(node)];
        message.nodes.push_back(mesh.global_node(node));
        message.values.insert(message.values.end(), at(node), at(node) + n_components);
      }

  auto to_sharer = dealii::Utilities::MPI::some_to_some(comm, to_owner);
  for (const auto &message : to_sharer)
    for (unsigned int i = 0; i < message.second.nodes.size(); ++i)
      {
        const auto sum = at(mesh.local_node(message.second.nodes[i]));
        for (unsigned int c = 0; c < n_components; ++c)
          sum[c] += message.second.values[i * n_components + c];
      }
  for (auto &message : to_sharer)
    for (unsigned int i = 0; i < message.second.nodes.size(); ++i)
      std::copy_n(at(mesh.local_node(message.second.nodes[i])), n_components,
                  message.second.values.begin() + i * n_components);

  for (const auto &message : dealii::Utilities::MPI::some_to_some(comm, to_sharer))
    for (unsigned int i = 0; i < message.second.nodes.size(); ++i)
      std::copy_n(message.second.values.begin() + i * n_components, n_components,
                  at(mesh.local_node(message.second.nodes[i])));
}

template void sum_at_shared_nodes(const mesh::BodyMesh<2> &, unsigned int, std::vector<double> &);
template void sum_at_shared_nodes(const mesh::BodyMesh<3> &, unsigned int, std::vector<double> &);
} // namespace snug::mesh
