#ifndef snug_cad_import_cad_h
#define snug_cad_import_cad_h

#include <snug/geometry/imported_mesh.h>

#include <mpi.h>

namespace snug::cad {
/**
 * Return the mesh of a part of a CAD file. The faces of the part are the surfaces of its
 * boundaries. The files of Gmsh are written in @p directory, with @p name and an ending. The first
 * rank reads the file and runs the program gmsh. Collective.
 *
 * @throws InputError on all ranks, with the entry where it concerns one.
 */
std::shared_ptr<const geometry::ImportedMesh>
import_cad(const geometry::BodyMeshParameters &parameters,
           unsigned int                        dim,
           const std::string                  &directory,
           const std::string                  &name,
           MPI_Comm                            communicator);
} // namespace snug::cad

#endif
