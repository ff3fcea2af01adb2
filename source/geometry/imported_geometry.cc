#include <snug/base/errors.h>
#include <snug/geometry/block_geometry.h>
#include <snug/geometry/body_sources.h>
#include <snug/geometry/imported_mesh.h>

namespace snug::geometry {
std::shared_ptr<const ImportedMesh> ImportedMesh::without_cells() const
{
  return flat ? with_blocks(excerpt(*flat, {})) : with_blocks(excerpt(*solid, {}));
}

template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_imported(const BodyMeshParameters &parameters)
{
  // The scene reads the files, because only the scene knows the directory of the files and the
  // lines of the entries.
  if (!parameters.imported)
    throw bad_entry("File", parameters.file, "must be read before a mesh is made of it");
  return std::make_unique<BlockGeometry<dim>>(parameters.imported->blocks<dim>());
}

template std::unique_ptr<BodyGeometry<2>> make_imported(const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> make_imported(const BodyMeshParameters &);
} // namespace snug::geometry
