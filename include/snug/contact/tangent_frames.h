#ifndef snug_contact_tangent_frames_h
#define snug_contact_tangent_frames_h

#include <snug/contact/nearest_face.h>
#include <snug/contact/pair_geometry.h>
#include <snug/contact/tangent_row.h>

#include <optional>

namespace snug::contact {
/// This class makes the frames of the tangential rows of one pair.
template <int dim>
class TangentFrames
{
public:
  explicit TangentFrames(PairGeometry<dim> geometry);

  /// Return which of the @p rows have tangents in directions that supports of their slave nodes
  /// hold. Such a tangential row consists of nodes of the master only, and more rows than nodes
  /// would depend on each other. So each node of the master serves the row with the largest
  /// coefficient there.
  std::vector<bool> rely_on_master(const std::vector<unsigned int> &slaves,
                                   const Row<dim>                  *rows) const;

  /// Frame of a contact row. Tangents along which a node can move come first. Then come those along
  /// which supports hold both the slave node and the nodes opposite to it, where the slip is
  /// prescribed.
  struct Tangents
  {
    TangentFrame<dim> frame;
    unsigned int      n_free = 0, n_held = 0;
  };
  /// Return the tangents of the contact row of a @p slave node.
  Tangents tangents(unsigned int slave, const Row<dim> &row, bool relies_on_master) const;

private:
  /// Faces of a side at its nodes, and at the masters of its hanging nodes; one list per surface
  /// node.
  using FacesAtNodes = std::vector<std::vector<unsigned int>>;

  const PairGeometry<dim>         pair;
  std::optional<NearestFace<dim>> nearest;             ///< none for obstacles
  FacesAtNodes                    of_slave, of_master; ///< empty for obstacles

  FacesAtNodes              faces_at_nodes(const std::vector<unsigned int> &side) const;
  std::vector<unsigned int> nodes_at_foot(unsigned int slave) const;
  void add_couple(const Row<dim> &row, const FacesAtNodes &side, TangentFrame<dim> &frame) const;
  dealii::Tensor<2, dim> movable_directions(unsigned int                     slave,
                                            const std::vector<unsigned int> &opposite,
                                            const dealii::Tensor<1, dim>    &normal) const;
};
} // namespace snug::contact

#endif
