#ifndef snug_geometry_curved_face_h
#define snug_geometry_curved_face_h

#include <snug/geometry/formula.h>
#include <snug/geometry/known_surface.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace snug::geometry {
/// Index among the boundaries @p names of the one in the entry "Curved faces = name: value".
/// @throws InputError naming the entry.
unsigned int curved_boundary(const std::vector<std::string> &names,
                             const std::string              &name,
                             const std::string              &value);

/// The face 2d+s of a box before it is curved.
template <int dim>
struct FlatFace
{
  unsigned int       boundary;
  std::string        name;
  dealii::Point<dim> centre;    ///< [length]
  dealii::Point<dim> half_size; ///< of the box [length]
};

/**
 * The outward displacement of a box face that makes it a sphere, a
 * cylinder or the graph of a formula.
 *
 * Sphere and cylinder of radius R touch the flat face at their apex:
 *   displacement = -sign(R) (|R| - sqrt(R^2 - r^2)),
 * r: distance from the apex, or from the cylinder's line of apexes. The apex
 * is the centre of the face, or the point that the value gives.
 */
template <int dim>
class CurvedFace
{
public:
  /**
   * @p value: "sphere R", "cylinder AXIS R", each with "at C, ..." if the apex
   * is not the centre of the face, or a formula [length]. C: the coordinates
   * across the normal and the axis, in the order x, y, z.
   * @throws InputError naming the entry Curved faces if @p value is none
   *   of these, the axis is not tangent to the face, or |R| does not
   *   exceed the largest r on the face.
   */
  CurvedFace(const FlatFace<dim> &flat, const std::string &value);

  unsigned int boundary() const { return flat.boundary; }

  /// Outward displacement [length] of the flat face at the projection of
  /// @p point onto it. @throws InputError if a formula is not finite.
  double displacement(const dealii::Point<dim> &point) const;

  /// The sphere or the cylinder; none of a formula.
  std::optional<KnownSurface<dim>> known() const;

private:
  FlatFace<dim>                 flat;
  std::unique_ptr<Formula<dim>> formula; ///< null: sphere or cylinder
  double                        radius        = 0.;
  unsigned int                  straight_axis = dim; ///< cylinder's, in the box
  dealii::Point<dim>            apex;

  void   set_radius(const std::string &number, const std::string &value);
  void   set_axis(const std::string &axis, const std::string &value);
  void   set_apex(const std::string &coordinates, const std::string &value);
  bool   is_across(unsigned int axis) const;
  double squared_distance(const dealii::Point<dim> &offset) const;
};
} // namespace snug::geometry

#endif
