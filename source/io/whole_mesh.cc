#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/base/rank_order.h>
#include <snug/base/run_context.h>
#include <snug/io/whole_mesh.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

namespace snug::io {
namespace {
using Integers = std::vector<unsigned int>;

/// Return the entries of all ranks on rank 0, one list after the other. Rank 0 keeps them once. Not
/// for pointers. Collective.
template <typename T>
std::vector<T> gathered(const std::vector<T> &mine, MPI_Comm communicator)
{
  static_assert(std::is_trivially_copyable_v<T>, "entries are sent as bytes");
  const auto     n = dealii::Utilities::MPI::sum<unsigned long>(mine.size(), communicator);
  std::string    bytes;
  std::vector<T> all;
  throw_collectively(communicator, [&] {
    bytes.assign(reinterpret_cast<const char *>(mine.data()), mine.size() * sizeof(T));
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      all.resize(n);
  });
  std::size_t place = 0;
  collect_in_order(communicator, bytes, [&](const std::string &of_rank) {
    std::memcpy(&all[place], of_rank.data(), of_rank.size());
    place += of_rank.size() / sizeof(T);
  });
  return all;
}

/// Number of integers that sort cells: body and cell id.
const std::size_t key_length = 5;

/// Return the cells as integers: their number, body, cell id, region, global nodes, and if
/// @p with_faces the faces {boundary, number, global nodes}.
template <int dim>
Integers cell_records(const mesh::BodyMesh<dim> &mesh, const bool with_faces)
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
      if (!with_faces)
        break;
      auto &record = records[face.cell];
      record.push_back(face.boundary);
      record.push_back(face.number);
      for (const unsigned int node : face.nodes)
        record.push_back(mesh.global_node(node));
    }
  Integers flat;
  for (const auto &record : records)
    {
      flat.push_back(narrow<unsigned int>(record.size()));
      flat.insert(flat.end(), record.begin(), record.end());
    }
  return flat;
}

/// Return the places of the records, sorted by body and cell id.
std::vector<std::size_t> sorted_records(const Integers &records)
{
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place < records.size(); place += 1 + records[place])
    places.push_back(place);
  const auto key = [&](const std::size_t place) { return records.begin() + (place + 1); };
  std::sort(places.begin(), places.end(), [&](const std::size_t a, const std::size_t b) {
    return std::lexicographical_compare(key(a), key(a) + key_length, key(b), key(b) + key_length);
  });
  return places;
}

/// This class reads the integers of a record one by one.
class RecordReader
{
public:
  RecordReader(const Integers &records, const std::size_t first)
    : place(records.begin() + (first + 1)), end(place + records[first])
  {}

  bool         at_end() const { return place == end; }
  unsigned int next() { return *place++; }

  Integers next(const unsigned int n)
  {
    place += n;
    return {place - n, place};
  }

private:
  Integers::const_iterator place, end;
};

/// This class numbers nodes in the order in which they are first seen.
class NodeNumbers
{
public:
  explicit NodeNumbers(const unsigned int n_nodes) : of(n_nodes, static_cast<unsigned int>(-1)) {}

  /// Replace global nodes by their numbers.
  void renumber(Integers &nodes)
  {
    for (unsigned int &node : nodes)
      {
        if (of[node] == static_cast<unsigned int>(-1))
          of[node] = n_seen++;
        node = of[node];
      }
  }

  Integers     of; ///< global node -> number
  unsigned int n_seen = 0;
};

template <int dim>
void add_cells(const Integers &records, const unsigned int degree, WholeMesh<dim> &whole)
{
  const unsigned int id_length = key_length - 1;
  const unsigned int on_face   = dim == 2 ? degree + 1 : (degree + 1) * (degree + 1);
  NodeNumbers        numbers(narrow<unsigned int>(whole.number_of.size()));
  const auto         renumbered = [&](Integers nodes) {
    numbers.renumber(nodes);
    return nodes;
  };
  for (const std::size_t place : sorted_records(records))
    {
      RecordReader       record(records, place);
      const unsigned int body = record.next();
      record.next(id_length);
      const unsigned int region = record.next();
      whole.regions[body].insert(region);
      whole.cells.push_back({body, region, renumbered(record.next(on_face * (degree + 1)))});
      while (!record.at_end())
        {
          const unsigned int boundary = record.next(), number = record.next();
          whole.faces.push_back({body, boundary, static_cast<unsigned int>(whole.cells.size() - 1),
                                 number, renumbered(record.next(on_face))});
        }
    }
  whole.number_of = numbers.of;
  whole.positions.resize(numbers.n_seen);
}

/// Return the number of nodes of all ranks. Collective.
template <int dim>
unsigned int n_global_nodes(const mesh::BodyMesh<dim> &mesh)
{
  unsigned int n_nodes = 0;
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    n_nodes = std::max(n_nodes, mesh.global_node(node) + 1);
  return dealii::Utilities::MPI::max(n_nodes, mesh.communicator());
}
} // namespace

template <int dim>
std::vector<unsigned int> gather_node_numbers(const mesh::BodyMesh<dim> &mesh)
{
  const unsigned int n_nodes = n_global_nodes(mesh);
  const auto         records = gathered(cell_records(mesh, false), mesh.communicator());
  if (records.empty()) // not rank 0
    return {};
  NodeNumbers numbers(n_nodes);
  for (const std::size_t place : sorted_records(records))
    {
      RecordReader record(records, place);
      record.next(key_length + 1); // and the region
      auto nodes = record.next(records[place] - key_length - 1);
      numbers.renumber(nodes);
    }
  return numbers.of;
}

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
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    {
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
  const auto     n_nodes = n_global_nodes(mesh);
  const auto     records = gathered(cell_records(mesh, true), communicator);
  const auto     nodes   = gathered(own_nodes, communicator);
  const auto     values  = gathered(own_values, communicator);
  const auto     hanging = gather(communicator, own_hanging);
  WholeMesh<dim> whole;
  if (rank != 0)
    return whole;
  whole.number_of.resize(n_nodes);
  add_cells(records, mesh.degree(), whole);
  whole.forces.resize(whole.positions.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const unsigned int node  = whole.number_of[nodes[i]];
        whole.positions[node][c] = values[2 * (dim * i + c)];
        whole.forces[node][c]    = values[2 * (dim * i + c) + 1];
      }
  for (const auto &of_rank : hanging)
    for (const auto &entry : of_rank)
      {
        whole.hanging.push_back({whole.number_of[entry[0].first], {}});
        for (std::size_t m = 1; m < entry.size(); ++m)
          whole.hanging.back().masters.emplace_back(whole.number_of[entry[m].first],
                                                    entry[m].second);
      }
  return whole;
}

template struct WholeMesh<2>;
template struct WholeMesh<3>;
template std::vector<unsigned int> gather_node_numbers(const mesh::BodyMesh<2> &);
template std::vector<unsigned int> gather_node_numbers(const mesh::BodyMesh<3> &);
template WholeMesh<2>              gather_mesh(const mesh::BodyMesh<2> &,
                                               const mesh::BodyMesh<2>::Field &,
                                               const mesh::BodyMesh<2>::Field &);
template WholeMesh<3>              gather_mesh(const mesh::BodyMesh<3> &,
                                               const mesh::BodyMesh<3>::Field &,
                                               const mesh::BodyMesh<3>::Field &);
} // namespace snug::io
