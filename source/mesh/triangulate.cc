#include <snug/base/deal_ii_compat.h>
#include <snug/base/errors.h>
#include <snug/base/run_context.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/formula.h>
#include <snug/mesh/triangulate.h>

#include <deal.II/grid/tria_description.h>

namespace snug::mesh {
/// Every rank has the whole coarse mesh, as p4est needs it. Bodies share no vertices, even where
/// they touch.
template <int dim>
void create_coarse_mesh(const Geometries<dim>                             &geometries,
                        dealii::parallel::distributed::Triangulation<dim> &triangulation)
{
  std::vector<dealii::Point<dim>>               vertices;
  std::vector<dealii::CellData<dim>>            coarse_cells;
  std::map<std::vector<unsigned int>, unsigned> boundary;
  for (unsigned int body = 0; body < geometries.size(); ++body)
    {
      const auto         mesh   = geometries[body]->coarse_mesh();
      const unsigned int offset = vertices.size();
      for (const auto &vertex : mesh.vertices)
        vertices.push_back(vertex);
      for (const auto &cell : mesh.cells)
        {
          dealii::CellData<dim> data(cell.size());
          for (unsigned int v = 0; v < cell.size(); ++v)
            data.vertices[v] = cell[v] + offset;
          // Refined cells inherit it. Regions are not kept here but come from coarse cells.
          data.material_id = body;
          coarse_cells.push_back(data);
        }
      for (const auto &face : mesh.boundary_faces)
        {
          std::vector<unsigned int> key = face.first;
          for (unsigned int &vertex : key)
            vertex += offset;
          boundary[geometry::sorted(key)] = face.second;
        }
    }
  triangulation.create_triangulation(vertices, coarse_cells, dealii::SubCellData());
  for (const auto &cell : triangulation.cell_iterators_on_level(0))
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        {
          std::vector<unsigned int> key;
          for (const unsigned int v : cell->face(f)->vertex_indices())
            key.push_back(cell->face(f)->vertex_index(v));
          // at() throws if a geometry has left a side without a boundary
          cell->face(f)->set_boundary_id(boundary.at(geometry::sorted(key)));
        }
}

namespace {
/// One level for the cells that @p wanted names by body, cell and level; false where it names none.
/// Collective.
template <int dim>
bool refine_step(
  dealii::parallel::distributed::Triangulation<dim>                             &triangulation,
  const std::function<bool(unsigned int, const dealii::CellId &, unsigned int)> &wanted)
{
  const auto before = triangulation.n_global_active_cells();
  // a formula may fail on the rank of one cell only
  everywhere(deal_ii_compat::communicator(triangulation), [&]() {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && wanted(cell->material_id(), cell->id(), cell->level()))
        cell->set_refine_flag();
  });
  triangulation.execute_coarsening_and_refinement();
  return triangulation.n_global_active_cells() > before;
}
} // namespace

template <int dim>
void refine(const std::vector<geometry::BodyMeshParameters>   &bodies,
            const Geometries<dim>                             &geometries,
            const geometry::CoarseCells<dim>                  &coarse,
            dealii::parallel::distributed::Triangulation<dim> &triangulation)
{
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
  // Bodies share one triangulation, so all steps are common; a body that has enough levels sits
  // the others out.
  for (unsigned int step = 0; step < global_steps; ++step)
    refine_step<dim>(triangulation,
                     [&](unsigned int body, const dealii::CellId &, unsigned int level) {
                       return level < bodies[body].refinements;
                     });
  for (unsigned int step = 0; step < local_steps; ++step)
    refine_step<dim>(triangulation, [&](unsigned int body, const dealii::CellId &cell,
                                        unsigned int level) {
      // p4est keeps neighbours within one level and so may refine more than what is wanted
      return formulas[body] && level < bodies[body].refinements + bodies[body].local_refinements &&
             formulas[body]->value(
               geometries[body]->position(coarse.point(cell, geometry::unit_centre<dim>()))) > 0.;
    });
  // Level by level; cells that p4est refines to keep neighbours within one may be named, too.
  while (refine_step<dim>(triangulation,
                          [&](unsigned int body, const dealii::CellId &cell, unsigned int) {
                            return bodies[body].refined && bodies[body].refined->count(cell) > 0;
                          }))
    ;
}

template void create_coarse_mesh(const Geometries<2> &,
                                 dealii::parallel::distributed::Triangulation<2> &);
template void refine(const std::vector<geometry::BodyMeshParameters> &,
                     const Geometries<2> &,
                     const geometry::CoarseCells<2> &,
                     dealii::parallel::distributed::Triangulation<2> &);
template void create_coarse_mesh(const Geometries<3> &,
                                 dealii::parallel::distributed::Triangulation<3> &);
template void refine(const std::vector<geometry::BodyMeshParameters> &,
                     const Geometries<3> &,
                     const geometry::CoarseCells<3> &,
                     dealii::parallel::distributed::Triangulation<3> &);
} // namespace snug::mesh
