#include <snug/mesh/partition.h>
#include <snug/mesh/tearing.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace snug
{
  namespace mesh
  {
    namespace
    {
      template <int dim>
      CellGraph
      cell_graph(const BodyMesh<dim>             &mesh,
                 const std::vector<unsigned int> &cells)
      {
        std::map<unsigned int, unsigned int> position;
        for (unsigned int i = 0; i < cells.size(); ++i)
          position[cells[i]] = i;
        CellGraph graph(cells.size());
        for (const auto &pair : mesh.cell_neighbours())
          {
            const auto a = position.find(pair.first);
            const auto b = position.find(pair.second);
            if (a == position.end() || b == position.end())
              continue;
            graph[a->second].push_back(b->second);
            graph[b->second].push_back(a->second);
          }
        return graph;
      }

      /// Split every part into its face-connected pieces, numbered by their
      /// first cell.
      unsigned int
      split_into_pieces(const CellGraph &graph, std::vector<unsigned int> &part)
      {
        const unsigned int        none = static_cast<unsigned int>(-1);
        std::vector<unsigned int> piece(graph.size(), none);
        unsigned int              n_pieces = 0;
        for (unsigned int seed = 0; seed < graph.size(); ++seed)
          if (piece[seed] == none)
            {
              std::vector<unsigned int> front(1, seed);
              piece[seed] = n_pieces;
              while (!front.empty())
                {
                  const unsigned int cell = front.back();
                  front.pop_back();
                  for (const unsigned int next : graph[cell])
                    if (piece[next] == none && part[next] == part[seed])
                      {
                        piece[next] = n_pieces;
                        front.push_back(next);
                      }
                }
              ++n_pieces;
            }
        part = piece;
        return n_pieces;
      }

      /// Give pieces below a quarter of the mean size to the neighbour they
      /// share most faces with; pieces without neighbours stay.
      unsigned int
      merge_slivers(const CellGraph           &graph,
                    std::vector<unsigned int> &part,
                    unsigned int               n_parts,
                    double                     cells_each)
      {
        for (unsigned int sliver = 0; sliver < n_parts; ++sliver)
          {
            std::map<unsigned int, unsigned int> shared;
            unsigned int                         size = 0;
            for (unsigned int i = 0; i < graph.size(); ++i)
              if (part[i] == sliver)
                {
                  ++size;
                  for (const unsigned int j : graph[i])
                    if (part[j] != sliver)
                      ++shared[part[j]];
                }
            if (size >= 0.25 * cells_each || shared.empty())
              continue;
            const auto best =
              std::max_element(shared.begin(),
                               shared.end(),
                               [](const auto &a, const auto &b) {
                                 return a.second < b.second;
                               });
            for (unsigned int &p : part)
              if (p == sliver)
                p = best->first;
          }
        return split_into_pieces(graph, part);
      }

      template <int dim>
      std::vector<unsigned int>
      reached_nodes(const BodyMesh<dim>             &mesh,
                    const std::vector<unsigned int> &cells)
      {
        std::vector<unsigned int> nodes;
        for (const unsigned int cell : cells)
          for (const unsigned int node : mesh.cells()[cell].nodes)
            if (mesh.is_hanging(node))
              for (const auto &master :
                   mesh.hanging()[mesh.hanging_index(node)].masters)
                nodes.push_back(master.first);
            else
              nodes.push_back(node);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
      }

      /// Size of a body's box at the reference positions. Collective.
      template <int dim>
      dealii::Tensor<1, dim>
      body_size(const BodyMesh<dim> &mesh, unsigned int body)
      {
        std::vector<double> ends(2 * dim, -std::numeric_limits<double>::max());
        for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
          if (mesh.body_of_node(node) == body)
            for (unsigned int c = 0; c < dim; ++c)
              {
                const double x = mesh.reference_positions()[node][c];
                ends[c]        = std::max(ends[c], x);
                ends[dim + c]  = std::max(ends[dim + c], -x);
              }
        dealii::Utilities::MPI::max(ends, mesh.communicator(), ends);
        dealii::Tensor<1, dim> size;
        for (unsigned int c = 0; c < dim; ++c)
          size[c] = ends[c] + ends[dim + c];
        return size;
      }

      template <int dim>
      CellSet<dim>
      cell_set(const BodyMesh<dim>             &mesh,
               const std::vector<unsigned int> &cells,
               unsigned int                     body)
      {
        CellSet<dim> set;
        set.communicator = mesh.communicator();
        set.graph        = cell_graph(mesh, cells);
        for (const unsigned int cell : cells)
          {
            const auto &nodes = mesh.cells()[cell].nodes;
            set.centres.emplace_back((mesh.logical_positions()[nodes.front()] +
                                      mesh.logical_positions()[nodes.back()]) /
                                     2.);
          }
        set.n_global =
          dealii::Utilities::MPI::sum<unsigned long>(cells.size(),
                                                     mesh.communicator());
        set.size = body_size(mesh, body);
        return set;
      }

      /// Cells of a subdomain that keep factorizations and coarse problem in
      /// balance: 5 Q1 cells per edge in 3D, 12 in 2D; fewer cells of higher
      /// degree, by their nodes.
      template <int dim>
      double
      cells_per_subdomain(unsigned int degree)
      {
        return std::pow((dim == 3 ? 5. : 12.) / degree, dim);
      }
    } // namespace

    template <int dim>
    Tearing
    tear(const BodyMesh<dim> &mesh, const TearingParameters &parameters)
    {
      const double cells_each =
        parameters.subdomains == 0
          ? cells_per_subdomain<dim>(mesh.degree())
          : double(mesh.n_global_cells()) / parameters.subdomains;
      const auto &partition =
        choose(partition_table<dim>(), parameters.method).make;
      Tearing tearing;
      for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
        {
          std::vector<unsigned int> cells;
          for (unsigned int cell = 0; cell < mesh.cells().size(); ++cell)
            if (mesh.cells()[cell].body == body)
              cells.push_back(cell);
          const CellSet<dim>        set  = cell_set(mesh, cells, body);
          std::vector<unsigned int> part = partition(set, cells_each);
          unsigned int n_parts           = split_into_pieces(set.graph, part);
          n_parts = merge_slivers(set.graph, part, n_parts, cells_each);
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
      const auto counts =
        dealii::Utilities::MPI::all_gather(mesh.communicator(),
                                           static_cast<unsigned int>(
                                             tearing.subdomains.size()));
      tearing.first_id_of_rank.assign(1, 0);
      for (const unsigned int count : counts)
        tearing.first_id_of_rank.push_back(tearing.first_id_of_rank.back() +
                                           count);
      tearing.n_global = tearing.first_id_of_rank.back();
      tearing.first_id =
        tearing.first_id_of_rank[dealii::Utilities::MPI::this_mpi_process(
          mesh.communicator())];
      return tearing;
    }

    template Tearing
    tear(const BodyMesh<2> &, const TearingParameters &);
    template Tearing
    tear(const BodyMesh<3> &, const TearingParameters &);
  } // namespace mesh
} // namespace snug
