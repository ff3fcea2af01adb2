#ifndef snug_mortar_segment_points_h
#define snug_mortar_segment_points_h

#include <snug/faces/face_map.h>
#include <snug/mesh/idealization.h>

namespace snug::mortar {
/// Where a point of the slave face meets the master face.
template <int dim, typename Number>
struct SegmentPoint
{
  Number                              weight; ///< of slave area [length^2]
  faces::FaceCoordinates<dim, Number> slave, master;
};

/// Positions of the nodes of a face.
template <int dim, typename Number>
using FaceNodes = std::vector<std::array<Number, dim>>;

/// A face as the integrals need it.
template <int dim, typename Number>
struct MortarFace
{
  FaceNodes<dim, Number> nodes;
  /// from the face to its true surface, at its samples; empty: none
  FaceNodes<dim, Number> offsets;
};

/// A box in the coordinates of a face; empty: lower > upper.
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
 * Quadrature of the part of a slave face that lies opposite to a master
 * face (Puso, Laursen, Comput. Methods Appl. Mech. Engrg. 193, 2004).
 * Both are projected along the slave face's normal n_0 at its centre into
 * coordinates y = (t.t)^-1 t.(x - c) of the plane of the tangents t there;
 * the faces' cells (halves along each coordinate of quadratic faces) are
 * intersected; the vertices are mapped back to the slave face, where the
 * pieces are triangulated: they cover it without a gap and polynomials on
 * it are integrated exactly. Quadrature points go to the master along n_0.
 */
template <int dim>
class SegmentQuadrature
{
public:
  SegmentQuadrature(unsigned int degree, const mesh::Idealization &idealization);

  /// All points; none if the faces do not overlap. Exact for shape
  /// functions times linear functions where faces are parallelograms.
  template <typename Number>
  std::vector<SegmentPoint<dim, Number>> points(const FaceNodes<dim, Number> &slave,
                                                const FaceNodes<dim, Number> &master) const;

  /// Widen @p box to hold the part of the slave face opposite to the master.
  void add_cover(const FaceNodes<dim, double> &slave,
                 const FaceNodes<dim, double> &master,
                 CoverBox<dim>                &box) const;

  /// The shape functions of both faces.
  template <typename Number>
  faces::FaceValues<dim, Number> shape(const faces::FaceCoordinates<dim, Number> &xi) const
  {
    return {degree, xi};
  }

  /// Do the faces overlap if the slave face is widened by @p margin, a part
  /// of its size, on all sides?
  bool overlap(const FaceNodes<dim, double> &slave,
               const FaceNodes<dim, double> &master,
               double                        margin) const;

private:
  /// Barycentric coordinates in a simplex and a part of its measure.
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
