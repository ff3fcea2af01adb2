#ifndef snug_mortar_segment_points_h
#define snug_mortar_segment_points_h

#include <snug/faces/face_map.h>
#include <snug/mesh/idealization.h>

#include <functional>
#include <optional>

namespace snug::mortar {
/// A point of the slave face and the point of the master face that it meets.
template <int dim, typename Number>
struct SegmentPoint
{
  Number                              weight; ///< slave area [length^2]
  faces::FaceCoordinates<dim, Number> slave, master;
  faces::FaceValues<dim, Number>      slave_shape; ///< at the point of the slave
};

/// Positions of the nodes of a face.
template <int dim, typename Number>
using FaceNodes = std::vector<std::array<Number, dim>>;

/// A face with the data of the integrals.
template <int dim, typename Number>
struct MortarFace
{
  FaceNodes<dim, Number> nodes;
  /// offsets from the face to its true surface, at the samples of the face; empty: none
  FaceNodes<dim, Number> offsets = {};
  /// vector along which a slave face is projected; none: the normal at its centre
  std::optional<std::array<Number, dim>> direction = {};
};

/// A box in the coordinates of a face; lower > upper if the box is empty.
template <int dim>
struct CoverBox
{
  faces::FaceCoordinates<dim, double> lower, upper;

  CoverBox()
  {
    lower.fill(1.);
    upper.fill(0.);
  }
};

/**
 * This class is a quadrature of the part of a slave face that lies opposite to a master face (Puso,
 * Laursen, Comput. Methods Appl. Mech. Engrg. 193, 2004). Both faces are projected along n_0, the
 * direction of the slave face or the normal at its centre, into the plane of the tangents t there:
 * x - c = t y + s n_0. The cells of the faces (halves along each coordinate for quadratic faces)
 * are intersected. The vertices are mapped back to the slave face, where the pieces are
 * triangulated. The pieces cover the slave face without a gap, and polynomials on it are integrated
 * exactly. Quadrature points are projected to the master along n_0.
 */
template <int dim>
class SegmentQuadrature
{
public:
  SegmentQuadrature(unsigned int degree, const mesh::Idealization &idealization);

  /// Call @p visit for each point with a function that computes the point; for none if the faces do
  /// not overlap. The quadrature is exact for shape functions times linear functions where faces
  /// are parallelograms.
  template <typename Number>
  void for_each_point(
    const MortarFace<dim, Number>                                                 &slave,
    const MortarFace<dim, Number>                                                 &master,
    const std::function<void(const std::function<SegmentPoint<dim, Number>()> &)> &visit) const;

  /// Widen @p box to contain the part of the slave face opposite to the master.
  void add_cover(const MortarFace<dim, double> &slave,
                 const MortarFace<dim, double> &master,
                 CoverBox<dim>                 &box) const;

  /// Return the shape functions of both faces at @p xi.
  template <typename Number>
  faces::FaceValues<dim, Number> shape(const faces::FaceCoordinates<dim, Number> &xi) const
  {
    return {degree, xi};
  }

  /// Return whether the faces overlap if the slave face is widened by @p margin, a fraction of its
  /// size, on all sides.
  bool overlap(const MortarFace<dim, double> &slave,
               const MortarFace<dim, double> &master,
               double                         margin) const;

private:
  /// Barycentric coordinates in a simplex with the weight, a fraction of the measure of the
  /// simplex.
  struct Point
  {
    std::array<double, dim> barycentric;
    double                  weight;
  };

  unsigned int       degree;
  mesh::Idealization idealization;
  std::vector<Point> rule;
};
} // namespace snug::mortar

#endif
