#ifndef snug_shape_profile_h
#define snug_shape_profile_h

#include <snug/shape/shaped_face.h>

#include <optional>

namespace snug::shape {
/// One coordinate of a face.
struct FaceCoordinate
{
  std::vector<double> values;         ///< per surface point, from 0 to range
  double              range  = 0.;    ///< maximum, or the period of a closed coordinate
  bool                closed = false; ///< true if the coordinate has a period
  double              lower  = 0.;    ///< position at the value 0, of positions along an axis
  double unit = 1.;         ///< length of a unit of the coordinate: 1, or the mean radius of an
                            ///< angle [length]
  double minimum_unit = 1.; ///< 1, or the minimum radius of an angle [length]
};

/// The points of a face. In 2D the third component of all vectors is zero.
struct FacePoints
{
  using Field = std::vector<dealii::Tensor<1, 3>>;

  Field                                              positions, normals;
  std::vector<double>                                areas;
  std::vector<std::pair<unsigned int, unsigned int>> edges; ///< adjacent points
};

template <int dim>
FacePoints face_points(const ShapedFace<dim> &face);

/// The axis of a surface of revolution.
struct Axis
{
  dealii::Tensor<1, 3> point, direction; ///< unit direction
};

/// Return the unit vector at right angles to an axis from which angles count: the projection of the
/// direction x, or y if x is within 45 degrees of the axis.
dealii::Tensor<1, 3> reference_direction(const dealii::Tensor<1, 3> &axis);

/// Return the axis along @p direction about which a face is a surface of revolution, or nothing.
/// The axis passes through @p point, or through the point that is nearest to the lines along the
/// normals in the least-squares sense.
std::optional<Axis> revolution_axis(const FacePoints                          &face,
                                    const dealii::Tensor<1, 3>                &direction,
                                    const std::optional<dealii::Tensor<1, 3>> &point);

/// Return whether the normals of a face are at right angles to @p direction.
bool is_extrusion(const FacePoints &face, const dealii::Tensor<1, 3> &direction);

/// Return the direction along which a face is an extrusion, or nothing. Along a plane this is the
/// last of the axes x, y, z other than the axis closest to the normal.
std::optional<dealii::Tensor<1, 3>> extrusion_direction(const FacePoints &face);

/// @name Coordinates
/// Each function returns nothing if the points are not connected. The sense of angles is that of a
/// right-handed rotation about the axis. Angles of a closed face are zero in the direction x, or y
/// if x is within 45 degrees of the axis, rotated by @p start [radian].
/// @{

/// Return the angle about @p axis.
std::optional<FaceCoordinate> angle(const FacePoints &face, const Axis &axis, double start);

/**
 * Return the arc length of the meridian of a surface of revolution. The arc length of an open
 * meridian begins at the end with the lower position along the axis.
 *
 * Between adjacent points with the normals n_i, n_j and the chord c of the profile, the arc length
 * is that of the circle through both points,
 *   tau . c (phi / 2) / sin(phi / 2),  phi = angle between n_i and n_j,  tau normal to n_i + n_j.
 * The arc lengths are added up along the edges of a spanning tree of the points.
 */
std::optional<FaceCoordinate>
meridian_length(const FacePoints &face, const Axis &axis, double start);

/// Return the arc length of the profile of an extrusion along @p direction. The arc length of an
/// open profile begins at the end with the smaller coordinate x, else y, else z. The arc length of
/// a closed profile is zero at the angle @p start about the mean of the points.
std::optional<FaceCoordinate>
profile_length(const FacePoints &face, const dealii::Tensor<1, 3> &direction, double start);

/// Return the position along @p direction.
FaceCoordinate position_along(const FacePoints &face, const dealii::Tensor<1, 3> &direction);
/// @}
} // namespace snug::shape

#endif
