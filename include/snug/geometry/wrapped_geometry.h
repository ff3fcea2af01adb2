#ifndef snug_geometry_wrapped_geometry_h
#define snug_geometry_wrapped_geometry_h

#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
/// This class returns the results of another geometry. Derived classes change some of the results.
template <int dim>
class WrappedGeometry : public BodyGeometry<dim>
{
public:
  using Point = dealii::Point<dim>;

  explicit WrappedGeometry(std::unique_ptr<BodyGeometry<dim>> body) : body(std::move(body)) {}

  typename BodyGeometry<dim>::CoarseMesh coarse_mesh() const override
  {
    return body->coarse_mesh();
  }

  bool has_all_cells() const override { return body->has_all_cells(); }

  double n_coarse_cells() const override { return body->n_coarse_cells(); }

  const std::vector<std::string> &boundary_names() const override { return body->boundary_names(); }

  std::vector<std::string> region_names() const override { return body->region_names(); }

  unsigned int region(unsigned int coarse_cell) const override { return body->region(coarse_cell); }

  ElementPart<dim> element_part(unsigned int coarse_cell) const override
  {
    return body->element_part(coarse_cell);
  }

  std::vector<KnownSurface<dim>> known_surfaces() const override { return body->known_surfaces(); }

  unsigned int known_surface(unsigned int coarse_cell, unsigned int face) const override
  {
    return body->known_surface(coarse_cell, face);
  }

  BoundaryShape boundary_shape(unsigned int boundary) const override
  {
    return body->boundary_shape(boundary);
  }

  Point position(const MeshPoint<dim> &point) const override { return body->position(point); }

  Point logical(const MeshPoint<dim> &point) const override { return body->logical(point); }

  dealii::Tensor<1, dim> extent() const override { return body->extent(); }

  const CellGrid<dim> *grid() const override { return body->grid(); }

  unsigned int side_boundary(unsigned int coarse_cell, unsigned int face) const override
  {
    return body->side_boundary(coarse_cell, face);
  }

  bool is_box_side(unsigned int boundary) const override { return body->is_box_side(boundary); }

  Point box_fraction(const Point &logical) const override { return body->box_fraction(logical); }

  Point box_position(const Point &fraction) const override { return body->box_position(fraction); }

protected:
  std::unique_ptr<BodyGeometry<dim>> body;
};
} // namespace snug::geometry

#endif
