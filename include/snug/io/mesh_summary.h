#ifndef snug_io_mesh_summary_h
#define snug_io_mesh_summary_h

#include <snug/io/answer.h>
#include <snug/io/bounding_box.h>
#include <snug/mesh/surface.h>
#include <snug/scene/scene.h>

#include <iosfwd>

namespace snug::io {
/// This struct summarizes the meshes of a scene for its author: sizes, boundaries, regions.
template <int dim>
struct MeshSummary
{
  struct Boundary
  {
    std::string      name;
    double           area = 0.; ///< [length^2]
    BoundingBox<dim> box;
  };

  /// This struct describes a set of cells that can have its own material.
  struct Region
  {
    std::string   name;
    unsigned long n_cells;
    double        volume; ///< [length^3], per revolution, of the thickness
  };

  struct Body
  {
    std::string           name;
    unsigned long         n_cells = 0;
    std::vector<Region>   regions; ///< may be empty, see BodyGeometry
    BoundingBox<dim>      box;
    std::vector<Boundary> boundaries;
  };

  std::vector<Body> bodies;
};

/// Return the area of the faces of @p side at @p positions of the surface [length^2].
template <int dim>
double area_of(unsigned int                              degree,
               const mesh::Surface<dim>                 &surface,
               const contact::Side                      &side,
               const typename mesh::Surface<dim>::Field &positions);

/// Return the summary of the refined meshes of a scene. Collective.
template <int dim>
MeshSummary<dim> summarize_mesh(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Return {name, cells, box, regions, boundaries} of each body.
template <int dim>
Json bodies_part(const MeshSummary<dim> &summary);

/// Print a line for each body, for each region of a body with several regions, and for each
/// boundary.
template <int dim>
void print(const MeshSummary<dim> &summary, std::ostream &out);
} // namespace snug::io

#endif
