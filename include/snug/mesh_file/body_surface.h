#ifndef snug_mesh_file_body_surface_h
#define snug_mesh_file_body_surface_h

#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/patch.h>

#include <map>
#include <set>

namespace snug::mesh_file {
/// A face of a cell at the boundary, before cells are split: an edge in 2D, else a triangle or a
/// quadrilateral. Corners go round as those of faces_of().
struct Facet
{
  std::vector<unsigned int> corners;
  unsigned int              boundary;
};

/**
 * The surface of a body as facets, and its smooth parts. Parts are divided by features: where
 * boundaries meet, facets turn by more than 30 degrees, or their number is not two. What two
 * facets share is a ridge: a node in 2D, an edge in 3D.
 */
template <int dim>
class BodySurface
{
public:
  using Corners = std::vector<unsigned int>;
  using Point   = dealii::Point<dim>;
  using Vector  = dealii::Tensor<1, dim>;
  using Middles = std::map<Corners, unsigned int>;

  /// @p middles as in MeshFile. Kinks within the boundaries @p smooth are no features.
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

  std::map<Corners, Ridge>                          ridges;    ///< by corners, ascending
  std::map<unsigned int, std::vector<unsigned int>> facets_at; ///< by node
  std::vector<std::vector<unsigned int>>            parts;     ///< facets of each
  std::vector<unsigned int>                         part_of;   ///< facets
  /// facets in plane regions of several facets, which stay as they are
  std::vector<bool> is_flat;

  /// Of a facet, each in ascending order.
  std::vector<Corners> ridges_of(unsigned int facet) const;
  std::vector<Corners> edges(unsigned int facet) const;

  /// Whether the facet is of a quadratic element.
  bool is_quadratic(unsigned int facet) const;

  /// Coefficients of its Curve from the lower corner, as quadratic elements have them.
  std::array<Vector, 2> quadratic(const Corners &edge) const;

  /// Unit normal out of the body in the middle of a facet's straight edges.
  Vector normal(unsigned int facet) const;

  Point centre(unsigned int facet) const;

  /// Angle by which the surface turns there [degrees].
  double kink(const Corners &ridge) const;

private:
  double size = 0.; ///< of the body

  Vector normal_at(unsigned int facet, const Corners &ridge) const;
  bool   stands_out(const Corners &ridge, const std::set<unsigned int> &smooth) const;
  void   divide();
  void   find_flats();
};
} // namespace snug::mesh_file

#endif
