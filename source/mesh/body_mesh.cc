#include <snug/base/deal_ii_compat.h>
#include <snug/base/gather.h>
#include <snug/base/run_context.h>
#include <snug/mesh/body_mesh.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/face_nodes.h>
#include <snug/mesh/lagrange.h>
#include <snug/mesh/quadratic_elements.h>

#include <deal.II/base/mpi.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace snug::mesh {
/// The deal.II objects from which the mesh is made. They are destroyed when the mesh is complete.
template <int dim>
struct BodyMesh<dim>::Source
{
  /// Take the cells of the forest as they are, or distribute them to the ranks by parts.
  Source(const Forest<dim>                      &forest,
         unsigned int                            degree,
         const CellsPerSubdomain                &by_size,
         const std::optional<TearingParameters> &tearing)
    : fe(degree)
    , distributed(forest.communicator())
    , is_distributed(tearing || !forest.triangulation())
    , order(dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree))
  {
    const auto &parameters = tearing ? *tearing : TearingParameters();
    if (degree == 2)
      local.elements = QuadraticElements<dim>(forest);
    if (!is_distributed)
      {
        ids.emplace(*forest.triangulation());
        local.geometries = forest.geometries();
      }
    else
      local = distribute(forest, local.elements, parameters, by_size, distributed);
    if (is_distributed)
      nodes.reinit(distributed);
    else
      nodes.reinit(*forest.triangulation());
    nodes.distribute_dofs(fe);
  }

  LocalCells<dim> local; ///< without parts if the cells are not distributed
  // Members are destroyed in reverse order: the nodes before the triangulation and the element.
  dealii::FE_Q<dim>                                      fe;
  dealii::parallel::fullydistributed::Triangulation<dim> distributed;
  bool                                                   is_distributed;
  dealii::DoFHandler<dim>                                nodes;
  std::optional<PlacedIds<dim>>                          ids; ///< if the cells are the forest's
  /// Permutation from tensor-product order to the order of deal.II, which numbers nodes at
  /// vertices, on lines, on faces and inside.
  std::vector<unsigned int> order;

  const dealii::Triangulation<dim> &triangulation() const { return nodes.get_triangulation(); }

  /// Return the id of a cell whose coarse cell is the position in the coarse mesh.
  dealii::CellId id(const dealii::CellId &cell) const { return ids ? ids->of(cell) : cell; }

  /// Return the nodes of a cell as positions in the set of local nodes.
  std::vector<unsigned int>
  nodes_of(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
           const dealii::IndexSet                                       &relevant) const
  {
    std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    std::vector<unsigned int> result;
    for (const unsigned int i : order)
      result.push_back(relevant.index_within_set(indices[i]));
    return result;
  }
};

/// Every rank owns a range of global nodes. The ranges ascend with the rank. Collective.
template <int dim>
void BodyMesh<dim>::number_nodes(const Source &source)
{
  relevant = dealii::DoFTools::extract_locally_relevant_dofs(source.nodes);
  relevant.compress();
  const auto ends =
    all_gather(comm, static_cast<unsigned int>(source.nodes.n_locally_owned_dofs()));
  first_node_of_rank.assign(1, 0);
  for (const unsigned int n : ends)
    first_node_of_rank.push_back(first_node_of_rank.back() + n);
}

/// Positions are evaluated from the geometry at all nodes, including nodes of ghost cells, so that
/// ranks send no positions. If cells differ by round-off, the first cell with the node decides.
/// Hanging nodes get the interpolation of the masters, because the displacement at hanging nodes is
/// interpolated as well. Otherwise rigid motions would cause strains on curved faces.
template <int dim>
void BodyMesh<dim>::collect_nodes(const Source &source)
{
  logical.resize(relevant.n_elements());
  node_body.resize(relevant.n_elements());
  reference.resize(relevant.n_elements());
  std::vector<bool>                            done(relevant.n_elements());
  std::vector<dealii::types::global_dof_index> indices(source.fe.n_dofs_per_cell());
  for (const auto &cell : source.nodes.active_cell_iterators())
    if (!cell->is_artificial())
      {
        const unsigned int body = cell->material_id();
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const unsigned int node = local_node(indices[i]); // of one body
            if (done[node])
              continue;
            done[node]      = true;
            node_body[node] = body;
            if (is_hanging(node))
              continue;
            const auto point = places.point(source.id(cell->id()), source.fe.unit_support_point(i));
            logical[node]    = geometry(body).logical(point);
            reference[node]  = geometry(body).position(point);
          }
      }
  interpolate_hanging(reference);
  for (const auto &[node, masters] : hanging_nodes)
    for (const auto &[master, weight] : masters)
      logical[node] += weight * logical[master];
}

/// close() resolves masters of masters. Collective.
template <int dim>
void BodyMesh<dim>::collect_hanging(const Source &source)
{
  auto constraints = deal_ii_compat::constraints(source.nodes.locally_owned_dofs(), relevant);
  dealii::DoFTools::make_hanging_node_constraints(source.nodes, constraints);
  source.local.elements.constrain(
    source.nodes, [&](const auto &cell) { return source.id(cell); }, source.order, constraints);
  constraints.close();
  // is_hanging() requires that the value of other nodes exceeds all indices.
  hanging_of_node.assign(relevant.n_elements(), static_cast<unsigned int>(-1));
  unsigned long owned_hanging = 0;
  for (unsigned int node = 0; node < relevant.n_elements(); ++node)
    {
      const unsigned int global = relevant.nth_index_in_set(node);
      if (!constraints.is_constrained(global))
        continue;
      // Only the owner counts a node.
      owned_hanging += source.nodes.locally_owned_dofs().is_element(global);
      // The weights are the values of the shape functions of the coarse face at the node.
      Hanging entry{node, {}};
      bool    reachable = true;
      for (const auto &master : *constraints.get_constraint_entries(global))
        if (relevant.is_element(master.first))
          entry.masters.emplace_back(local_node(master.first), master.second);
        else
          reachable = false;
      // Only hanging nodes of ghost cells have masters that are not relevant on this rank.
      if (!reachable)
        continue;
      // The masters are in ascending order, because close() sorts the masters.
      hanging_of_node[node] = hanging_nodes.size();
      hanging_nodes.push_back(entry);
    }
  n_free_nodes = source.nodes.n_dofs() - dealii::Utilities::MPI::sum(owned_hanging, comm);
}

/// Cells are numbered in the order of the owned active cells, as in the list of parts.
template <int dim>
void BodyMesh<dim>::collect_cells(const Source &source)
{
  for (const auto &cell : source.nodes.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const unsigned int   body = cell->material_id();
        const dealii::CellId id   = source.id(cell->id());
        mesh_cells.push_back(
          {body, source.is_distributed ? source.local.parts[mesh_cells.size()] : 0,
           geometry(body).region(places.coarse_cell(id)), source.nodes_of(cell, relevant)});
        cell_ids.push_back(id);
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            // Boundary ids are indices among the boundary names of the body, see CoarseMesh.
            mesh_faces.push_back({body,
                                  cell->face(f)->boundary_id(),
                                  static_cast<unsigned int>(mesh_cells.size() - 1),
                                  f,
                                  oriented_face_nodes<dim>(mesh_cells.back().nodes, fe_degree, f),
                                  geometry(body).known_surface(places.coarse_cell(id), f),
                                  {}});
      }
  if (source.is_distributed)
    neighbours = owned_neighbours(source.triangulation());
}

/// All nodes of ghost cells are relevant, so nodes_of() finds a local index for each node.
template <int dim>
void BodyMesh<dim>::collect_interior_faces(const Source &source)
{
  std::vector<unsigned int> ghosts;
  inner_faces = mesh::interior_faces<dim>(source.triangulation(), ghosts);
  other_cells.resize(ghosts.size());
  std::map<unsigned int, unsigned int> place;
  for (unsigned int i = 0; i < ghosts.size(); ++i)
    place[ghosts[i]] = i;
  for (const auto &cell : source.nodes.active_cell_iterators())
    {
      const auto found = place.find(cell->active_cell_index());
      if (found == place.end())
        continue;
      const unsigned int body    = cell->material_id();
      other_cells[found->second] = {body, 0, geometry(body).region(places.coarse_cell(cell->id())),
                                    source.nodes_of(cell, relevant)};
    }
}

/// The loop visits faces in the same order as collect_cells(). A point of an edge shared by two
/// faces is a separate sample of each face.
template <int dim>
void BodyMesh<dim>::collect_samples(const std::vector<geometry::BodyMeshParameters> &bodies,
                                    const Source                                    &source)
{
  const auto                lattice = lagrange_nodes<dim>(surface_degree);
  std::vector<unsigned int> all(lattice.size());
  std::iota(all.begin(), all.end(), 0u);
  for (const auto &sample : lagrange_nodes<dim - 1>(surface_degree))
    sample_weights.push_back(lagrange_point<dim - 1>(fe_degree, sample.point).value);
  auto face = mesh_faces.begin();
  for (const auto &cell : source.nodes.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            const auto &geometry  = this->geometry(face->body);
            const auto &body      = bodies[face->body];
            const auto &wanted    = body.sampled_boundaries;
            const auto &name      = geometry.boundary_names()[face->boundary];
            const bool  is_wanted = std::find(wanted.begin(), wanted.end(), name) != wanted.end();
            if (is_wanted || body.samples_all_curved)
              {
                const unsigned int first = reference.size();
                for (const unsigned int i : oriented_face_nodes<dim>(all, surface_degree, f))
                  {
                    const auto point = places.point(source.id(cell->id()), lattice[i].point);
                    face->samples.push_back(reference.size());
                    reference.push_back(geometry.position(point));
                    logical.push_back(geometry.logical(point));
                  }
                if (!(is_wanted && body.is_designed) && is_flat(*face))
                  {
                    face->samples.clear();
                    reference.resize(first);
                    logical.resize(first);
                  }
              }
            ++face;
          }
  hanging_of_node.resize(reference.size(), static_cast<unsigned int>(-1));
  node_body.resize(reference.size());
  for (const auto &sampled : mesh_faces)
    for (const unsigned int sample : sampled.samples)
      node_body[sample] = sampled.body;
}

/// Return whether the samples of a face coincide with the interpolation of the face nodes.
template <int dim>
bool BodyMesh<dim>::is_flat(const Face &face) const
{
  const double size = (reference[face.nodes.back()] - reference[face.nodes.front()]).norm();
  for (unsigned int k = 0; k < face.samples.size(); ++k)
    {
      auto offset = reference[face.samples[k]];
      for (unsigned int a = 0; a < face.nodes.size(); ++a)
        offset -= sample_weights[k][a] * reference[face.nodes[a]];
      // The tolerance allows for round-off, also for faces far from the origin.
      if (offset.norm() > 1e-10 * size)
        return false;
    }
  return true;
}

/// Supports and checks require x == 0 exactly on the axis, but a ring has r cos(pi / 2) = 6e-17 r.
template <int dim>
void BodyMesh<dim>::snap_to_axis()
{
  const double round_off = 1e-10;
  double       largest   = 0.;
  for (const auto &x : reference)
    largest = std::max(largest, std::abs(x[0]));
  largest = dealii::Utilities::MPI::max(largest, comm);
  for (auto &x : reference)
    if (std::abs(x[0]) <= round_off * largest)
      x[0] = 0.;
}

template <int dim>
BodyMesh<dim>::BodyMesh(const Forest<dim>                      &forest,
                        unsigned int                            degree,
                        const Idealization                     &idealization,
                        const std::optional<TearingParameters> &tearing)
  : comm(forest.communicator()), fe_degree(degree), meaning(idealization), places(forest.places())
{
  const Source source(forest, degree, cells_per_subdomain(dim, fe_degree, meaning), tearing);
  geometries = source.local.geometries;
  n_cells    = source.triangulation().n_global_active_cells();
  number_nodes(source);
  collect_hanging(source);
  // A formula may fail at a position that only one rank has.
  throw_collectively(comm, [&]() { collect_nodes(source); });
  collect_cells(source);
  if (source.is_distributed)
    collect_interior_faces(source);
  whole_tetrahedra = find_tetrahedra(*this);
  tetrahedron_of_cell.assign(mesh_cells.size(), static_cast<unsigned int>(-1));
  for (unsigned int t = 0; t < whole_tetrahedra.size(); ++t)
    for (const unsigned int cell : whole_tetrahedra[t].cells)
      tetrahedron_of_cell[cell] = t;
  throw_collectively(comm, [&]() { collect_samples(forest.bodies(), source); });
  if (idealization.is_axisymmetric())
    snap_to_axis();
}

template <int dim>
BodyMesh<dim>::BodyMesh(MPI_Comm                                         communicator,
                        const std::vector<geometry::BodyMeshParameters> &bodies,
                        unsigned int                                     degree,
                        const Idealization                              &idealization,
                        const TearingParameters                         &tearing)
  : BodyMesh(Forest<dim>(communicator, bodies), degree, idealization, tearing)
{}

/// upper_bound skips ranks without nodes, whose ranges are empty.
template <int dim>
unsigned int BodyMesh<dim>::owner_of_global(unsigned int global) const
{
  const auto &first = first_node_of_rank;
  return std::upper_bound(first.begin(), first.end(), global) - first.begin() - 1;
}

/// The order of hanging nodes is arbitrary, because masters are never hanging.
template <int dim>
void BodyMesh<dim>::interpolate_hanging(Field &field) const
{
  for (const auto &entry : hanging_nodes)
    {
      dealii::Tensor<1, dim> value;
      for (const auto &master : entry.masters)
        value += master.second * field[master.first];
      field[entry.node] = value;
    }
}

/// Derivatives of a function with respect to a hanging node are passed to the masters of the node.
template <int dim>
void BodyMesh<dim>::distribute_hanging(Field &field) const
{
  for (const auto &entry : hanging_nodes)
    {
      for (const auto &master : entry.masters)
        field[master.first] += master.second * field[entry.node];
      field[entry.node] = 0.;
    }
}

template <int dim>
void BodyMesh<dim>::interpolate_samples(Field &field) const
{
  for (const auto &face : mesh_faces)
    for (unsigned int k = 0; k < face.samples.size(); ++k)
      {
        dealii::Tensor<1, dim> value;
        for (unsigned int a = 0; a < face.nodes.size(); ++a)
          value += sample_weights[k][a] * field[face.nodes[a]];
        field[face.samples[k]] = value;
      }
}

template <int dim>
void BodyMesh<dim>::distribute_samples(Field &field) const
{
  for (const auto &face : mesh_faces)
    for (unsigned int k = 0; k < face.samples.size(); ++k)
      {
        for (unsigned int a = 0; a < face.nodes.size(); ++a)
          field[face.nodes[a]] += sample_weights[k][a] * field[face.samples[k]];
        field[face.samples[k]] = 0.;
      }
}

template class BodyMesh<2>;
template class BodyMesh<3>;
} // namespace snug::mesh
