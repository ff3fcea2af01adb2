#include <snug/geometry/body_sources.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/grid_geometry.h>
#include <snug/geometry/round_body.h>

#include <deal.II/base/numbers.h>

namespace snug::geometry {
namespace {
/// Return the numbers of cells in the order of the axes, from the order of the entry (around,
/// across, along). Two cells around a full ring would be flat, because all vertices of a cell would
/// lie on one line.
template <int dim>
std::array<unsigned int, dim> ring_cells(const BodyMeshParameters &parameters)
{
  const auto given = round_cells(parameters, dim);
  if (parameters.part == Part::full && given[0] < 3)
    throw bad_entry("Cells", to_text(given), "must be at least 3 around a full ring");
  std::array<unsigned int, dim> cells;
  cells[dim - 1] = given[0];
  cells[dim - 2] = given[1];
  if (dim == 3)
    cells[0] = given[2];
  return cells;
}

/// Return the names of the faces in the order of boundaries 2d + s.
template <int dim>
std::vector<std::string> ring_faces(const Part part)
{
  std::vector<std::string> names;
  if (dim == 3)
    names = {"bottom", "top"};
  names.insert(names.end(), {"inner", "outer"});
  if (part != Part::full)
    names.insert(names.end(), {"start", "end"});
  return names;
}

/**
 * A ring or hollow cylinder. The logical axes are radius, angle in 2D and height, radius, angle in
 * 3D. The axis of the angle, the last axis, is closed in a full ring, which has no frame.
 */
template <int dim>
class RingGeometry : public GridGeometry<dim>
{
public:
  explicit RingGeometry(const BodyMeshParameters &parameters)
    : GridGeometry<dim>(ring_cells<dim>(parameters),
                        ring_faces<dim>(parameters.part),
                        parameters.part == Part::full)
    , inner(parameters.inner_radius)
    , outer(parameters.radius)
    , length(parameters.length)
    , angle(2. * dealii::numbers::PI / n_of_part(parameters, 4))
  {
    // The initialization accepts any numbers, so the numbers are checked afterwards.
    require_radii(parameters);
    if (dim == 3)
      require_positive("Length", length);
  }

  dealii::Tensor<1, dim> extent() const override
  {
    dealii::Tensor<1, dim> result;
    // This is the height in 3D. In 2D axis 0 is the radius, which the next line sets.
    result[0]       = length;
    result[dim - 2] = outer - inner;
    // The length along the angle is the arc halfway between the circles.
    result[dim - 1] = angle * (inner + outer) / 2.;
    return result;
  }

  dealii::Point<dim> box_fraction(const dealii::Point<dim> &logical) const override
  {
    return logical;
  }

  dealii::Point<dim> box_position(const dealii::Point<dim> &fraction) const override
  {
    // The axes (r, phi) in 2D and (z, r, phi) in 3D, in this order, give right-handed cells.
    const double       r   = inner + (outer - inner) * fraction[dim - 2];
    const double       phi = angle * fraction[dim - 1];
    dealii::Point<dim> position;
    position[0] = r * std::cos(phi);
    position[1] = r * std::sin(phi);
    if (dim == 3)
      position[dim - 1] = length * fraction[0];
    return position;
  }

  dealii::Point<dim> grid_position(const dealii::Point<dim> &logical) const override
  {
    return box_position(logical);
  }

  std::vector<KnownSurface<dim>> known_surfaces() const override
  {
    KnownSurface<dim> hole;
    if (dim == 3)
      {
        hole.kind          = KnownSurface<dim>::Kind::cylinder;
        hole.axis[dim - 1] = 1.;
      }
    hole.radius           = inner;
    hole.encloses_body    = false;
    KnownSurface<dim> rim = hole;
    rim.radius            = outer;
    rim.encloses_body     = true;
    return {hole, rim};
  }

  unsigned int known_surface(unsigned int coarse_cell, unsigned int face) const override
  {
    return face / 2 == dim - 2 && this->at_side(coarse_cell, face) ? face % 2 : this->no_surface;
  }

  BoundaryShape boundary_shape(unsigned int boundary) const override
  {
    if (boundary / 2 == dim - 2)
      return {known_surfaces()[boundary % 2].name()};
    return {};
  }

private:
  double inner, outer, length, angle;
};
} // namespace

template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_ring(const BodyMeshParameters &parameters)
{
  return std::make_unique<RingGeometry<dim>>(parameters);
}

template std::unique_ptr<BodyGeometry<2>> make_ring(const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> make_ring(const BodyMeshParameters &);
} // namespace snug::geometry
