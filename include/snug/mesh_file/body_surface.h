#ifndef snug_mesh_file_body_surface_h
#define snug_mesh_file_body_surface_h

#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/patch.h>

#include <map>
#include <set>

namespace snug::mesh_file {
/// A face of a cell at the boundary, before cells are split: an edge in 2D, a triangle or a
/// quadrilateral in 3D. The corners have the order of faces_of().
struct Facet
{
  static constexpr unsigned int no_face = static_cast<unsigned int>(-1);

  std::vector<unsigned int> corners;
  unsigned int              boundary;
  unsigned int              face = no_face; ///< index into ExactFaces::faces
};

/**
 * This class stores the surface of a body as facets, and divides the surface into smooth parts. Two
 * facets share a ridge, which is a node in 2D and an edge in 3D. A ridge is a feature, and divides
 * parts, if two boundaries meet there, the facets meet at more than 30 degrees, or the number of
 * facets is not two. Where faces are known exactly, features are the ridges between two of them.
 */
template <int dim>
class BodySurface
{
public:
  using Corners = std::vector<unsigned int>;
  using Point   = dealii::Point<dim>;
  using Vector  = dealii::Tensor<1, dim>;
  using Middles = std::map<Corners, unsigned int>;

  /// The @p middles are those of MeshFile. Ridges within the boundaries @p smooth are no features.
  BodySurface(std::vector<Point>            points,
              Middles                       middles,
              std::vector<Facet>            facets,
              const std::set<unsigned int> &smooth);

  std::vector<Point>       points;
  const Middles            middles;
  const std::vector<Facet> facets;

  struct Ridge
  {
    std::vector<unsigned int> facets;
    bool                      is_feature = false;
  };

  std::map<Corners, Ridge>                          ridges;    ///< by corners, in ascending order
  std::map<unsigned int, std::vector<unsigned int>> facets_at; ///< by node
  std::vector<std::vector<unsigned int>>            parts;     ///< facets of each part
  std::vector<unsigned int>                         part_of;   ///< part of each facet
  /// whether a facet is in a plane region of several facets, which is not changed
  std::vector<bool> is_flat;

  /// Return the ridges or the edges of a facet. The corners of each are in ascending order.
  std::vector<Corners> ridges_of(unsigned int facet) const;
  std::vector<Corners> edges(unsigned int facet) const;

  /// Return whether the facet belongs to a quadratic element.
  bool is_quadratic(unsigned int facet) const;

  /// Return the coefficients of the Curve of a quadratic element along @p edge, or 0 for a straight
  /// edge.
  std::array<Vector, 2> quadratic(const Corners &edge) const;

  /// Return the outward unit normal of the body at the centre of a facet with straight edges.
  Vector normal(unsigned int facet) const;

  Point centre(unsigned int facet) const;

  /// Return the angle between the normals of the two facets at @p ridge [degrees].
  double kink(const Corners &ridge) const;

private:
  double size = 0.; ///< size of the body [length]

  Vector normal_at(unsigned int facet, const Corners &ridge) const;
  bool   stands_out(const Corners &ridge, const std::set<unsigned int> &smooth) const;
  void   divide();
  void   find_flats();
};
} // namespace snug::mesh_file

#endif
