#include <snug/mesh/grid_partition.h>

namespace snug::mesh {
const ChoiceTable<bool(bool)> &partition_table()
{
  // The parameter reference prints the texts of this table.
  static const ChoiceTable<bool(bool)> table = {
    {"auto", "grid for boxes and rings without local refinement, METIS for others",
     // partition_table() in the header states the cost of ragged parts.
     [](const bool layered) { return layered; }},
    {"grid",
     "grid of nearly cubic subdomains with cuts between layers of cells, which needs the fewest "
     "iterations",
     [](bool) { return true; }},
    {"METIS", "partition of the cell graph with few shared faces, for meshes without layers",
     [](bool) { return false; }}};
  return table;
}

template <int dim>
std::vector<Partition> partitions(const std::string               &method,
                                  const std::vector<CellSet<dim>> &bodies,
                                  const std::vector<double>       &cells_each)
{
  const auto                       &by_grid = choose(partition_table(), method).make;
  std::vector<Partition>            result(bodies.size());
  std::vector<unsigned int>         others;
  std::vector<const CellSet<dim> *> graphs;
  std::vector<double>               cells_of_graphs;
  for (unsigned int body = 0; body < bodies.size(); ++body)
    if (by_grid(bodies[body].layered))
      result[body] = grid_partition(bodies[body], cells_each[body]);
    else
      {
        others.push_back(body);
        graphs.push_back(&bodies[body]);
        cells_of_graphs.push_back(cells_each[body]);
      }
  const auto of_graphs = graph_partitions(graphs, cells_of_graphs);
  for (unsigned int i = 0; i < others.size(); ++i)
    result[others[i]] = of_graphs[i];
  return result;
}

template std::vector<Partition>
partitions(const std::string &, const std::vector<CellSet<2>> &, const std::vector<double> &);
template std::vector<Partition>
partitions(const std::string &, const std::vector<CellSet<3>> &, const std::vector<double> &);
} // namespace snug::mesh
