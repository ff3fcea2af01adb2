#ifndef snug_io_deck_mesh_text_h
#define snug_io_deck_mesh_text_h

#include <snug/io/whole_mesh.h>
#include <snug/scene/scene.h>

#include <set>

namespace snug::io {
/// Return a number that counts from 1 as text.
inline std::string deck_number(const unsigned int index)
{
  return std::to_string(index + 1);
}

/// Return @p x with at most 20 characters, which CalculiX reads: exactly if these suffice,
/// otherwise with 14 digits.
std::string deck_real(double x);

/// Return a name with - in place of the characters other than letters, digits, . and _, because
/// CalculiX ignores blanks and separates by commas.
std::string deck_name(std::string name);

/// Return the lines of *EQUATION: sum_i weight_i u_i = 0, with items "node, component, weight".
std::string deck_equation(const std::vector<std::string> &items);

/// This class writes the mesh of a deck of CalculiX: nodes, elements, sets and surfaces.
template <int dim>
class DeckMeshText
{
public:
  /// All arguments must outlive this object.
  DeckMeshText(const mesh::BodyMesh<dim> &mesh,
               const scene::Scene        &scene,
               const WholeMesh<dim>      &whole);

  /// Return the nodes of the elements. The middles of faces and cells are not among them.
  const std::set<unsigned int> &used_nodes() const { return used; }
  bool                          has(unsigned int node) const { return used.count(node) > 0; }

  /// Return *NODE, with an *EQUATION for each component of a hanging node.
  std::string nodes() const;
  /// Return *ELEMENT of each region, and the element sets of bodies with several regions.
  std::string elements() const;
  /// Return a node set, without hanging nodes, and a surface of element faces for each boundary.
  std::string sets() const;
  /// Return the line "element, S3" of a surface.
  std::string side(const typename WholeMesh<dim>::Face &face) const;

private:
  const mesh::BodyMesh<dim>      &mesh;
  const scene::Scene             &scene;
  const WholeMesh<dim>           &whole;
  const std::vector<unsigned int> order; ///< of the nodes of an element
  std::set<unsigned int>          used;

  std::string element_type() const;
};
} // namespace snug::io

#endif
