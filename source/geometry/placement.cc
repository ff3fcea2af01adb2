#include <snug/geometry/entry_values.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/placement.h>
#include <snug/geometry/rigid_motion.h>
#include <snug/geometry/wrapped_geometry.h>

#include <deal.II/base/tensor.h>

namespace snug::geometry {
template <int dim>
dealii::Tensor<2, dim> rotation_of(const BodyMeshParameters &parameters)
{
  auto result = dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  for (const auto &turn : parameters.rotate)
    {
      const unsigned int axis = axis_called(turn.first);
      std::istringstream text(turn.second);
      double             degrees = 0.;
      if (axis == 3 || (dim == 2 && axis != 2) || !(text >> degrees) || !(text >> std::ws).eof() ||
          !std::isfinite(degrees))
        throw bad_entry("Rotate", turn.first + ": " + turn.second,
                        dim == 2 ? "must be 'z: degrees'"
                                 : "must be 'axis: degrees, ...', axes "
                                   "x, y, z");
      // Rotations are applied in the order in which they are written.
      result = rotation<dim>(axis, degrees) * result;
    }
  return result;
}

namespace {
/// A geometry with positions x' = Q s (x + w(x)) + t. Logical coordinates are not changed.
template <int dim>
class PlacedGeometry : public WrappedGeometry<dim>
{
public:
  using Point = dealii::Point<dim>;

  PlacedGeometry(std::unique_ptr<BodyGeometry<dim>> body, const BodyMeshParameters &parameters)
    : WrappedGeometry<dim>(std::move(body)), scale(parameters.scale)
  {
    // A negative scale would mirror the body and invert the cells.
    if (!(std::isfinite(scale) && scale > 0.))
      throw bad_entry("Scale", to_text(scale), "must be positive");
    const auto shifts = per_axis<dim, double>("Shift", parameters.shift, 0., false);
    for (unsigned int d = 0; d < dim; ++d)
      shift[d] = shifts[d];
    turned = rotation_of<dim>(parameters);
    if (!parameters.warp.empty() && parameters.warp.size() != dim)
      throw bad_entry("Warp", to_text(parameters.warp),
                      "must be " + std::to_string(dim) + " formulas separated by semicolons");
    for (const auto &text : parameters.warp)
      warp.emplace_back("Warp", text);
  }

  Point position(const MeshPoint<dim> &point) const override
  {
    return place(this->body->position(point));
  }

  // A warp changes all shapes, so a warped body has no known surfaces, see known_surface().
  std::vector<KnownSurface<dim>> known_surfaces() const override
  {
    std::vector<KnownSurface<dim>> result;
    for (const auto &surface : this->body->known_surfaces())
      result.push_back(surface.placed(scale, turned, shift));
    return result;
  }

  unsigned int known_surface(unsigned int coarse_cell, unsigned int face) const override
  {
    return warp.empty() ? this->body->known_surface(coarse_cell, face) : this->no_surface;
  }

  BoundaryShape boundary_shape(unsigned int boundary) const override
  {
    const auto shape = this->body->boundary_shape(boundary);
    return {shape.name + (warp.empty() ? "" : " moved by 'Warp'"), scale * shape.facet_height};
  }

  // The frame is placed like the body, because interiors of shapes use lengths in the frame.
  Point box_position(const Point &fraction) const override
  {
    return place(this->body->box_position(fraction));
  }

private:
  std::vector<Formula<dim>> warp;
  double                    scale;
  dealii::Tensor<2, dim>    turned;
  dealii::Tensor<1, dim>    shift;

  Point place(const Point &position) const
  {
    // All formulas are evaluated at the position before the warp.
    Point warped = position;
    for (unsigned int d = 0; d < warp.size(); ++d)
      warped[d] += warp[d].value(position);
    return Point(turned * (scale * warped) + shift);
  }
};
} // namespace

template <int dim>
std::unique_ptr<BodyGeometry<dim>> placed(std::unique_ptr<BodyGeometry<dim>> geometry,
                                          const BodyMeshParameters          &parameters)
{
  if (parameters.warp.empty() && parameters.scale == 1. && parameters.rotate.empty() &&
      parameters.shift.empty())
    return geometry;
  return std::make_unique<PlacedGeometry<dim>>(std::move(geometry), parameters);
}

template dealii::Tensor<2, 3>             rotation_of<3>(const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<2>> placed(std::unique_ptr<BodyGeometry<2>>,
                                                 const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> placed(std::unique_ptr<BodyGeometry<3>>,
                                                 const BodyMeshParameters &);
} // namespace snug::geometry
