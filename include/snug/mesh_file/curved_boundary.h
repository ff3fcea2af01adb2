#ifndef snug_mesh_file_curved_boundary_h
#define snug_mesh_file_curved_boundary_h

#include <snug/mesh_file/surface_shapes.h>

namespace snug::mesh_file {
/**
 * Curves and patches of the true surface of a body. Edges between two facets of a shape lie on
 * it. On features they lie where two shapes meet; where one of them is smooth or quadratic, they
 * are cubic curves through the nodes of the feature, the same for both sides.
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

  /// By edges of elements, corners ascending; from the first to the second. Others are straight.
  std::map<Corners, std::shared_ptr<geometry::Curve<dim>>> curves;
  /// By facets; in 2D the curves. Null: straight.
  std::vector<std::shared_ptr<geometry::Patch<dim>>> patches;

  /// Whether a facet lies to rounding on the known surface it is of.
  bool is_on_known(unsigned int facet) const;

private:
  using Kind = typename SurfaceShapes<dim>::Kind;

  const BodySurface<dim>                      &surface;
  const SurfaceShapes<dim>                    &shapes;
  std::map<unsigned int, std::vector<Corners>> chains; ///< edges of curves, by node
  /// of part and node
  std::map<std::pair<unsigned int, unsigned int>, Vector> normals;

  void                      find_chains();
  const Corners            *next(const Corners &edge, unsigned int node) const;
  bool                      is_straight(const Corners &edge) const;
  std::vector<unsigned int> facets_of(const Corners &edge) const;
  std::vector<Point>        walk(const Corners *edge, unsigned int node) const;
  Vector                    tangent(const Corners &edge, unsigned int node) const;
  Vector                    normal(unsigned int part, unsigned int node);
  std::array<Vector, 2>     coefficients(const Corners &edge, const geometry::Guides<dim> &guides);
  void                      add_curve(const Corners &edge);
  std::shared_ptr<geometry::Patch<dim>> patch(unsigned int facet) const;
};
template <>
bool CurvedBoundary<2>::is_on_known(unsigned int facet) const;
template <>
bool CurvedBoundary<3>::is_on_known(unsigned int facet) const;
} // namespace snug::mesh_file

#endif
