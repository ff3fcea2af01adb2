#include <snug/geometry/body_sources.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/placement.h>
#include <snug/geometry/regions.h>

#include <deal.II/base/exceptions.h>

namespace snug::geometry {
template <int dim>
dealii::Point<dim> BodyGeometry<dim>::box_fraction(const dealii::Point<dim> &) const
{
  Assert(false, dealii::ExcMessage("no frame"));
  return {};
}

template <int dim>
dealii::Point<dim> BodyGeometry<dim>::box_position(const dealii::Point<dim> &) const
{
  Assert(false, dealii::ExcMessage("no frame"));
  return {};
}

namespace {
template <int dim>
using Make = std::unique_ptr<BodyGeometry<dim>>(const BodyMeshParameters &);

/// @p make for bodies of dimension @p own, an error for others.
/// The table has the same rows in 2D and 3D, so that the message tells what is wrong with the
/// dimension rather than that the choice is unknown.
template <int dim, int own>
std::function<Make<dim>> only(Make<own> *make)
{
  if constexpr (dim == own)
    return make;
  else
    return [](const BodyMeshParameters &parameters) -> std::unique_ptr<BodyGeometry<dim>> {
      throw bad_entry("Mesh", parameters.source, "is for Dimension = " + std::to_string(own));
    };
}
} // namespace

/// The parameter reference shows these texts.
template <int dim>
const ChoiceTable<Make<dim>> &body_geometry_table()
{
  static const ChoiceTable<Make<dim>> table = {
    {"box",
     "box, with graded cells and curved faces; boundaries left, right (x), "
     "bottom, top (y) in 2D and left, right (x), front, back (y), bottom, "
     "top (z) in 3D",
     make_box<dim>},
    {"ring",
     "between two circles about the origin, in 3D a hollow cylinder along "
     "z from 0 to the length; boundaries inner, outer, in 3D bottom and "
     "top, of a half or a quarter start and end",
     make_ring<dim>},
    {"disc",
     "2D, about the origin; boundaries outer, of a half (y > 0) bottom, of "
     "a quarter (x, y > 0) left too",
     only<dim, 2>(make_disc)},
    {"cylinder",
     "3D, a disc from z = 0 to the length; boundaries outer, bottom, top, "
     "of a half front (y = 0), of a quarter left (x = 0) too",
     only<dim, 3>(make_cylinder)},
    {"sphere",
     "3D, about the origin; boundaries outer, of a half (z > 0) bottom, of "
     "a quarter (y, z > 0) front too, of an eighth left too",
     only<dim, 3>(make_sphere)},
    {"shell", "3D, a sphere with a concentric hole; boundary inner", only<dim, 3>(make_shell)},
    {"file",
     "the mesh file, boundaries as they are named there and free for what "
     "has no name",
     make_imported<dim>}};
  return table;
}

template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_geometry(const BodyMeshParameters &parameters)
{
  // Regions after the placement: their formulas are of placed positions.
  auto geometry = choose(body_geometry_table<dim>(), parameters.source).make(parameters);
  return with_regions(placed(std::move(geometry), parameters), parameters);
}

template <int dim>
unsigned int boundary_index(const BodyGeometry<dim> &geometry, const std::string &name)
{
  const auto        &names = geometry.boundary_names();
  const unsigned int index = index_of(names, name);
  if (index == names.size())
    // without the entry, which callers know
    throw InputError("'" + name + "' is no face; the faces are " + to_text(names));
  return index;
}

template class BodyGeometry<2>;
template class BodyGeometry<3>;
template const ChoiceTable<Make<2>>      &body_geometry_table<2>();
template const ChoiceTable<Make<3>>      &body_geometry_table<3>();
template std::unique_ptr<BodyGeometry<2>> make_geometry(const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> make_geometry(const BodyMeshParameters &);
template unsigned int boundary_index(const BodyGeometry<2> &, const std::string &);
template unsigned int boundary_index(const BodyGeometry<3> &, const std::string &);
} // namespace snug::geometry
