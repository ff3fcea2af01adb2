#ifndef snug_mesh_file_curved_boundary_h
#define snug_mesh_file_curved_boundary_h

#include <snug/mesh_file/surface_shapes.h>

namespace snug::mesh_file {
/**
 * This class computes the curves and patches of the true surface of a body. An edge between two
 * facets of one shape lies on the shape. An edge on a feature lies on the intersection of two
 * shapes. If one of the shapes is smooth or quadratic, then the edge is a cubic curve through the
 * nodes of the feature, which is equal for both sides.
 */
template <int dim>
class CurvedBoundary
{
public:
  using Corners = std::vector<unsigned int>;
  using Point   = dealii::Point<dim>;
  using Vector  = dealii::Tensor<1, dim>;

  /// @p surface and @p shapes must outlive this object.
  CurvedBoundary(const BodySurface<dim> &surface, const SurfaceShapes<dim> &shapes);

  /// Curves by edges of elements, with the corners in ascending order, from the first corner to the
  /// second. All other edges are straight.
  std::map<Corners, std::shared_ptr<geometry::Curve<dim>>> curves;
  /// patches by facets, in 2D the curves; null: straight
  std::vector<std::shared_ptr<geometry::Patch<dim>>> patches;

  /// Return whether a facet lies up to rounding on its known surface.
  bool is_on_known(unsigned int facet) const;

private:
  using Kind = typename SurfaceShapes<dim>::Kind;

  const BodySurface<dim>                      &surface;
  const SurfaceShapes<dim>                    &shapes;
  std::map<unsigned int, std::vector<Corners>> chains; ///< node -> edges of curves
  /// {part, node} -> normal
  std::map<std::pair<unsigned int, unsigned int>, Vector> normals;

  void                                  find_chains();
  const Corners                        *next(const Corners &edge, unsigned int node) const;
  bool                                  is_straight(const Corners &edge) const;
  std::vector<unsigned int>             facets_of(const Corners &edge) const;
  std::vector<Point>                    walk(const Corners *edge, unsigned int node) const;
  Vector                                tangent(const Corners &edge, unsigned int node) const;
  Vector                                normal(unsigned int part, unsigned int node);
  std::array<Vector, 2>                 coefficients(const Corners                            &edge,
                                                     const geometry::GeometryConstraints<dim> &constraints);
  void                                  add_curve(const Corners &edge);
  std::shared_ptr<geometry::Patch<dim>> patch(unsigned int facet) const;
};
template <>
bool CurvedBoundary<2>::is_on_known(unsigned int facet) const;
template <>
bool CurvedBoundary<3>::is_on_known(unsigned int facet) const;
} // namespace snug::mesh_file

#endif
