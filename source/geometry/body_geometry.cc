#include <snug/base/assertions.h>
#include <snug/geometry/body_sources.h>
#include <snug/geometry/boundary_formulas.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/placement.h>
#include <snug/geometry/regions.h>


namespace snug::geometry {
template <int dim>
dealii::Point<dim> BodyGeometry<dim>::box_fraction(const dealii::Point<dim> &) const
{
  SNUG_ASSERT(false, "the geometry has no frame");
  return {};
}

template <int dim>
dealii::Point<dim> BodyGeometry<dim>::box_position(const dealii::Point<dim> &) const
{
  SNUG_ASSERT(false, "the geometry has no frame");
  return {};
}

namespace {
template <int dim>
std::unique_ptr<BodyGeometry<dim>> made(const BodyMeshParameters &parameters)
{
  switch (parameters.source)
    {
      case Source::box:
        return make_box<dim>(parameters);
      case Source::ring:
        return make_ring<dim>(parameters);
      case Source::disc:
        if constexpr (dim == 2)
          return make_disc(parameters);
        break;
      case Source::cylinder:
      case Source::sphere:
      case Source::shell:
        if constexpr (dim == 3)
          return parameters.source == Source::cylinder ? make_cylinder(parameters)
                 : parameters.source == Source::sphere ? make_sphere(parameters)
                                                       : make_shell(parameters);
        break;
      case Source::file:
      case Source::cad:
        return make_imported<dim>(parameters);
    }
  // The body exists only in the other dimension, which is 5 - dim.
  throw bad_entry("Mesh", to_text(parameters.source),
                  "requires Dimension = " + std::to_string(5 - dim));
}
} // namespace

/// The parameter reference prints these texts.
Names names(Source)
{
  return {
    {"box",
     "box with graded cells and curved faces. Boundaries in 2D: left, right (x), bottom, top "
     "(y). Boundaries in 3D: left, right (x), front, back (y), bottom, top (z)."},
    {"ring", "ring about the origin, in 3D a hollow cylinder from z = 0 to the length. Boundaries: "
             "inner, outer, in 3D bottom and top. A half and a quarter also have start and end."},
    {"disc",
     "2D disc about the origin. Boundaries: outer. A half (y > 0) also has bottom, a quarter "
     "(x, y > 0) bottom and left."},
    {"cylinder",
     "3D cylinder about the z axis from z = 0 to the length. Boundaries: outer, bottom, "
     "top. A half (y > 0) also has front, a quarter (x, y > 0) front and left."},
    {"sphere", "3D sphere about the origin. Boundaries: outer. A half (z > 0) also has bottom, a "
               "quarter (y, z > 0) bottom and front, an eighth bottom, front and left."},
    {"shell",
     "3D sphere with a concentric spherical hole. Boundaries: those of sphere, and inner."},
    {"file", "mesh file. Boundaries have the names of the file, and free if they have no name."},
    {"cad", "solid of a CAD file, in 2D a plane face, which the program gmsh meshes by elements of "
            "second order. Boundaries have the names of faces of the file, or numbers: face-3."}};
}

template <int dim>
std::unique_ptr<BodyGeometry<dim>> make_geometry(const BodyMeshParameters &parameters)
{
  // Regions and boundaries are added after the placement, because their formulas take placed
  // positions.
  return with_boundary_formulas(with_regions(placed(made<dim>(parameters), parameters), parameters),
                                parameters);
}

template <int dim>
unsigned int boundary_index(const BodyGeometry<dim> &geometry, const std::string &name)
{
  const auto        &names = geometry.boundary_names();
  const unsigned int index = index_of(names, name);
  if (index == names.size())
    // The message does not name the entry, because only the callers know the entry.
    throw InputError("'" + name + "' is not a face; the faces are " + to_text(names));
  return index;
}

template class BodyGeometry<2>;
template class BodyGeometry<3>;
template std::unique_ptr<BodyGeometry<2>> make_geometry(const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> make_geometry(const BodyMeshParameters &);
template unsigned int boundary_index(const BodyGeometry<2> &, const std::string &);
template unsigned int boundary_index(const BodyGeometry<3> &, const std::string &);
} // namespace snug::geometry
