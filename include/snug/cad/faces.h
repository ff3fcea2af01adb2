#ifndef snug_cad_faces_h
#define snug_cad_faces_h

#include <snug/cad/part.h>
#include <snug/mesh_file/exact_faces.h>
#include <snug/mesh_file/mesh_file.h>

namespace snug::cad {
/// A face of a part, or an edge in 2D, as listed for the user.
struct FaceInfo
{
  std::string      name; ///< name in the file, or face-3
  std::string      kind; ///< "cylinder of radius 10", "plane", "B-spline", ...
  double           area; ///< in 2D length
  dealii::Point<3> lower, upper;
  /// indices of adjacent faces -> whether the normals agree at the common edge
  std::map<unsigned int, bool> neighbours;
};

std::vector<FaceInfo> describe_faces(const Part &part);

/**
 * Return the boundary of each face. @p groups is the entry "CAD faces": boundary -> "3 + seat +
 * chain 7". @throws InputError naming the entry.
 */
std::vector<std::string> boundaries_of(const std::vector<FaceInfo>              &faces,
                                       const std::map<std::string, std::string> &groups);

/// Return a table of the faces, one line each.
std::vector<std::string> table_of(const std::vector<FaceInfo>    &faces,
                                  const std::vector<std::string> &boundaries,
                                  unsigned int                    dim);

/// Return the surfaces of the faces, without the groups of a mesh, and the curves between them.
template <int dim>
mesh_file::ExactFaces<dim> exact_faces(const Part &part);

/// Return for each group of boundary elements of a mesh of second order the index of the face on
/// which its elements lie. The group of elements is a number that Gmsh chose.
/// @throws InputError if a group lies on no face.
std::map<std::string, unsigned int> faces_of_groups(const Part                &part,
                                                    const mesh_file::MeshFile &mesh);
} // namespace snug::cad

#endif
