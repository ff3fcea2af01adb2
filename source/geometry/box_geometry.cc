#include <snug/geometry/axis_spacing.h>
#include <snug/geometry/body_sources.h>
#include <snug/geometry/curved_face.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/grid_geometry.h>

#include <cmath>
#include <limits>

namespace snug::geometry {
namespace {
/**
 * Positions of the inner nodes of equal cells along an axis. The distance of the nodes is rounded
 * to so few digits that sums of distances are exact. All cells, and subdomains, then have the same
 * K to the last bit, so that subdomains share a factorization. Nodes move only by round-off.
 */
class EqualSteps
{
public:
  /// Construct an object without nodes, for a graded axis.
  EqualSteps() = default;

  EqualSteps(const double corner, const double size, const unsigned int the_n) : n(the_n)
  {
    // value of the last binary digit that all node coordinates have
    const double unit =
      std::ldexp(1., std::ilogb(std::abs(corner) + size) + 1 - std::numeric_limits<double>::digits);
    first  = std::round(corner / unit) * unit;
    length = std::round(size / n / (parts * unit)) * parts * unit;
  }

  bool is_node(const double fraction) const
  {
    const double place = fraction * n;
    return place > 0.5 / parts && place < n - 0.5 / parts &&
           std::abs(place - nearest(place)) < 1e-12;
  }

  double node(const double fraction) const { return first + nearest(fraction * n) * length; }

private:
  /// Parts of a cell at whose ends nodes lie. Four parts suffice for degree 2, for two refinements,
  /// and for degree 2 with one refinement.
  static constexpr double parts = 4.;

  static double nearest(const double place) { return std::round(place * parts) / parts; }

  double n = 0., first = 0., length = 0.;
};

/// Return the names of the faces in the order of boundaries 2d + s.
template <int dim>
std::vector<std::string> box_faces()
{
  if (dim == 2)
    return {"left", "right", "bottom", "top"};
  return {"left", "right", "front", "back", "bottom", "top"};
}

/**
 * A box with graded cells and curved faces. The logical coordinate xi of an
 * axis is mapped to the fraction f(xi) of the length of the axis (AxisSpacing). Each curved
 * face moves along its outward normal. The displacement decreases linearly with
 * f to zero at the opposite face.
 */
template <int dim>
class BoxGeometry : public GridGeometry<dim>
{
public:
  explicit BoxGeometry(const BodyMeshParameters &parameters)
    : GridGeometry<dim>(per_axis<dim, unsigned int>("Box cells", parameters.cells, 1, true),
                        box_faces<dim>())
    , corner(per_axis<dim, double>("Box corner", parameters.corner, 0., false))
    , size(per_axis<dim, double>("Box size", parameters.size, 1., true))
  {
    set_spacing(parameters);
    for (const auto &face : parameters.curved_faces)
      add_curved_face(face.first, face.second);
    for (const auto &face : curved_faces)
      check(face);
  }

  dealii::Tensor<1, dim> extent() const override
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = size[d];
    return result;
  }

  bool is_box_side(const unsigned int) const override { return true; }

  dealii::Point<dim> box_fraction(const dealii::Point<dim> &logical) const override
  {
    dealii::Point<dim> fraction;
    for (unsigned int d = 0; d < dim; ++d)
      fraction[d] = spacing[d].fraction(logical[d]);
    return fraction;
  }

  dealii::Point<dim> box_position(const dealii::Point<dim> &fraction) const override
  {
    dealii::Point<dim> position;
    for (unsigned int d = 0; d < dim; ++d)
      position[d] = steps[d].is_node(fraction[d]) ? steps[d].node(fraction[d])
                                                  : corner[d] + size[d] * fraction[d];
    return position;
  }

  dealii::Point<dim> grid_position(const dealii::Point<dim> &logical) const override
  {
    const dealii::Point<dim> fraction = box_fraction(logical);
    const dealii::Point<dim> flat     = box_position(fraction);
    dealii::Point<dim>       result   = flat;
    for (const auto &face : curved_faces)
      {
        const unsigned int axis  = face.boundary() / 2;
        const bool         upper = face.boundary() % 2 == 1;
        // Displacements are evaluated at the flat point, so that the result does not depend on the
        // order of faces and opposite faces do not move each other.
        const double blend = upper ? fraction[axis] : 1. - fraction[axis];
        result[axis] += (upper ? 1. : -1.) * blend * face.displacement(flat);
      }
    return result;
  }

  std::vector<KnownSurface<dim>> known_surfaces() const override
  {
    std::vector<KnownSurface<dim>> result;
    for (const auto &face : curved_faces)
      if (is_known(face))
        result.push_back(*face.known());
    return result;
  }

  unsigned int known_surface(unsigned int coarse_cell, unsigned int face) const override
  {
    unsigned int index = 0;
    for (const auto &curved : curved_faces)
      {
        if (curved.boundary() == face && is_known(curved) && this->at_side(coarse_cell, face))
          return index;
        index += is_known(curved);
      }
    return this->no_surface;
  }

  BoundaryShape boundary_shape(unsigned int boundary) const override
  {
    for (const auto &face : curved_faces)
      if (face.boundary() == boundary)
        return {face.known() ? face.known()->name() : "formula"};
    return {};
  }

private:
  std::array<double, dim>      corner, size;
  std::array<AxisSpacing, dim> spacing;
  std::array<EqualSteps, dim>  steps;
  std::vector<CurvedFace<dim>> curved_faces;

  /// Return whether the face has a known shape. Adjacent curved faces move points of the face off
  /// the shape, but an opposite curved face does not.
  bool is_known(const CurvedFace<dim> &face) const
  {
    return face.known() &&
           std::all_of(curved_faces.begin(), curved_faces.end(), [&](const auto &beside) {
             return beside.boundary() / 2 == face.boundary() / 2;
           });
  }

  void set_spacing(const BodyMeshParameters &parameters)
  {
    const auto &cells   = this->grid()->cells;
    const auto  grading = per_axis<dim, double>("Box grading", parameters.grading, 1., true);
    const auto  fine = per_axis<dim, double>("Box fine length", parameters.fine_length, 0., false);
    for (unsigned int d = 0; d < dim; ++d)
      {
        // The ratio of neighbouring sizes is the (n - 1)-th root of the grading, so n must
        // exceed 1.
        if (cells[d] == 1 && grading[d] != 1.)
          throw bad_entry("Box grading", to_text(parameters.grading),
                          "must be 1 along an axis with a single cell");
        if (fine[d] != 0. &&
            !(fine[d] > 0. && fine[d] < size[d] && cells[d] > 1 && grading[d] == 1.))
          throw bad_entry("Box fine length", to_text(parameters.fine_length),
                          "must be 0, or below the size of the box along "
                          "an axis with several cells and no grading");
        spacing[d] = fine[d] != 0. ? AxisSpacing::with_fine_part(cells[d], fine[d] / size[d])
                                   : AxisSpacing::graded(cells[d], grading[d]);
        if (fine[d] == 0. && grading[d] == 1.)
          steps[d] = EqualSteps(corner[d], size[d], cells[d]);
      }
  }

  /// Evaluate the displacement at all vertices of the face, so that all ranks find a formula that
  /// is not finite there. A formula that is not finite between these vertices is not found.
  void check(const CurvedFace<dim> &face) const
  {
    auto n                 = this->grid()->vertices();
    n[face.boundary() / 2] = 1;
    for (unsigned int vertex = 0; vertex < product(n); ++vertex)
      {
        const auto         at = multi_index(vertex, n);
        dealii::Point<dim> logical;
        for (unsigned int d = 0; d < dim; ++d)
          logical[d] = static_cast<double>(at[d]) / this->grid()->cells[d];
        face.displacement(box_position(box_fraction(logical)));
      }
  }

  void add_curved_face(const std::string &face, const std::string &value)
  {
    FlatFace<dim> flat;
    flat.boundary = curved_boundary(this->boundary_names(), face, value);
    flat.name     = face;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // The half size along the normal is not used.
        flat.half_size[d] = 0.5 * size[d];
        flat.centre[d]    = corner[d] + 0.5 * size[d];
      }
    const unsigned int normal = flat.boundary / 2;
    flat.centre[normal]       = corner[normal] + (flat.boundary % 2 == 1 ? size[normal] : 0.);
    curved_faces.emplace_back(flat, value);
  }
};
} // namespace

template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_box(const BodyMeshParameters &parameters)
{
  return std::make_unique<BoxGeometry<dim>>(parameters);
}

template std::unique_ptr<BodyGeometry<2>> make_box(const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> make_box(const BodyMeshParameters &);
} // namespace snug::geometry
