#ifndef snug_app_mesh_checks_h
#define snug_app_mesh_checks_h

#include <snug/mesh/body_mesh.h>
#include <snug/scene/scene.h>

#include <iosfwd>

namespace snug::app {
/**
 * Check the distances between the two sides of all contact pairs. Collective.
 * @throws InputError if the bounding boxes of two sides are farther apart than ten times the
 *   diagonal of the larger body, as in a mix-up of units.
 */
template <int dim>
void check_distances(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh);

/// Return a warning for each body in which 'Refine where' refines no cell. Collective.
template <int dim>
std::vector<std::string> refinement_warnings(const scene::Scene        &scene,
                                             const mesh::BodyMesh<dim> &mesh);

/// Return the warnings about errors of the geometry of mesh files, one line each.
std::vector<std::string> import_warnings(const scene::Scene &scene);

/// Print the faces of the CAD files of all bodies.
void print_cad_faces(const scene::Scene &scene, std::ostream &out);
} // namespace snug::app

#endif
