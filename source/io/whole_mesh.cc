#include <snug/base/gather.h>
#include <snug/io/whole_mesh.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace snug::io {
namespace {
using Integers = std::vector<unsigned int>;

/// Return the entries of all ranks on rank 0, one list after the other.
template <typename T>
std::vector<T> gathered(const std::vector<T> &mine, MPI_Comm communicator)
{
  std::vector<T> all;
  for (const auto &of_rank : gather(communicator, mine, 0))
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  return all;
}

/// A cell as integers: body, cell id, region, global nodes, and the faces {boundary, number, global
/// nodes}. The integers sort cells by body and id.
template <int dim>
std::vector<Integers> cell_records(const mesh::BodyMesh<dim> &mesh)
{
  std::vector<Integers> records;
  for (unsigned int c = 0; c < mesh.cells().size(); ++c)
    {
      const auto &cell = mesh.cells()[c];
      Integers    record{cell.body};
      for (const unsigned int word : mesh.cell_id(c).template to_binary<dim>())
        record.push_back(word);
      record.push_back(cell.region);
      for (const unsigned int node : cell.nodes)
        record.push_back(mesh.global_node(node));
      records.push_back(record);
    }
  for (const auto &face : mesh.boundary_faces())
    {
      auto &record = records[face.cell];
      record.push_back(face.boundary);
      record.push_back(face.number);
      for (const unsigned int node : face.nodes)
        record.push_back(mesh.global_node(node));
    }
  return records;
}

/// This class reads the integers of a record one by one.
class RecordReader
{
public:
  explicit RecordReader(const Integers &record) : record(record) {}

  bool         at_end() const { return place == record.size(); }
  unsigned int next() { return record[place++]; }

  Integers next(const unsigned int n)
  {
    place += n;
    return {record.begin() + (place - n), record.begin() + place};
  }

private:
  const Integers &record;
  std::size_t     place = 0;
};

template <int dim>
void add_cells(const std::vector<Integers> &records,
               const unsigned int           degree,
               WholeMesh<dim>              &whole)
{
  const unsigned int none = -1, id_length = 4;
  const unsigned int on_face  = dim == 2 ? degree + 1 : (degree + 1) * (degree + 1);
  const auto         renumber = [&](Integers nodes) {
    for (unsigned int &node : nodes)
      {
        if (whole.number_of[node] == none)
          whole.number_of[node] = whole.positions.size();
        if (whole.number_of[node] == whole.positions.size())
          whole.positions.emplace_back();
        node = whole.number_of[node];
      }
    return nodes;
  };
  for (const auto &integers : records)
    {
      RecordReader       record(integers);
      const unsigned int body = record.next();
      record.next(id_length);
      const unsigned int region = record.next();
      whole.regions[body].insert(region);
      whole.cells.push_back({body, region, renumber(record.next(on_face * (degree + 1)))});
      while (!record.at_end())
        {
          const unsigned int boundary = record.next(), number = record.next();
          whole.faces.push_back({body, boundary, static_cast<unsigned int>(whole.cells.size() - 1),
                                 number, renumber(record.next(on_face))});
        }
    }
}
} // namespace

template <int dim>
WholeMesh<dim> gather_mesh(const mesh::BodyMesh<dim>                 &mesh,
                           const typename mesh::BodyMesh<dim>::Field &positions,
                           const typename mesh::BodyMesh<dim>::Field &forces)
{
  const auto                communicator = mesh.communicator();
  const unsigned int        rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
  std::vector<unsigned int> own_nodes;
  std::vector<double>       own_values;
  std::vector<std::vector<std::pair<unsigned int, double>>> own_hanging;
  unsigned int                                              n_nodes = 0;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
      n_nodes = std::max(n_nodes, mesh.global_node(node) + 1);
      if (mesh.owner(node) != rank)
        continue;
      own_nodes.push_back(mesh.global_node(node));
      for (unsigned int c = 0; c < dim; ++c)
        own_values.insert(own_values.end(),
                          {positions[node][c], forces.empty() ? 0. : forces[node][c]});
      if (mesh.is_hanging(node))
        {
          own_hanging.push_back({{mesh.global_node(node), 1.}});
          for (const auto &[master, weight] : mesh.hanging()[mesh.hanging_index(node)].masters)
            own_hanging.back().emplace_back(mesh.global_node(master), weight);
        }
    }
  n_nodes                = dealii::Utilities::MPI::max(n_nodes, communicator);
  auto           records = gathered(cell_records(mesh), communicator);
  const auto     nodes   = gathered(own_nodes, communicator);
  const auto     values  = gathered(own_values, communicator);
  const auto     hanging = gathered(own_hanging, communicator);
  WholeMesh<dim> whole;
  if (rank != 0)
    return whole;
  whole.number_of.assign(n_nodes, static_cast<unsigned int>(-1));
  std::sort(records.begin(), records.end());
  add_cells(records, mesh.degree(), whole);
  whole.forces.resize(whole.positions.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const unsigned int node  = whole.number_of[nodes[i]];
        whole.positions[node][c] = values[2 * (dim * i + c)];
        whole.forces[node][c]    = values[2 * (dim * i + c) + 1];
      }
  for (const auto &entry : hanging)
    {
      whole.hanging.push_back({whole.number_of[entry[0].first], {}});
      for (std::size_t m = 1; m < entry.size(); ++m)
        whole.hanging.back().masters.emplace_back(whole.number_of[entry[m].first], entry[m].second);
    }
  return whole;
}

template struct WholeMesh<2>;
template struct WholeMesh<3>;
template WholeMesh<2> gather_mesh(const mesh::BodyMesh<2> &,
                                  const mesh::BodyMesh<2>::Field &,
                                  const mesh::BodyMesh<2>::Field &);
template WholeMesh<3> gather_mesh(const mesh::BodyMesh<3> &,
                                  const mesh::BodyMesh<3>::Field &,
                                  const mesh::BodyMesh<3>::Field &);
} // namespace snug::io
