#ifndef snug_mesh_file_import_mesh_h
#define snug_mesh_file_import_mesh_h

#include <snug/geometry/imported_mesh.h>

namespace snug::mesh_file {
/**
 * Return the cells and boundaries of the mesh file with the content @p text:
 *
 * - The cells are the elements of the dimension @p dim in the wanted regions. If they contain
 *   triangles, tetrahedra or prisms, then all elements are split into quadrilaterals or hexahedra
 *   at the middles of edges, faces and elements. Hexahedra are also split if their edges cannot be
 *   given consistent directions, see order_consistently().
 * - The boundaries are the groups of elements one dimension lower. Boundary faces without a group
 *   are called free.
 * - Boundaries are parts of the true surface (SurfaceShapes), also when cells are refined.
 *
 * @throws InputError with the entry and, for an error of the file, with line and element.
 */
std::shared_ptr<const geometry::ImportedMesh>
import_mesh(const std::string                  &text,
            const geometry::BodyMeshParameters &parameters,
            unsigned int                        dim);
} // namespace snug::mesh_file

#endif
