#ifndef snug_faces_face_map_h
#define snug_faces_face_map_h

#include <snug/faces/recording.h>

#include <array>
#include <vector>

namespace snug::faces {
/// Coordinates xi in [0,1]^(dim-1) of a face, or coordinates in a plane.
template <int dim, typename Number>
using FaceCoordinates = std::array<Number, dim - 1>;

/// Shape functions of FaceShape and their derivatives at one point, up to a maximum degree. The
/// coordinates of the point may carry derivatives.
template <int dim, typename Number, unsigned int max_degree = 2>
struct FaceValues
{
  static constexpr unsigned int max_nodes =
    dim == 2 ? max_degree + 1 : (max_degree + 1) * (max_degree + 1);

  FaceValues(unsigned int degree, const FaceCoordinates<dim, Number> &xi);

  unsigned int                                        n_nodes;
  std::array<Number, max_nodes>                       value;
  std::array<FaceCoordinates<dim, Number>, max_nodes> gradient;
};

/// This class is a face of degree @p degree projected into a plane.
template <int dim, typename Number>
class PlaneFace
{
public:
  using Point = FaceCoordinates<dim, Number>;

  /// Set the nodes y_k in the plane, in units of about the size of the face.
  PlaneFace(unsigned int degree, const std::vector<Point> &nodes);

  const std::vector<Point> &nodes() const { return points; }

  /**
   * Return the coordinates xi with sum_k N_k(xi) y_k = @p y, which may lie a little outside the
   * face. Newton's method computes the values, and one more step computes the derivatives.
   * @throws TangledMesh where the face is folded.
   */
  Point coordinates(const Point &y) const;

private:
  unsigned int                              degree;
  std::vector<Point>                        points;
  std::vector<FaceCoordinates<dim, double>> values; ///< values of points
};
} // namespace snug::faces

#endif
