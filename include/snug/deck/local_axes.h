#ifndef snug_deck_local_axes_h
#define snug_deck_local_axes_h

#include <snug/mesh_file/deck_sets.h>

#include <optional>

namespace snug::deck {
/// The axes of *TRANSFORM at nodes, along which supports and forces have their components:
/// rectangular axes, or the radius, the circumference and the axis of a cylinder.
class LocalAxes
{
public:
  using Direction = dealii::Tensor<1, 3>;

  /// @p deck must outlive this object. @throws InputError with the line.
  LocalAxes(const mesh_file::DeckText &text, const mesh_file::DeckMesh &deck);

  /// Return whether a node has axes of its own.
  bool has(const unsigned int node) const { return of_nodes.count(node) > 0; }

  /// Return the direction of a component (0, 1, 2) at a node.
  Direction direction(unsigned int node, unsigned int component) const;

  /// Return the coordinate axis c and the sign s for which a component has the direction s e_c at
  /// all nodes, or nothing.
  std::optional<std::pair<unsigned int, double>> axis(const std::set<unsigned int> &nodes,
                                                      unsigned int component) const;

  /// Return whether a component has the direction of the normal of a face at all its corners, up to
  /// 5 degrees, as the flat faces of a round surface have.
  bool is_normal(const std::vector<unsigned int> &corners, unsigned int component) const;

  struct Axes
  {
    bool             is_cylindrical;
    dealii::Point<3> a, b; ///< points on the first axis and in the plane of the second one, or
                           ///< points on the axis of the cylinder
    unsigned long line;    ///< of *TRANSFORM

    bool operator==(const Axes &other) const
    {
      return is_cylindrical == other.is_cylindrical && a == other.a && b == other.b;
    }
  };

  /// Return the axes of a cylinder that all nodes have, none of which is on its axis, or nothing.
  std::optional<Axes> cylinder(const std::set<unsigned int> &nodes) const;

private:
  const mesh_file::DeckMesh           &deck;
  std::vector<Axes>                    axes;
  std::map<unsigned int, unsigned int> of_nodes; ///< node -> index of its axes

  Direction direction_at(const Axes &of, const dealii::Point<3> &x, unsigned int component) const;
};
} // namespace snug::deck

#endif
