#ifndef snug_mesh_file_face_names_h
#define snug_mesh_file_face_names_h

#include <snug/geometry/body_geometry.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/mesh_file.h>

#include <functional>

namespace snug::mesh_file {
/**
 * This class gives names to the boundary faces of a body: the names of the groups of a mesh file,
 * or of the 'Boundary sets'. A face in the sets a and b of the entry is named "a and b".
 */
class FaceNames
{
public:
  using Element = MeshFile::Element;
  using Corners = std::vector<unsigned int>;

  /**
   * Name the faces. All arguments must outlive this object.
   * @param[in] n_cells_of_face Sorted corners of a face of the mesh -> number of its cells.
   * @param[in] parts Function that returns the faces of the mesh in a face of the file.
   * @throws InputError if a face belongs to two groups, but there are no 'Boundary sets', if a name
   *   is not allowed, or if one of the 'Boundary sets' has no face of the body.
   */
  FaceNames(const MeshFile                                             &file,
            const geometry::BodyMeshParameters                         &parameters,
            const std::vector<Element>                                 &cells,
            const geometry::NumberByVertices                           &n_cells_of_face,
            const std::function<std::vector<Corners>(const Element &)> &parts);

  /// Return the sorted corners and the names of the faces that have a name, in the order of the
  /// file.
  std::vector<std::pair<Corners, std::string>> named() const;

  std::vector<std::string> notes; ///< nodes of node sets that belong to no face

private:
  const MeshFile                                            &file;
  const geometry::BodyMeshParameters                        &parameters;
  const std::vector<Element>                                &cells;
  const geometry::NumberByVertices                          &n_cells_of_face;
  const std::function<std::vector<Corners>(const Element &)> parts;
  std::map<Corners, std::vector<std::string>>                names_of_face;
  std::vector<Corners>                                       order; ///< faces with names
  std::vector<Corners>                                       outer; ///< faces of one of the cells

  std::string renamed(const std::string &group) const;
  std::string name_of(const Element &element, const std::string &group) const;
  bool        is_wanted(const std::string &name) const;
  void        name_face(const Element &element, const std::string &name);
  void        name_optional(const std::string &name);
  void        require_faces(const std::string &name) const;
};
} // namespace snug::mesh_file

#endif
