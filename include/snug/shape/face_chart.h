#ifndef snug_shape_face_chart_h
#define snug_shape_face_chart_h

#include <snug/shape/face_coordinates.h>
#include <snug/shape/face_places.h>

#include <map>
#include <optional>

namespace snug::shape {
/**
 * This class finds the point of a face at given coordinates of FaceCoordinates. The coordinates of
 * the points of each face of the mesh are interpolated as positions are: by the samples of the true
 * surface, or by the nodes of faces without samples. All coordinates are lengths here: angles are
 * multiplied by the mean radius.
 */
template <int dim>
class FaceChart
{
public:
  using Flat = dealii::Tensor<1, dim - 1>; ///< coordinates s, t as lengths

  using Place = typename FacePlaces<dim>::Place;

  /// The border of a face as closed loops, each a list of smooth pieces, in 3D.
  using Piece = std::vector<Flat>; ///< points from one end to the other
  using Loop  = std::vector<Piece>;

  FaceChart(const ShapedFace<dim> &face, const FaceCoordinates<dim> &coordinates);

  /// Return the ranges of the coordinates [length].
  const Flat &range() const { return ranges; }
  bool        is_closed(unsigned int axis) const { return closed[axis]; }

  /// Return the point at the coordinates @p target [length], or nothing outside of the face.
  std::optional<Place> find(const Flat &target) const;

  /// Return whether s and t are a right-handed frame with the outward normal (3D), or whether the
  /// body is on the left along s (2D).
  bool is_oriented() const { return area >= 0.; }

  /// Return whether the face fills the rectangle of its coordinates, up to a thousandth of its
  /// area.
  bool fills_rectangle() const;

  /// Return the loops of the border, the outer one first. The outer loop is counterclockwise
  /// in (s, t), other loops are clockwise. In 2D there are no loops. @throws InputError if the
  /// edges of the mesh at the border do not close.
  std::vector<Loop> loops() const;

private:
  using Edges = std::map<unsigned int, std::pair<unsigned int, Piece>>;

  Edges border_edges() const;

  const ShapedFace<dim>    &face;
  Flat                      ranges;
  std::array<bool, dim - 1> closed;
  FacePlaces<dim>           places;    ///< by coordinates
  double                    area = 0.; ///< in (s, t), signed
};
} // namespace snug::shape

#endif
