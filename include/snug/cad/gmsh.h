#ifndef snug_cad_gmsh_h
#define snug_cad_gmsh_h

#include <string>

namespace snug::cad {
/**
 * Mesh a shape by elements of second order with the program gmsh. The files STEM.brep, .pos, .geo,
 * .log and .msh are written; `gmsh STEM.geo` shows the mesh. The groups of faces and
 * of the body are numbers that Gmsh chooses. The mesh does not depend on the number of cores.
 *
 * @throws InputError if gmsh is not found or fails.
 */
void run_gmsh(const std::string &stem,
              const std::string &brep,
              const std::string &size_field,
              unsigned int       dim);
} // namespace snug::cad

#endif
