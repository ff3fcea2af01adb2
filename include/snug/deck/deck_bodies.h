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
  struct Body
  {
    std::string                         name;     ///< name in the parameter file
    std::string                         group;    ///< "" for the only body
    std::vector<unsigned int>           elements; ///< indices of the cells
    std::vector<std::string>            sets;     ///< 'Boundary sets'
    std::vector<std::set<unsigned int>> faces;    ///< outer faces of each set
    std::map<std::string, std::string>  alias;    ///< set -> the set with the same faces
    /// sorted corners of an outer face -> index of the face
    std::map<std::vector<unsigned int>, unsigned int> outer;
  };

  explicit DeckBodies(const mesh_file::DeckMesh &deck);

  const std::vector<Body> &all() const { return bodies; }
  unsigned int             dimension() const { return dim; }

  /// Return whether the edges of all cells have middle nodes.
  bool is_second_order() const;

  /// Use a set of faces or an optional boundary. Return whether a body has such a face.
  bool use(const std::string &set);

  /// Return the bodies that have faces of the set.
  std::vector<unsigned int> bodies_of(const std::string &set) const;

  /// Return the name of one of the 'Boundary sets' of a body: SET for BODY.SET.
  std::string boundary_name(unsigned int body, const std::string &set) const;

  /// Return the boundaries of a body that consist of faces of the set, such as "a" and "a and b".
  /// All sets must have been used before.
  std::vector<std::string> boundaries(unsigned int body, const std::string &set) const;

  /// Return a boundary of a body on which the node lies, or nothing. Faces of no set are the
  /// boundary "free". All sets must have been used before.
  std::optional<std::string> boundary_at(unsigned int body, unsigned int node) const;

  /// Return the position of a node, one number per dimension [length].
  std::vector<double> position(unsigned int node) const;

  /// Return the number of nodes of the optional boundary @p set that lie on none of its faces.
  unsigned int nodes_without_face(const std::string &set) const;

private:
  const mesh_file::MeshFile &mesh;
  unsigned int               dim = 0;
  std::vector<Body>          bodies;
  std::set<std::string>      used;
  /// set of faces -> sorted corners of its faces
  std::map<std::string, std::vector<std::vector<unsigned int>>> faces_of_set;

  std::set<unsigned int> faces_on(const Body &body, const std::string &set) const;
  std::string            face_name(unsigned int body, unsigned int face) const;
};
} // namespace snug::deck

#endif
