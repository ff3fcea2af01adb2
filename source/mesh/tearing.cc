#include <snug/base/gather.h>
#include <snug/mesh/node_reach.h>
#include <snug/mesh/tearing.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::mesh {
namespace {
/// Return the nodes on whose unknowns the cells depend, with masters instead of hanging nodes.
template <int dim>
std::vector<unsigned int> reached_nodes(const BodyMesh<dim>             &mesh,
                                        const std::vector<unsigned int> &cells)
{
  std::vector<unsigned int> nodes;
  for (const unsigned int cell : cells)
    {
      const NodeReach<dim> reach = NodeReach<dim>::of_cell(mesh, cell, {});
      nodes.insert(nodes.end(), reach.slots().begin(), reach.slots().end());
    }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}
} // namespace

/// Subdomains must be face-connected. Pieces joined only at a node or an edge could rotate relative
/// to each other, and the kernel of the stiffness matrix would be larger than the rigid motions,
/// which are the kernel given to FETI.
template <int dim>
Tearing tear(const BodyMesh<dim> &mesh, const unsigned int cluster_edge)
{
  Tearing tearing;
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    {
      std::vector<unsigned int> cells, part;
      for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
        if (mesh.cells()[cell].body == body)
          {
            cells.push_back(cell);
            part.push_back(mesh.cells()[cell].part);
          }
      const unsigned int n_parts =
        split_into_pieces(cell_graph(cells, mesh.cell_neighbours()), part);
      std::vector<Subdomain> pieces(n_parts);
      for (unsigned int i = 0; i < cells.size(); ++i)
        pieces[part[i]].cells.push_back(cells[i]);
      for (auto &piece : pieces)
        {
          piece.body  = body;
          piece.nodes = reached_nodes(mesh, piece.cells);
          tearing.subdomains.push_back(piece);
        }
    }
  // Ids ascend with the rank, and on a rank with the body and the first cell of the piece.
  const auto counts =
    all_gather(mesh.communicator(), static_cast<unsigned int>(tearing.subdomains.size()));
  tearing.first_id_of_rank.assign(1, 0);
  for (const unsigned int count : counts)
    tearing.first_id_of_rank.push_back(tearing.first_id_of_rank.back() + count);
  tearing.n_global = tearing.first_id_of_rank.back();
  tearing.first_id =
    tearing.first_id_of_rank[dealii::Utilities::MPI::this_mpi_process(mesh.communicator())];
  tearing.clusters = find_clusters(mesh, tearing, cluster_edge);
  return tearing;
}

template Tearing tear(const BodyMesh<2> &, unsigned int);
template Tearing tear(const BodyMesh<3> &, unsigned int);
} // namespace snug::mesh
