#include <snug/base/assertions.h>
#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/mesh/lagrange.h>
#include <snug/mesh/surface.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace snug::mesh {
namespace {
/// Number of entries of a face record before the nodes.
template <int dim>
constexpr unsigned int n_leading = 4 + dim;

/// A hanging global node and its masters.
using HangingRecord = std::pair<unsigned int, std::vector<std::pair<unsigned int, double>>>;

template <int dim>
typename Surface<dim>::FaceRecord face_record(const BodyMesh<dim>                &mesh,
                                              const typename BodyMesh<dim>::Face &face)
{
  dealii::Tensor<1, dim> centre;
  for (const unsigned int node : face.nodes)
    centre += mesh.logical_positions()[node] / double(face.nodes.size());
  typename Surface<dim>::FaceRecord record = {face.body, face.boundary};
  for (unsigned int d = 0; d < dim; ++d)
    record.push_back(std::llround(std::ldexp(centre[d], 32)));
  record.push_back(face.known_surface);
  record.push_back(face.samples.empty() ? 0 : 1);
  for (const unsigned int node : face.nodes)
    record.push_back(mesh.global_node(node));
  return record;
}

/// Return the record of a hanging node. Masters are identified by global numbers, because masters
/// may lie on faces of other ranks.
template <int dim>
HangingRecord hanging_record(const BodyMesh<dim> &mesh, unsigned int node)
{
  HangingRecord record(mesh.global_node(node), {});
  for (const auto &master : mesh.hanging()[mesh.hanging_index(node)].masters)
    record.second.emplace_back(mesh.global_node(master.first), master.second);
  return record;
}

/// Return the entries of all ranks, sorted and without duplicates. Collective.
template <typename T>
std::vector<T> gathered(MPI_Comm communicator, const std::vector<T> &mine)
{
  std::vector<T> all;
  for (const auto &part : all_gather(communicator, mine))
    all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Return the global nodes of all records, ascending.
/// @p n_leading is the number of entries of a face record before the nodes.
std::vector<unsigned int> nodes_of(const std::vector<std::vector<long long>> &faces,
                                   const std::vector<HangingRecord>          &hanging,
                                   unsigned int                               n_leading)
{
  std::vector<unsigned int> nodes;
  for (const auto &face : faces)
    nodes.insert(nodes.end(), face.begin() + n_leading, face.end());
  for (const auto &node : hanging)
    for (const auto &master : node.second)
      nodes.push_back(master.first);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}
} // namespace

template <int dim>
Surface<dim>::Surface(const BodyMesh<dim>                                      &mesh,
                      const std::vector<std::pair<unsigned int, unsigned int>> &boundaries)
  : mesh(mesh)
{
  // A face belongs to the rank of its cell, but other ranks may own nodes of the face.
  std::vector<FaceRecord>    faces;
  std::vector<HangingRecord> hanging;
  OwnSamples                 samples;
  for (const auto &face : mesh.boundary_faces())
    if (std::find(boundaries.begin(), boundaries.end(), std::make_pair(face.body, face.boundary)) !=
        boundaries.end())
      {
        faces.push_back(face_record(mesh, face));
        if (!face.samples.empty())
          samples[faces.back()] = &face.samples;
        for (const unsigned int node : face.nodes)
          if (mesh.is_hanging(node))
            hanging.push_back(hanging_record(mesh, node));
      }
  // All ranks have the same lists in the same order, so that the number of a face identifies the
  // face on all ranks.
  faces   = gathered(mesh.communicator(), faces);
  hanging = gathered(mesh.communicator(), hanging);

  // The surface nodes include masters, which need not be nodes of the given faces.
  global_nodes = nodes_of(faces, hanging, n_leading<dim>);
  add_faces(faces, samples);
  node_masters.resize(global_nodes.size());
  for (const auto &record : hanging)
    {
      auto &masters = node_masters[find(record.first)];
      // A node may occur twice if the weights of two ranks differ by round-off.
      masters.clear();
      for (const auto &master : record.second)
        masters.emplace_back(find(master.first), master.second);
    }
  find_owned();
  reference = gather(mesh.reference_positions());
}

/// Samples are numbered in the order of the faces, which is the same on all ranks.
template <int dim>
void Surface<dim>::add_faces(const std::vector<FaceRecord> &records, const OwnSamples &samples)
{
  for (unsigned int body = 0; body < mesh.n_bodies(); ++body)
    known_surfaces.push_back(mesh.geometry(body).known_surfaces());
  const unsigned int samples_per_face = dealii::Utilities::pow(surface_degree + 1, dim - 1);
  points                              = n_nodes();
  for (const auto &record : records)
    {
      Face face{static_cast<unsigned int>(record[0]),
                static_cast<unsigned int>(record[1]),
                {},
                {},
                nullptr};
      if (record[2 + dim] < static_cast<long long>(known_surfaces[face.body].size()))
        face.known = &known_surfaces[face.body][record[2 + dim]];
      for (unsigned int i = n_leading<dim>; i < record.size(); ++i)
        face.nodes.push_back(find(static_cast<unsigned int>(record[i])));
      const auto mine = samples.find(record);
      for (unsigned int k = 0; k < record[3 + dim] * samples_per_face; ++k)
        {
          face.samples.push_back(points++);
          if (mine != samples.end())
            owned_samples.emplace_back(face.samples.back(), (*mine->second)[k]);
        }
      surface_faces.push_back(face);
    }
}

/// Every surface node has one owner, so gather() receives each value once.
template <int dim>
void Surface<dim>::find_owned()
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.owner(node) == rank)
      if (const unsigned int found = find(mesh.global_node(node)); found < n_nodes())
        owned.emplace_back(found, node);
  std::sort(owned.begin(), owned.end());
}

template <int dim>
typename Surface<dim>::Field Surface<dim>::gather(const mesh::Field<dim> &field) const
{
  SNUG_ASSERT(field.size() == mesh.n_points() || field.size() == mesh.n_local_nodes(),
              "the field is one of points or of local nodes");
  // On a rank without samples both sizes are equal, so the ranks with samples decide.
  const bool with_samples =
    n_points() > n_nodes() &&
    dealii::Utilities::MPI::min(int(field.size() == mesh.n_points()), mesh.communicator()) == 1;
  return sum_of_owners(field, with_samples);
}

template <int dim>
typename Surface<dim>::Field Surface<dim>::gather_nodes(const mesh::Field<dim> &field) const
{
  return sum_of_owners(field, false);
}

/// Each point has one owner, and the other ranks add zeros.
template <int dim>
typename Surface<dim>::Field Surface<dim>::sum_of_owners(const mesh::Field<dim> &field,
                                                         const bool              with_samples) const
{
  Field      result(with_samples ? n_points() : n_nodes());
  const auto set = [&](const std::vector<std::pair<unsigned int, unsigned int>> &of_owner) {
    for (const auto &point : of_owner)
      result[point.first] = field[point.second];
  };
  set(owned);
  if (with_samples)
    set(owned_samples);
  static_assert(sizeof(result[0]) == dim * sizeof(double), "a field is sent as numbers");
  MPI_Allreduce(MPI_IN_PLACE, result.data(), narrow<int>(dim * result.size()), MPI_DOUBLE, MPI_SUM,
                mesh.communicator());
  return result;
}

template <int dim>
Surface<dim> Surface<dim>::moved(const std::vector<geometry::RigidMotion<dim>> &motions) const
{
  Surface    result = *this;
  const auto body   = bodies_of_points();
  for (unsigned int point = 0; point < n_points(); ++point)
    result.reference[point] = motions[body[point]].point(reference[point]);
  for (unsigned int b = 0; b < known_surfaces.size(); ++b)
    for (auto &known : result.known_surfaces[b])
      known = known.placed(1., motions[b].Q, motions[b].t);
  for (unsigned int f = 0; f < surface_faces.size(); ++f)
    if (const auto &face = surface_faces[f]; face.known)
      result.surface_faces[f].known =
        &result.known_surfaces[face.body][face.known - known_surfaces[face.body].data()];
  return result;
}

template <int dim>
std::vector<unsigned int> Surface<dim>::bodies_of_points() const
{
  std::vector<unsigned int> result(n_points());
  for (const auto &face : surface_faces)
    {
      for (const unsigned int node : face.nodes)
        {
          result[node] = face.body;
          // The masters of a hanging node need not lie on a face of the surface.
          for (const auto &master : node_masters[node])
            result[master.first] = face.body;
        }
      for (const unsigned int sample : face.samples)
        result[sample] = face.body;
    }
  return result;
}

template <int dim>
std::vector<unsigned int> Surface<dim>::cells_of(const std::vector<unsigned int> &faces) const
{
  // No two faces have the same nodes.
  std::set<std::vector<unsigned int>> wanted;
  for (const unsigned int face : faces)
    {
      std::vector<unsigned int> nodes;
      for (const unsigned int node : surface_faces[face].nodes)
        nodes.push_back(global_nodes[node]);
      wanted.insert(nodes);
    }
  std::vector<unsigned int> cells;
  for (const auto &face : mesh.boundary_faces())
    {
      std::vector<unsigned int> nodes;
      for (const unsigned int node : face.nodes)
        nodes.push_back(mesh.global_node(node));
      if (wanted.count(nodes) > 0)
        cells.push_back(face.cell);
    }
  return cells;
}

template <int dim>
void Surface<dim>::add_owned(const Field &surface_field, mesh::Field<dim> &field) const
{
  // Surface fields are equal on all ranks, so only owners add values.
  for (const auto &node : owned)
    field[node.second] += surface_field[node.first];
  if (surface_field.size() > n_nodes())
    for (const auto &sample : owned_samples)
      field[sample.second] += surface_field[sample.first];
}

template class Surface<2>;
template class Surface<3>;
} // namespace snug::mesh
