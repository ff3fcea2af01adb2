#ifndef snug_geometry_imported_mesh_h
#define snug_geometry_imported_mesh_h

#include <snug/geometry/block_mesh.h>
#include <snug/geometry/body_geometry.h>

#include <boost/serialization/string.hpp>

#include <cstdint>

namespace snug::geometry {
/// The mesh of a file as the cells of one body. Rank 0 reads the file, and all other ranks have an
/// excerpt without cells, until they get the cells that they need, see Forest and BodyMesh.
struct ImportedMesh
{
  std::shared_ptr<const BlockMesh<2>> flat;                  ///< mesh in 2D, otherwise null
  std::shared_ptr<const BlockMesh<3>> solid;                 ///< mesh in 3D, otherwise null
  bool                                has_triangles = false; ///< in elements of the file
  std::vector<std::string>            notes;    ///< changes made to the mesh when reading
  std::vector<std::string>            warnings; ///< errors of the geometry, with their sizes
  std::vector<std::string>            faces;    ///< faces of a CAD file, one line each
  std::string              brep       = {};     ///< shape of a CAD file as text, see cad::to_brep()
  std::vector<std::string> boundaries = {};     ///< of the faces of the shape
  std::uint64_t            text_hash  = 0;      ///< FNV-1a hash of the text of the file

  /// Return the mesh of a dimension.
  template <int dim>
  std::shared_ptr<const BlockMesh<dim>> &blocks()
  {
    if constexpr (dim == 2)
      return flat;
    else
      return solid;
  }
  template <int dim>
  const std::shared_ptr<const BlockMesh<dim>> &blocks() const
  {
    return const_cast<ImportedMesh *>(this)->blocks<dim>();
  }

  /// Return the mesh with other cells, which may come from another rank, and all else as it is.
  template <int dim>
  std::shared_ptr<const ImportedMesh> with_blocks(BlockMesh<dim> mesh) const
  {
    auto result = std::make_shared<ImportedMesh>(*this);
    for (unsigned int i = 0; i < mesh.projections.size(); ++i)
      mesh.projections[i]->shape = blocks<dim>()->projections[i]->shape;
    result->blocks<dim>() = std::make_shared<const BlockMesh<dim>>(std::move(mesh));
    return result;
  }

  /// Return the mesh without cells, with the names, surfaces and bounds of the body.
  std::shared_ptr<const ImportedMesh> without_cells() const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & flat & solid & has_triangles & notes & warnings & faces & brep & boundaries;
    archive & text_hash;
  }
};
} // namespace snug::geometry

#endif
