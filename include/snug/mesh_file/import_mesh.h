#ifndef snug_mesh_file_import_mesh_h
#define snug_mesh_file_import_mesh_h

#include <snug/geometry/imported_mesh.h>

namespace snug::mesh_file {
/**
 * Make cells of the contents @p text of a mesh file:
 *
 * - elements of the dimension @p dim in the wanted regions; if triangles,
 *   tetrahedra or prisms are among them, each is split at the middles of
 *   its edges, faces and itself into quadrilaterals or hexahedra, and all
 *   others with them; so are hexahedra whose edges cannot be given common
 *   directions, see order_consistently();
 * - groups of elements one dimension lower are the boundaries; boundary
 *   faces without a group are called free;
 * - boundaries are parts of the true surface, see SurfaceShapes, and remain so when cells are
 *   refined.
 *
 * @throws InputError naming an entry and, for what is wrong in the file,
 *   its line and element.
 */
std::shared_ptr<const geometry::ImportedMesh>
import_mesh(const std::string                  &text,
            const geometry::BodyMeshParameters &parameters,
            unsigned int                        dim);
} // namespace snug::mesh_file

#endif
