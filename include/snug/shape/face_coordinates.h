#ifndef snug_shape_face_coordinates_h
#define snug_shape_face_coordinates_h

#include <snug/shape/profile.h>

namespace snug::shape {
/**
 * The coordinates s (2D) or s, t (3D) of the points of a face, as the entry Coordinates chooses:
 *
 * | Coordinates | s                                | t                          |
 * |-------------|----------------------------------|----------------------------|
 * | projection  | positions along the axes other than the axis closest to the mean normal, in   ||
 * |             | the order x, y, z; the face is a graph over them                              ||
 * | arc length  | arc length of the face (2D) or of the profile of an extrusion | position along it
 * | | angle       | angle about the centre or axis   | arc length of the meridian |
 *
 * All coordinates begin at 0. Arc lengths and angles may be closed.
 */
template <int dim>
class FaceCoordinates
{
public:
  using Field = typename ShapedFace<dim>::Field;

  /// Find the coordinates. @throws InputError naming the entry Face, Coordinates, Axis or Axis
  /// point. The face must outlive this object.
  FaceCoordinates(const ShapedFace<dim> &face, const ShapeParameters &parameters);

  /// Return the choice, which is never automatic.
  Coordinates kind() const { return chosen; }

  const FaceCoordinate &axis(unsigned int a) const { return axes[a]; }

  /// Return the coordinates of the surface points as the first components of vectors, with angles
  /// multiplied by their unit, and the periods of the components (0: none).
  std::vector<dealii::Tensor<1, dim>> as_lengths() const;
  dealii::Tensor<1, dim>              periods() const;

  /// Return the axis of the angle, or the direction of the extrusion of a face with arc lengths.
  const Axis &line() const { return own_line; }

  /// Return the axes x, y, z of the coordinates of a projection.
  const std::vector<unsigned int> &projection_axes() const { return kept_axes; }

  /// Return the coordinates of a surface point over their ranges.
  std::vector<double> fractions(unsigned int point) const;

  /// Return the point of the face that is nearest to the coordinates @p fractions of the ranges,
  /// and the interpolation of the unit vectors @p directions there.
  std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>
  point_at(const std::vector<double> &fractions, const Field &directions) const;

private:
  void set_projection();
  void set_angles(const FacePoints &points, const ShapeParameters &parameters);
  void set_arc_lengths(const FacePoints &points, const ShapeParameters &parameters);

  const ShapedFace<dim>      &face;
  Coordinates                 chosen;
  std::vector<unsigned int>   kept_axes;
  std::vector<FaceCoordinate> axes;
  Axis                        own_line;
};

/// Return the mean of unit vectors over a face as a unit vector.
template <int dim>
dealii::Tensor<1, dim> mean_direction(const ShapedFace<dim>                 &face,
                                      const typename ShapedFace<dim>::Field &directions);
} // namespace snug::shape

#endif
