#ifndef snug_app_mesh_summary_h
#define snug_app_mesh_summary_h

#include <snug/base/run_context.h>
#include <snug/mesh/body_mesh.h>
#include <snug/scene/scene.h>

#include <iosfwd>

namespace snug::app {
/// This struct summarizes the meshes of a scene for its author: sizes, boundaries, regions.
template <int dim>
struct MeshSummary
{
  /// Bounding box [length].
  struct Box
  {
    dealii::Point<dim> lower, upper;
  };

  struct Boundary
  {
    std::string name;
    double      area = 0.; ///< [length^2]
    Box         box;
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
    Box                   box;
    std::vector<Boundary> boundaries;
  };

  std::vector<Body> bodies;
};

/// Return the summary of the refined meshes of a scene. Collective.
template <int dim>
MeshSummary<dim> summarize_mesh(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Print a line for each body, for each region of a body with several regions, and for each
/// boundary.
template <int dim>
void print(const MeshSummary<dim> &summary, std::ostream &out);

/**
 * Check the distances between the two sides of all contact pairs. Collective.
 * @throws InputError if the bounding boxes of two sides are farther apart than ten times the
 *   diagonal of the larger body, as in a mix-up of units.
 */
template <int dim>
void check_distances(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Return a warning for each body in which 'Refine where' refines no cell. Collective.
template <int dim>
std::vector<std::string> unrefined(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Print the estimated cost of a run with @p mesh on @p n_ranks ranks: two lines, or a table of the
/// @p stages. Collective.
template <int dim>
void print_estimate(RunContext                &context,
                    const scene::Scene        &scene,
                    const mesh::BodyMesh<dim> &mesh,
                    unsigned int               n_ranks,
                    bool                       stages);

/// Print the faces of the CAD files of all bodies.
void print_faces(const scene::Scene &scene, std::ostream &out);

/// Return the warnings about errors of the geometry of mesh files, one line each.
std::vector<std::string> import_warnings(const scene::Scene &scene);

/// Print a line for each change that was made to a mesh file when it was read.
void print_import_notes(const scene::Scene &scene, std::ostream &out);
} // namespace snug::app

#endif
