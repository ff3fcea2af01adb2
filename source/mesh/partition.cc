#include <snug/mesh/partition.h>

namespace snug::mesh {
template <int dim>
const ChoiceTable<Partition(const CellSet<dim> &, double)> &partition_table()
{
  // the texts are those of the parameter reference
  static const ChoiceTable<Partition(const CellSet<dim> &, double)> table = {
    {"auto",
     "grid for boxes and rings that are not refined locally, METIS for "
     "others",
     [](const CellSet<dim> &set, double cells_each) {
       // see partition_table() in the header for what ragged parts cost
       return set.layered ? grid_partition(set, cells_each) : graph_partition(set, cells_each);
     }},
    {"grid",
     "a grid of slabs along the axes, cut between layers of cells; near "
     "cubes, which need fewest iterations",
     grid_partition<dim>},
    {"METIS",
     "parts of the cell graph with few shared faces, for meshes without "
     "layers",
     graph_partition<dim>}};
  return table;
}

template const ChoiceTable<Partition(const CellSet<2> &, double)> &partition_table<2>();
template const ChoiceTable<Partition(const CellSet<3> &, double)> &partition_table<3>();
} // namespace snug::mesh
