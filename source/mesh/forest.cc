#include <snug/base/deal_ii_compat.h>
#include <snug/base/errors.h>
#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/base/run_context.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/imported_mesh.h>
#include <snug/mesh/forest.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace snug::mesh {
template <int dim>
CoarseMesh<dim>::CoarseMesh(const Geometries<dim> &the_geometries) : geometries(the_geometries)
{
  for (unsigned int body = 0; body < geometries.size(); ++body)
    {
      const auto         mesh   = geometries[body]->coarse_mesh();
      const unsigned int offset = vertices.size();
      first_cell.push_back(cells.size());
      vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
      for (const auto &cell : mesh.cells)
        {
          cells.emplace_back(cell.size());
          for (unsigned int v = 0; v < cell.size(); ++v)
            cells.back().vertices[v] = cell[v] + offset;
          // Refined cells inherit the material id. Regions are found from coarse cells instead.
          cells.back().material_id = body;
        }
      for (const auto &face : mesh.boundary_faces)
        {
          std::vector<unsigned int> key = face.first;
          for (unsigned int &vertex : key)
            vertex += offset;
          boundary[geometry::sorted(key)] = face.second;
        }
    }
  first_cell.push_back(cells.size());
  places = geometry::CoarseCells<dim>(first_cell);
}

namespace {
template <int dim>
geometry::CoarseCells<dim> places_in(const Geometries<dim> &geometries)
{
  std::vector<unsigned int> first_cell = {0};
  for (const auto &geometry : geometries)
    {
      // The number of cells of a body is a double, see BodyGeometry.
      const double end = first_cell.back() + geometry->n_coarse_cells();
      first_cell.push_back(narrow<unsigned int>(static_cast<std::uint64_t>(end)));
    }
  return geometry::CoarseCells<dim>(first_cell);
}
} // namespace

template <int dim>
bool Forest<dim>::are_grids() const
{
  return std::all_of(shapes->begin(), shapes->end(),
                     [](const auto &geometry) { return geometry->grid() != nullptr; });
}

template <int dim>
const CoarseMesh<dim> &Forest<dim>::coarse() const
{
  if (!coarse_mesh)
    coarse_mesh = std::make_unique<CoarseMesh<dim>>(*shapes);
  return *coarse_mesh;
}

/// Make the geometries and find the bodies whose cells some rank lacks. Collective.
template <int dim>
void Forest<dim>::make_geometries()
{
  auto                       made = std::make_shared<Geometries<dim>>();
  std::vector<unsigned char> lacks;
  // Boundary formulas are checked where all cells are.
  throw_collectively(comm, [&]() {
    for (const auto &body : parameters)
      made->push_back(geometry::make_geometry<dim>(body));
  });
  for (const auto &geometry : *made)
    lacks.push_back(geometry->has_all_cells() ? 0 : 1);
  MPI_Allreduce(MPI_IN_PLACE, lacks.data(), narrow<int>(lacks.size()), MPI_UNSIGNED_CHAR, MPI_MAX,
                comm);
  lacking.clear();
  for (unsigned int body = 0; body < lacks.size(); ++body)
    if (lacks[body] > 0)
      lacking.push_back(body);
  shapes = std::move(made);
  coarse_mesh.reset(); // it refers to the geometries
}

/// Create the triangulation of p4est, which needs the coarse cells of all bodies on every rank.
template <int dim>
void Forest<dim>::create_triangulation()
{
  for (const unsigned int body : lacking)
    {
      auto      &imported = parameters[body].imported;
      const auto mesh     = broadcast(comm, imported->template blocks<dim>());
      if (mesh != imported->template blocks<dim>()) // not on rank 0
        imported = imported->with_blocks(*mesh);
    }
  if (!lacking.empty())
    make_geometries();
  const auto &coarse_mesh = coarse();
  refined                 = std::make_unique<Triangulation>(comm);
  refined->create_triangulation(coarse_mesh.vertices, coarse_mesh.cells, dealii::SubCellData());
  for (const auto &cell : refined->cell_iterators_on_level(0))
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        {
          std::vector<unsigned int> key;
          for (const unsigned int v : cell->face(f)->vertex_indices())
            key.push_back(cell->face(f)->vertex_index(v));
          // at() throws if a geometry gives a boundary face no boundary.
          cell->face(f)->set_boundary_id(coarse_mesh.boundary.at(geometry::sorted(key)));
        }
}

/// Every rank has all cells of level 0, so the constructor needs no communication.
template <int dim>
PlacedIds<dim>::PlacedIds(const typename Forest<dim>::Triangulation &triangulation)
  : place(triangulation.n_cells(0))
{
  for (const auto &cell : triangulation.cell_iterators_on_level(0))
    place[cell->id().get_coarse_cell_id()] = cell->index();
}

template <int dim>
dealii::CellId PlacedIds<dim>::of(const dealii::CellId &in_forest) const
{
  const auto path = in_forest.get_child_indices();
  return {place[in_forest.get_coarse_cell_id()], static_cast<unsigned int>(path.size()),
          path.data()};
}

/// Refine the cells for which @p wanted returns true by one level. Return false if there are no
/// such cells. Collective.
template <int dim>
bool Forest<dim>::refine_step(const Wanted &wanted)
{
  const PlacedIds<dim> ids(*refined);
  bool                 any = false;
  // throw_collectively() is needed because a formula may fail on the rank of one cell only.
  throw_collectively(comm, [&]() {
    for (const auto &cell : refined->active_cell_iterators())
      if (cell->is_locally_owned() &&
          wanted(cell->material_id(), ids.of(cell->id()), cell->level()))
        {
          cell->set_refine_flag();
          any = true;
        }
  });
  any = dealii::Utilities::MPI::logical_or(any, comm);
  // The refinement is skipped without wanted cells, because balancing the trees would take as long
  // as with wanted cells.
  if (any)
    refined->execute_coarsening_and_refinement();
  return any;
}

template <int dim>
Forest<dim>::Forest(MPI_Comm communicator, const std::vector<geometry::BodyMeshParameters> &bodies)
  : comm(communicator), parameters(bodies)
{
  make_geometries();
  cell_places                                                       = places_in(*shapes);
  unsigned int                                         global_steps = 0, local_steps = 0;
  std::vector<std::unique_ptr<geometry::Formula<dim>>> formulas;
  for (const auto &body : bodies)
    {
      const bool local = !body.refine_where.empty();
      global_steps     = std::max(global_steps, body.refinements);
      if (local)
        local_steps = std::max(local_steps, body.local_refinements);
      formulas.push_back(
        local ? std::make_unique<geometry::Formula<dim>>("Refine where", body.refine_where)
              : nullptr);
    }
  if (global_steps + local_steps > 0)
    create_triangulation();
  // Bodies share one triangulation, so all refinement steps are common. A body with enough levels
  // is not refined in further steps.
  for (unsigned int step = 0; step < global_steps; ++step)
    refine_step([&](unsigned int body, const dealii::CellId &, unsigned int level) {
      return level < bodies[body].refinements;
    });
  for (unsigned int step = 0; step < local_steps; ++step)
    refine_step([&](unsigned int body, const dealii::CellId &cell, unsigned int level) {
      // p4est limits the level difference of neighbours to one and may refine more cells than
      // wanted.
      return formulas[body] && level < bodies[body].refinements + bodies[body].local_refinements &&
             formulas[body]->value((*shapes)[body]->position(
               cell_places.point(cell, geometry::unit_centre<dim>()))) > 0.;
    });
}

/// Cells are refined level by level. The set may also contain cells that p4est has refined to
/// limit the level difference of neighbours to one.
template <int dim>
void Forest<dim>::refine(const std::set<dealii::CellId> &cells)
{
  if (cells.empty())
    return;
  if (!refined)
    create_triangulation();
  while (refine_step(
    [&](unsigned int, const dealii::CellId &cell, unsigned int) { return cells.count(cell) > 0; }))
    ;
}

template struct CoarseMesh<2>;
template struct CoarseMesh<3>;
template class Forest<2>;
template class Forest<3>;
template class PlacedIds<2>;
template class PlacedIds<3>;
} // namespace snug::mesh
