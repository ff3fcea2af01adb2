#ifndef snug_geometry_imported_mesh_h
#define snug_geometry_imported_mesh_h

#include <snug/geometry/block_mesh.h>
#include <snug/geometry/body_geometry.h>

#include <cstdint>

namespace snug::geometry {
/// The mesh of a file as the cells of one body.
struct ImportedMesh
{
  std::shared_ptr<const BlockMesh<2>> flat;          ///< in 2D
  std::shared_ptr<const BlockMesh<3>> solid;         ///< in 3D
  std::vector<std::string>            notes;         ///< what was done on reading
  std::uint64_t                       text_hash = 0; ///< FNV-1a of the file's text
};
} // namespace snug::geometry

#endif
