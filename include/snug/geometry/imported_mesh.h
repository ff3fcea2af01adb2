#ifndef snug_geometry_imported_mesh_h
#define snug_geometry_imported_mesh_h

#include <snug/geometry/block_mesh.h>
#include <snug/geometry/body_geometry.h>

#include <cstdint>

namespace snug::geometry {
/// The mesh of a file as the cells of one body.
struct ImportedMesh
{
  std::shared_ptr<const BlockMesh<2>> flat;     ///< mesh in 2D, otherwise null
  std::shared_ptr<const BlockMesh<3>> solid;    ///< mesh in 3D, otherwise null
  std::vector<std::string>            notes;    ///< changes made to the mesh when reading
  std::vector<std::string>            warnings; ///< errors of the geometry, with their sizes
  std::vector<std::string>            faces;    ///< faces of a CAD file, one line each
  std::string              brep       = {};     ///< shape of a CAD file as text, see cad::to_brep()
  std::vector<std::string> boundaries = {};     ///< of the faces of the shape
  std::uint64_t            text_hash  = 0;      ///< FNV-1a hash of the text of the file
};
} // namespace snug::geometry

#endif
