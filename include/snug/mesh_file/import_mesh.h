#ifndef snug_mesh_file_import_mesh_h
#define snug_mesh_file_import_mesh_h

#include <snug/geometry/imported_mesh.h>
#include <snug/mesh_file/exact_faces.h>
#include <snug/mesh_file/mesh_file.h>

#include <mpi.h>

#include <functional>

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

/// Return the mesh of a file on rank 0, where @p text returns the content of the file, and a mesh
/// without cells on all other ranks. Collective.
std::shared_ptr<const geometry::ImportedMesh>
import_mesh(MPI_Comm                            communicator,
            const std::function<std::string()> &text,
            const geometry::BodyMeshParameters &parameters,
            unsigned int                        dim);

/// Return the same for the content of a mesh file that was read before. @p exact are the faces on
/// which the nodes of the boundary lie; null: the surfaces follow from the mesh. The hash is not
/// set.
template <int dim>
std::shared_ptr<geometry::ImportedMesh> import_mesh(const MeshFile                     &file,
                                                    const geometry::BodyMeshParameters &parameters,
                                                    const ExactFaces<dim> *exact = nullptr);

/// Return the hash FNV-1a of 64 bits, which is equal on all machines, unlike std::hash.
std::uint64_t text_hash(const std::string &text);
} // namespace snug::mesh_file

#endif
