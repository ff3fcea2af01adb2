#ifndef snug_shape_face_chart_h
#define snug_shape_face_chart_h

#include <snug/faces/face_shape.h>
#include <snug/shape/face_coordinates.h>

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

  /// A point of a face of the mesh.
  struct Place
  {
    const std::vector<unsigned int> *points; ///< surface points of the face of the mesh
    unsigned int                     degree; ///< of the shape functions
    dealii::Point<dim - 1>           xi;

    /// Return the interpolation of a field of surface points.
    template <typename Field>
    typename Field::value_type value(const Field &field) const
    {
      return interpolated(field, shape());
    }

    typename faces::FaceShape<dim>::Values shape() const
    {
      return mesh::lagrange_point<dim - 1>(degree, xi);
    }

    template <typename Field>
    typename Field::value_type
    interpolated(const Field &field, const typename faces::FaceShape<dim>::Values &values) const
    {
      typename Field::value_type result{};
      for (unsigned int k = 0; k < points->size(); ++k)
        result += values.value[k] * field[(*points)[k]];
      return result;
    }
  };

  /// The border of a face as closed loops, each a list of smooth pieces, in 3D.
  using Piece = std::vector<Flat>; ///< points from one end to the other
  using Loop  = std::vector<Piece>;

  /// Construct the chart of the coordinates @p axes, dim - 1 of them.
  FaceChart(const ShapedFace<dim> &face, const std::vector<FaceCoordinate> &axes);

  FaceChart(const ShapedFace<dim> &face, const FaceCoordinates<dim> &coordinates)
    : FaceChart(face, coordinates.all_axes())
  {}

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
  /// A face of the mesh.
  struct Patch
  {
    const std::vector<unsigned int> *points;
    unsigned int                     degree;
    std::vector<Flat>                flat;
    Flat                             centre;
    double                           radius; ///< of a circle about the centre with all points
  };

  using Edges = std::map<unsigned int, std::pair<unsigned int, Piece>>;

  std::optional<Place> find(const Flat &target, const Patch &patch, double &outside) const;
  Edges                border_edges() const;

  const ShapedFace<dim>    &face;
  Flat                      ranges;
  std::array<bool, dim - 1> closed;
  std::vector<Patch>        patches;   ///< per face of the surface
  double                    area = 0.; ///< in (s, t), signed
};
} // namespace snug::shape

#endif
