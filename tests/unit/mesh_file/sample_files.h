#ifndef snug_tests_unit_mesh_file_sample_files_h
#define snug_tests_unit_mesh_file_sample_files_h

#include <snug/base/errors.h>
#include <snug/mesh_file/import_mesh.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace snug::test {
inline std::string contents(const std::string &name)
{
  std::ifstream      in(SNUG_MESHES + name, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline geometry::BodyMeshParameters file_body()
{
  geometry::BodyMeshParameters parameters;
  parameters.source = "file";
  parameters.file   = "the.mesh";
  return parameters;
}

/// Numbers of VTK and UCD files.
inline geometry::BodyMeshParameters numbered_body()
{
  auto parameters             = file_body();
  parameters.boundary_numbers = {{"2", "bottom"}, {"3", "top"}};
  return parameters;
}

inline std::string
complaint(const std::string &text, const geometry::BodyMeshParameters &parameters, unsigned int dim)
{
  try
    {
      mesh_file::import_mesh(text, parameters, dim);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

struct Row
{
  std::string                  file;
  geometry::BodyMeshParameters parameters;
  unsigned int                 dim, n_cells;
};

inline const std::vector<Row> &files()
{
  // Tetrahedra give 4 cells each; a quadrilateral beside triangles 4,
  // these 3.
  static const std::vector<Row> rows = {{"block-2.msh", file_body(), 3, 2},
                                        {"block-4.msh", file_body(), 3, 2},
                                        {"tets-2-binary.msh", file_body(), 3, 48},
                                        {"tets-4-binary.msh", file_body(), 3, 48},
                                        {"block.inp", file_body(), 3, 2},
                                        {"block.vtk", numbered_body(), 3, 2},
                                        {"block-binary.vtk", numbered_body(), 3, 2},
                                        {"block-5-binary.vtk", numbered_body(), 3, 2},
                                        {"block.ucd", numbered_body(), 3, 2},
                                        {"square.msh", file_body(), 2, 10}};
  return rows;
}
} // namespace snug::test

#endif
