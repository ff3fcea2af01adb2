#ifndef snug_cad_import_cad_h
#define snug_cad_import_cad_h

#include <snug/base/run_context.h>
#include <snug/geometry/imported_mesh.h>

namespace snug::cad {
/// Return whether a path has the ending of a file of STEP, IGES or BREP.
bool is_cad_file(const std::string &path);

/**
 * Return the mesh of a part of a CAD file, without cells on all ranks but rank 0. The faces of the
 * part are the surfaces of its boundaries. The files of Gmsh are @p stem, which is a path, with
 * endings. The first rank reads the file and runs the program gmsh. Steps of more than a second are
 * printed in the log. Collective.
 *
 * @throws InputError on all ranks, with the entry where it concerns one.
 */
std::shared_ptr<const geometry::ImportedMesh>
import_cad(const geometry::BodyMeshParameters &parameters,
           unsigned int                        dim,
           const std::string                  &stem,
           RunContext                         &context);
} // namespace snug::cad

#endif
