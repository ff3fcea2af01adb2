#ifndef snug_mesh_file_deck_sets_h
#define snug_mesh_file_deck_sets_h

#include <snug/mesh_file/deck_text.h>
#include <snug/mesh_file/mesh_formats.h>

#include <deal.II/base/tensor.h>

#include <set>

namespace snug::mesh_file {
/// Place of an instance: a translation, then a rotation about the axis from @p a to @p b.
struct InstancePlace
{
  dealii::Tensor<1, 3> shift;
  dealii::Point<3>     a, b;
  double               degrees = 0.;

  dealii::Point<3> operator()(const dealii::Point<3> &x) const;
};

/// Return the place in the data lines of *INSTANCE: a translation, then two points of an axis and
/// an angle in degrees. @throws InputError with the line.
InstancePlace instance_place(const DeckText &deck, const Keyword &keyword);

/// Return the name, in upper case, of the set that a keyword defines, or "".
std::string defined_set(const Keyword &keyword);

/// A numbering of nodes and elements: one of the file, and one of each instance.
struct Scope
{
  PointNumbers                          nodes;
  std::map<unsigned long, unsigned int> elements; ///< number -> index of the element
  std::string                           instance; ///< name as in the file; "" of the file
  std::string                           part;     ///< name in upper case; "" of the file
  InstancePlace                         place;
};

/// The numberings and sets of a deck. Sets are stored under their names in upper case, those of an
/// instance behind the prefix "INSTANCE.". The prefix of the file is "".
struct DeckSets
{
  std::map<std::string, Scope>                  scopes; ///< by prefix
  std::map<std::string, std::set<unsigned int>> of_elements, of_nodes;
  /// names in upper case of sets that occur in the assembly or in several instances
  std::set<std::string>              qualified_names;
  std::map<std::string, std::string> spelling; ///< key of a set -> name of the group
  std::set<std::string>              surfaces; ///< names of the groups of faces
  /// lines of *BOUNDARY or *DLOAD with nodes or faces -> names of the optional boundaries, see
  /// group()
  std::map<std::pair<std::size_t, std::string>, std::vector<std::string>> of_lines;

  std::set<unsigned int>              copies;    ///< nodes that are made at cuts
  std::set<std::vector<unsigned int>> cut_faces; ///< sorted corners of the faces of both sides

  /// Return the key of a data line in of_lines. Lines of a keyword with equal data, but different
  /// nodes or faces, have one key.
  static std::pair<std::size_t, std::string> group(const Keyword                  &keyword,
                                                   const std::vector<std::string> &words);

  /// Return the key of a set. The set is spelled as it occurs first. A set of an instance is called
  /// INSTANCE.SET if the assembly has a set of the same name.
  std::string key(const std::string &name, const std::string &prefix);

  /// Return the key of the set @p word of the scope or of the assembly in @p sets, or "".
  std::string find(const std::map<std::string, std::set<unsigned int>> &sets,
                   const std::string                                   &word,
                   const std::string                                   &prefix) const;

  /// Return the name of the optional boundary of a node set: that of the set, or "SET nodes" if a
  /// surface has the same name.
  std::string boundary_of_nodes(const std::string &key) const;

  /// Return the indices of the elements of the set @p word of the scope or of the assembly, or of
  /// the element with the number @p word, which may be "INSTANCE.7". The error of a missing element
  /// names its @p user. @throws InputError at @p line.
  std::vector<unsigned int> elements(const std::string &word,
                                     const std::string &prefix,
                                     const std::string &user,
                                     unsigned long      line) const;

  /// Return the indices of nodes, like elements().
  std::vector<unsigned int> nodes(const std::string &word,
                                  const std::string &prefix,
                                  const std::string &user,
                                  unsigned long      line) const;

private:
  std::pair<const Scope *, std::string> split(const std::string &word,
                                              const std::string &prefix) const;
};

/// An element that is no cell: a spring, a mass, a beam or a connector. It is a vertex of the mesh,
/// so that it may belong to sets.
struct PointElement
{
  std::string               type;  ///< in upper case
  std::vector<unsigned int> nodes; ///< indices into the points
  unsigned long             line;
};

/// Two optional boundaries on different bodies that general contact lets come into contact.
struct GeneralPair
{
  std::string first, second;
  std::size_t begin;     ///< Keyword::begin of *CONTACT INCLUSIONS
  double      least_gap; ///< [length]
  double      reach;     ///< distance within which faces take part [length]
};

/**
 * Return the pairs of *CONTACT INCLUSIONS: faces of different bodies that face each other within
 * the mean size of their faces and the largest displacement in *BOUNDARY. They are added to the
 * optional boundaries of @p mesh as "BODY to OTHER". @throws InputError with the line.
 */
std::vector<GeneralPair> general_pairs(const DeckText &deck, const DeckSets &sets, MeshFile &mesh);

/**
 * Cut the mesh at the surfaces of *PRE-TENSION SECTION. The cells of the side to which the faces of
 * a surface belong get nodes of their own there, which are copies in the same node sets. The other
 * side is the optional boundary "SURFACE opposite". Other surfaces end at the section.
 * @throws InputError with the line if a surface does not exist or does not cut a body.
 */
void cut_at_sections(const DeckText &deck, DeckSets &sets, MeshFile &mesh);

/// A deck: its mesh, and the sets to which its other keywords refer.
struct DeckMesh
{
  MeshFile                             mesh;
  DeckSets                             sets;
  std::map<unsigned int, PointElement> point_elements; ///< by index of the element
  std::vector<GeneralPair>             general_pairs;
};

/// Read the mesh of a deck, see read_abaqus(). @throws InputError "line 17: message".
DeckMesh read_deck(const std::string &text);
} // namespace snug::mesh_file

#endif
