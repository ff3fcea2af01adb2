#ifndef snug_mesh_triangulate_h
#define snug_mesh_triangulate_h

#include <snug/geometry/coarse_cells.h>

#include <deal.II/distributed/tria.h>

namespace snug::mesh {
template <int dim>
using Geometries = std::vector<std::unique_ptr<geometry::BodyGeometry<dim>>>;

/// The coarse meshes of all bodies, side by side in one triangulation:
/// material id = body, boundary id = index of the body's names.
template <int dim>
void create_coarse_mesh(const Geometries<dim>                             &geometries,
                        dealii::parallel::distributed::Triangulation<dim> &triangulation);

/// Refine every body as its parameters say. Collective.
/// @throws InputError for a formula that cannot be read.
template <int dim>
void refine(const std::vector<geometry::BodyMeshParameters>   &bodies,
            const Geometries<dim>                             &geometries,
            const geometry::CoarseCells<dim>                  &coarse,
            dealii::parallel::distributed::Triangulation<dim> &triangulation);
} // namespace snug::mesh

#endif
