#ifndef snug_shape_shape_parameters_h
#define snug_shape_shape_parameters_h

#include <snug/base/values.h>

#include <map>
#include <string>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::shape {
/// Names of the bodies in the order of the mesh, to read entries "body.boundary".
struct BodyNames
{
  std::vector<std::string> names;
};

/// Ways in which the nodes of a body follow the shaped face of the body, see interior.h.
enum class InteriorKind
{
  automatic,
  linear_blending,
  Laplace,
  elasticity
};
inline Names names(InteriorKind)
{
  return {{"auto", "linear blending for a whole side of a box, else elasticity"},
          {"linear blending",
           "motion of the face, reduced linearly to zero at the opposite face; for boxes"},
          {"Laplace", "solution of the Laplace equation for each component of the motion"},
          {"elasticity", "solution of an elastic problem with a stiffness that grows as cells get "
                         "smaller"}};
}

/// Coordinates s and t on a face, see FaceCoordinates.
enum class Coordinates
{
  automatic,
  projection,
  arc_length,
  angle
};
inline Names names(Coordinates)
{
  return {{"auto", "projection if all normals are within 84 degrees of their mean and within 90 "
                   "degrees of a coordinate axis, else angle for surfaces of "
                   "revolution, else arc length"},
          {"projection", "positions along the coordinate axes other than the axis closest to the "
                         "normal"},
          {"arc length", "arc length along the face; in 3D along the profile of an extrusion, and "
                         "the position along the extrusion"},
          {"angle", "angle about the centre; in 3D about the axis of a surface of revolution, and "
                    "the arc length along its meridian"}};
}

/// Entries of `subsection Shape` or `subsection Shape NAME`.
struct ShapeParameters
{
  std::string               name;            ///< empty if the scene has a single unnamed shape
  std::string               basis = "none";  ///< a name of shape_basis_table()
  std::string               face;            ///< "body.boundary + ..."
  std::vector<std::string>  bodies;          ///< bodies to shape instead of a face
  std::vector<unsigned int> control_points;  ///< per axis
  unsigned int              degree      = 3; ///< of B-splines
  Coordinates               coordinates = Coordinates::automatic;
  std::vector<double>       axis, axis_point; ///< of angles and extrusions; empty: found
  double                    start_angle = 0.; ///< of closed coordinates [degree]
  std::vector<std::string>  smooth;           ///< boundaries that are symmetry planes
  /// direction of the moves; empty means the normal of the face, or every axis in boxes
  std::vector<double> direction;
  std::vector<double> box_corner, box_size; ///< [length]
  /// formulas of each mode, one per component
  std::vector<std::vector<std::string>> modes;
  double                                filter_radius = 0.; ///< [length]
  /// axis -> coordinate [length] of a mirror plane normal to the axis
  std::map<std::string, double> symmetry;
  std::vector<std::string>      fixed; ///< "border", control point indices
  /// @name Limits of the moves
  /// @{
  bool   only_remove   = false;
  double maximum_slope = 0.;    ///< 0: no limit
  bool   convex        = false; ///< the moved face
  double tool_radius   = 0.;    ///< minimum radius of concave curvature [length]; 0: no limit
  /// @}
  InteriorKind        interior = InteriorKind::automatic;
  double              reach    = 0.; ///< reach of the interior [length]; 0: the whole body
  std::vector<double> bounds;        ///< lower, upper
  std::vector<double> initial;       ///< one value, one per variable, or empty: 0
  /// output directory of a run whose last design is the initial one; empty once it is read
  std::string initial_from;

  /// Return the name of the subsection, "Shape" or "Shape NAME".
  std::string section() const { return name.empty() ? "Shape" : "Shape " + name; }

  void declare(Entries &entries);
  /// Check the entries as far as the check needs no mesh. @throws InputError naming the entry.
  void check(const SectionCheck &section) const;

  /// Return whether the basis reads an entry. For formula modes, the entry Face decides which
  /// other entries are read.
  bool reads(const std::string &entry) const;

  /// Return whether the basis moves any nodes, which are nodes of a face or of bodies.
  bool moves() const { return reads("Face") || reads("Bodies"); }

  /// Return the path of an entry, for messages.
  std::string path(const std::string &entry) const { return section() + "/" + entry; }
};
} // namespace snug::shape

#endif
