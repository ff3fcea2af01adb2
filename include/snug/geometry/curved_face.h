#ifndef snug_geometry_curved_face_h
#define snug_geometry_curved_face_h

#include <snug/geometry/formula.h>
#include <snug/geometry/known_surface.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace snug::geometry {
/// Return the index of @p name, from the entry "Curved faces = name: value", in @p names.
/// @throws InputError naming the entry.
unsigned int curved_boundary(const std::vector<std::string> &names,
                             const std::string              &name,
                             const std::string              &value);

/// The face 2d+s of a box before the face is curved.
template <int dim>
struct FlatFace
{
  unsigned int       boundary;
  std::string        name;
  dealii::Point<dim> centre;    ///< [length]
  dealii::Point<dim> half_size; ///< half of the size of the box [length]
};

/**
 * The outward displacement of a box face that makes the face a sphere, a
 * cylinder or the graph of a formula.
 *
 * A sphere or a cylinder of radius R touches the flat face at the apex:
 *   displacement = -sign(R) (|R| - sqrt(R^2 - r^2)),
 * where r is the distance from the apex, or from the line of apexes of a cylinder. The apex
 * is the centre of the face, or the point that the value gives.
 */
template <int dim>
class CurvedFace
{
public:
  /**
   * Read @p value, which is "sphere R", "cylinder AXIS R" or a formula [length]. "at C, ..."
   * follows R if the apex is not the centre of the face. C, ... are the coordinates of the apex
   * along the axes other than the face normal and the cylinder axis, in the order x, y, z.
   * @throws InputError naming the entry Curved faces if @p value has none
   *   of these forms, the axis is not tangent to the face, or |R| does not
   *   exceed the maximum r on the face.
   */
  CurvedFace(const FlatFace<dim> &flat, const std::string &value);

  unsigned int boundary() const { return flat.boundary; }

  /// Return the outward displacement [length] of the flat face at the projection of
  /// @p point onto the face. @throws InputError if a formula is not finite.
  double displacement(const dealii::Point<dim> &point) const;

  /// Return the sphere or the cylinder, or nothing for a formula.
  std::optional<KnownSurface<dim>> known() const;

private:
  FlatFace<dim>                 flat;
  std::unique_ptr<Formula<dim>> formula; ///< null for a sphere or a cylinder
  double                        radius        = 0.;
  unsigned int                  straight_axis = dim; ///< axis of a cylinder; dim for a sphere
  dealii::Point<dim>            apex;

  void   set_radius(const std::string &number, const std::string &value);
  void   set_axis(const std::string &axis, const std::string &value);
  void   set_apex(const std::string &coordinates, const std::string &value);
  bool   is_across(unsigned int axis) const;
  double squared_distance(const dealii::Point<dim> &offset) const;
};
} // namespace snug::geometry

#endif
