#ifndef snug_deck_deck_bodies_h
#define snug_deck_deck_bodies_h

#include <snug/mesh_file/deck_sets.h>

#include <optional>

namespace snug::deck {
/**
 * This class divides the mesh of a deck into bodies of connected cells, and finds the faces of sets
 * on each body. A set that is used becomes one of the 'Boundary sets' of its bodies, unless an
 * earlier one has the same faces.
 */
class DeckBodies
{
public:
  using Corners = std::vector<unsigned int>;

  struct Body
  {
    std::string                         name;     ///< name in the parameter file
    std::string                         group;    ///< "" for the only body
    std::vector<unsigned int>           elements; ///< indices of the cells
    std::vector<std::string>            sets;     ///< 'Boundary sets'
    std::vector<std::set<unsigned int>> faces;    ///< outer faces of each set
    std::map<std::string, std::string>  alias;    ///< set -> the set with the same faces
    std::vector<Corners>                outer;    ///< outer faces, in the order of faces_of()
    std::map<Corners, unsigned int>     index_of; ///< sorted corners -> index of the outer face
    /// node -> an outer face on which it lies
    std::map<unsigned int, unsigned int> face_at;
  };

  explicit DeckBodies(const mesh_file::DeckMesh &deck);

  const std::vector<Body> &all() const { return bodies; }
  unsigned int             dimension() const { return dim; }

  /// Use a set of faces or an optional boundary. Return whether a body has such a face.
  bool use(const std::string &set);

  /// Return the bodies that have faces of the set.
  std::vector<unsigned int> bodies_of(const std::string &set) const;

  /// Return the outer faces of a body that belong to the set, or all of them for the set "".
  std::set<unsigned int> faces_on(unsigned int body, const std::string &set) const;

  /// Return the corners of all outer faces of bodies that belong to the set.
  std::vector<Corners> faces_of(const std::string &set) const;

  /// Return the sorted corners of the faces of a set that belong to no cell, as those of rigid
  /// bodies.
  std::vector<Corners> other_faces_of(const std::string &set) const;

  /// Return whether two sets have the same faces, or common ones. Both must have been used before.
  bool have_same_faces(const std::string &set, const std::string &other) const;
  bool have_common_faces(const std::string &set, const std::string &other) const;

  /// Return the name of one of the 'Boundary sets' of a body: SET for BODY.SET.
  std::string boundary_name(unsigned int body, const std::string &set) const;

  /// Return the boundaries of a body to which outer faces belong, such as "a" and "a and b". All
  /// sets must have been used before.
  std::vector<std::string> boundaries(unsigned int body, const std::set<unsigned int> &faces) const;

  /// Return a boundary of a body on which the node lies, or nothing. Faces of no set are the
  /// boundary "free". All sets must have been used before.
  std::optional<std::string> boundary_at(unsigned int body, unsigned int node) const;

  /// Return the body on whose outer faces a node lies, or nothing.
  std::optional<unsigned int> body_at(unsigned int node) const;

  const dealii::Point<3> &point(const unsigned int node) const { return mesh.points[node]; }

  const Corners &corners_of(const unsigned int element) const
  {
    return mesh.elements[element].corners;
  }

  /// Return the position of a node, one number per dimension [length].
  std::vector<double> position(unsigned int node) const;

  /// Return the corners of a face, and the nodes in the middles of its edges and of the face.
  std::vector<unsigned int> nodes_of(const Corners &face) const;

  /// Return the nodes of the optional boundary @p set that are nodes of cells, but neither lie on
  /// one of its faces nor in a body whose faces all belong to it.
  std::set<unsigned int> nodes_without_face(const std::string &set) const;

private:
  const mesh_file::MeshFile &mesh;
  unsigned int               dim = 0;
  std::vector<Body>          bodies;
  std::set<std::string>      used;
  std::vector<bool>          is_cell_node;
  /// set of faces -> sorted corners of its faces
  std::map<std::string, std::vector<Corners>> faces_of_set;

  void        add_body(const mesh_file::ConnectedCells &cells, bool is_only_one);
  std::string face_name(unsigned int body, unsigned int face) const;
};
} // namespace snug::deck

#endif
