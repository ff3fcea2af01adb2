#include <snug/base/deal_ii_compat.h>
#include <snug/base/run_context.h>
#include <snug/mesh/body_mesh.h>
#include <snug/mesh/cell_graph.h>
#include <snug/mesh/distribute.h>
#include <snug/mesh/face_nodes.h>

#include <deal.II/base/mpi.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh {
template <int dim>
struct BodyMesh<dim>::Data
{
  Data(MPI_Comm communicator, unsigned int degree, const Idealization &idealization)
    : comm(communicator)
    , degree(degree)
    , idealization(idealization)
    , fe(degree)
    , triangulation(communicator)
    , nodes(triangulation)
  {}

  MPI_Comm     comm;
  unsigned int degree;
  Idealization idealization;
  // Destroyed from the bottom up: the nodes must go before the triangulation and the element.
  dealii::FE_Q<dim>                                         fe;
  std::vector<std::unique_ptr<geometry::BodyGeometry<dim>>> geometries;
  dealii::parallel::fullydistributed::Triangulation<dim>    triangulation;
  dealii::DoFHandler<dim>                                   nodes;

  // Owned and ghost nodes: a local index is the place of a node in this set.
  dealii::IndexSet          relevant;
  std::vector<unsigned int> first_node_of_rank; ///< n_ranks + 1
  // per local node
  std::vector<unsigned int>                          node_body;
  std::vector<dealii::Point<dim>>                    logical;
  Field                                              reference;
  geometry::CoarseCells<dim>                         coarse;
  std::vector<unsigned int>                          parts; ///< of cells
  std::vector<Cell>                                  cells;
  std::vector<Face>                                  faces;
  std::vector<Hanging>                               hanging;
  std::vector<unsigned int>                          hanging_of_node; ///< or n_hanging
  std::vector<std::pair<unsigned int, unsigned int>> neighbours;
  unsigned long                                      n_free_nodes = 0;

  unsigned int local(unsigned int global) const { return relevant.index_within_set(global); }

  void triangulate(const std::vector<geometry::BodyMeshParameters> &bodies,
                   const TearingParameters                         &tearing);
  void number_nodes();
  void collect_nodes();
  void collect_hanging();
  void collect_cells();
  void snap_to_axis();
};

/// p4est only refines; its cells then go to the ranks part by part. Collective.
template <int dim>
void BodyMesh<dim>::Data::triangulate(const std::vector<geometry::BodyMeshParameters> &bodies,
                                      const TearingParameters                         &tearing)
{
  for (const auto &body : bodies)
    geometries.push_back(geometry::make_geometry<dim>(body));
  dealii::parallel::distributed::Triangulation<dim> refined(comm);
  create_coarse_mesh(geometries, refined);
  coarse = geometry::CoarseCells<dim>(refined);
  refine(bodies, geometries, coarse, refined);
  parts = distribute(geometries, tearing, cells_per_subdomain(dim, degree, idealization), refined,
                     triangulation);
}

/// Every rank owns a range of global nodes, the ranges ascending with the rank. Collective.
template <int dim>
void BodyMesh<dim>::Data::number_nodes()
{
  nodes.distribute_dofs(fe);
  relevant = dealii::DoFTools::extract_locally_relevant_dofs(nodes);
  relevant.compress();
  const auto ends =
    dealii::Utilities::MPI::all_gather(comm,
                                       static_cast<unsigned int>(nodes.n_locally_owned_dofs()));
  first_node_of_rank.assign(1, 0);
  for (const unsigned int n : ends)
    first_node_of_rank.push_back(first_node_of_rank.back() + n);
}

/// Positions come from the geometry, so that no rank has to send any. Also nodes of ghost cells
/// have them. Where cells differ by round-off, the first one that has the node decides.
template <int dim>
void BodyMesh<dim>::Data::collect_nodes()
{
  logical.resize(relevant.n_elements());
  node_body.resize(relevant.n_elements());
  reference.resize(relevant.n_elements());
  std::vector<bool>                            done(relevant.n_elements());
  std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
  for (const auto &cell : nodes.active_cell_iterators())
    if (!cell->is_artificial())
      {
        const unsigned int body = cell->material_id();
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const unsigned int node = local(indices[i]);
            // nodes are scalar unknowns of FE_Q; bodies share none, so each has one body
            if (done[node])
              continue;
            const auto point = coarse.point(cell->id(), fe.unit_support_point(i));
            done[node]       = true;
            node_body[node]  = body;
            logical[node]    = geometries[body]->logical(point);
            reference[node]  = geometries[body]->position(point);
          }
      }
}

/// Masters of masters are resolved by close(). Collective.
template <int dim>
void BodyMesh<dim>::Data::collect_hanging()
{
  auto constraints = deal_ii_compat::constraints(nodes.locally_owned_dofs(), relevant);
  dealii::DoFTools::make_hanging_node_constraints(nodes, constraints);
  constraints.close();
  // above all indices, as is_hanging() expects
  const unsigned int none = static_cast<unsigned int>(-1);
  hanging_of_node.assign(relevant.n_elements(), none);
  unsigned long owned_hanging = 0;
  for (unsigned int node = 0; node < relevant.n_elements(); ++node)
    {
      const unsigned int global = relevant.nth_index_in_set(node);
      if (!constraints.is_constrained(global))
        continue;
      // each by its owner only, for the sum over ranks
      owned_hanging += nodes.locally_owned_dofs().is_element(global);
      // weights are values of the shape functions of the coarse face at the node
      Hanging entry{node, {}};
      bool    reachable = true;
      for (const auto &master : *constraints.get_constraint_entries(global))
        if (relevant.is_element(master.first))
          entry.masters.emplace_back(local(master.first), master.second);
        else
          reachable = false;
      // Masters out of reach belong to hanging nodes of ghost cells only.
      if (!reachable)
        continue;
      std::sort(entry.masters.begin(), entry.masters.end());
      hanging_of_node[node] = hanging.size();
      hanging.push_back(entry);
    }
  n_free_nodes = nodes.n_dofs() - dealii::Utilities::MPI::sum(owned_hanging, comm);
}

/// The list of parts has the order of the owned active cells, in which cells are numbered here.
template <int dim>
void BodyMesh<dim>::Data::collect_cells()
{
  // deal.II numbers nodes at vertices, on lines, faces and inside; ours are in tensor-product order
  const auto order = dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(degree);
  std::vector<dealii::types::global_dof_index> indices(fe.n_dofs_per_cell());
  for (const auto &cell : nodes.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        cell->get_dof_indices(indices);
        const unsigned int body = cell->material_id();
        Cell               entry{body,
                   parts[cells.size()],
                   geometries[body]->region(coarse.coarse_cell(cell->id())),
                   {}};
        for (const unsigned int i : order)
          entry.nodes.push_back(local(indices[i]));
        cells.push_back(entry);
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            // boundary ids are indices of the body's names, see create_coarse_mesh()
            faces.push_back({entry.body, cell->face(f)->boundary_id(),
                             static_cast<unsigned int>(cells.size() - 1),
                             oriented_face_nodes<dim>(entry.nodes, degree, f)});
      }
  neighbours = owned_neighbours(triangulation);
}

/// Supports and checks ask for x == 0 exactly, but a ring has r cos(pi / 2) = 6e-17 r there.
template <int dim>
void BodyMesh<dim>::Data::snap_to_axis()
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
BodyMesh<dim>::BodyMesh(MPI_Comm                                         communicator,
                        const std::vector<geometry::BodyMeshParameters> &bodies,
                        unsigned int                                     degree,
                        const Idealization                              &idealization,
                        const TearingParameters                         &tearing)
  : data(std::make_unique<Data>(communicator, degree, idealization))
{
  data->triangulate(bodies, tearing);
  data->number_nodes();
  // A formula may fail at a position that only one rank has.
  everywhere(communicator, [&]() { data->collect_nodes(); });
  data->collect_hanging();
  data->collect_cells();
  if (idealization.is_axisymmetric())
    data->snap_to_axis();
  // Curved faces put hanging nodes off the polynomials of their masters, but the displacement
  // there is interpolated, and so must the position be, or rigid motions would strain.
  interpolate_hanging(data->reference);
}

template <int dim>
BodyMesh<dim>::~BodyMesh() = default;

template <int dim>
const geometry::BodyGeometry<dim> &BodyMesh<dim>::geometry(unsigned int body) const
{
  return *data->geometries[body];
}

template <int dim>
unsigned int BodyMesh<dim>::global_node(unsigned int node) const
{
  return data->relevant.nth_index_in_set(node);
}

template <int dim>
unsigned int BodyMesh<dim>::local_node(unsigned int global) const
{
  return data->local(global);
}

template <int dim>
unsigned int BodyMesh<dim>::owner(unsigned int node) const
{
  return owner_of_global(global_node(node));
}

/// upper_bound passes over ranks without nodes, whose ranges are empty.
template <int dim>
unsigned int BodyMesh<dim>::owner_of_global(unsigned int global) const
{
  const auto &first = data->first_node_of_rank;
  return std::upper_bound(first.begin(), first.end(), global) - first.begin() - 1;
}

template <int dim>
bool BodyMesh<dim>::is_hanging(unsigned int node) const
{
  return data->hanging_of_node[node] < data->hanging.size();
}

template <int dim>
unsigned int BodyMesh<dim>::hanging_index(unsigned int node) const
{
  return data->hanging_of_node[node];
}

template <int dim>
unsigned int BodyMesh<dim>::body_of_node(unsigned int node) const
{
  return data->node_body[node];
}

/// In any order, since masters are never hanging.
template <int dim>
void BodyMesh<dim>::interpolate_hanging(Field &field) const
{
  for (const auto &entry : data->hanging)
    {
      dealii::Tensor<1, dim> value;
      for (const auto &master : entry.masters)
        value += master.second * field[master.first];
      field[entry.node] = value;
    }
}

/// For derivatives: a node's share in a function goes to the masters that determine it.
template <int dim>
void BodyMesh<dim>::distribute_hanging(Field &field) const
{
  for (const auto &entry : data->hanging)
    {
      for (const auto &master : entry.masters)
        field[master.first] += master.second * field[entry.node];
      field[entry.node] = 0.;
    }
}

template <int dim>
const std::vector<std::pair<unsigned int, unsigned int>> &BodyMesh<dim>::cell_neighbours() const
{
  return data->neighbours;
}

#define SNUG_GETTER(type, name, value) \
  template <int dim>                   \
  type BodyMesh<dim>::name() const     \
  {                                    \
    return value;                      \
  }
SNUG_GETTER(MPI_Comm, communicator, data->comm)
SNUG_GETTER(unsigned int, degree, data->degree)
SNUG_GETTER(unsigned long, n_global_cells, data->triangulation.n_global_active_cells())
SNUG_GETTER(unsigned int, n_bodies, data->geometries.size())
SNUG_GETTER(unsigned int, n_local_nodes, data->reference.size())
SNUG_GETTER(unsigned long, n_global_free_nodes, data->n_free_nodes)
SNUG_GETTER(const Idealization &, idealization, data->idealization)
SNUG_GETTER(const std::vector<typename BodyMesh<dim>::Cell> &, cells, data->cells)
SNUG_GETTER(const std::vector<typename BodyMesh<dim>::Face> &, boundary_faces, data->faces)
SNUG_GETTER(const std::vector<typename BodyMesh<dim>::Hanging> &, hanging, data->hanging)
SNUG_GETTER(const std::vector<dealii::Point<dim>> &, logical_positions, data->logical)
SNUG_GETTER(const typename BodyMesh<dim>::Field &, reference_positions, data->reference)
#undef SNUG_GETTER

template class BodyMesh<2>;
template class BodyMesh<3>;
} // namespace snug::mesh
