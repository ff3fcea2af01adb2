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
/// Names of the bodies in the order of the mesh, for "body.boundary".
struct BodyNames
{
  std::vector<std::string> names;
};

/// How a body's nodes follow its shaped face, see interior.h.
enum class InteriorKind
{
  linear_blending,
  Laplace,
  elasticity
};
inline Names names(InteriorKind)
{
  return {{"linear blending",
           "in boxes, a share of the face's move that falls linearly to zero at the opposite "
           "face"},
          {"Laplace", "each component of the move is harmonic"},
          {"elasticity", "the body is elastic, the stiffer the smaller its cells"}};
}

/// Entries of `subsection Shape` or `subsection Shape NAME`.
struct ShapeParameters
{
  std::string               name;           ///< empty: of the only shape
  std::string               basis = "none"; ///< of shape_basis_table()
  std::string               face;           ///< "body.boundary"
  std::vector<std::string>  bodies;         ///< instead of a face
  std::vector<unsigned int> control_points; ///< per axis
  unsigned int              degree = 3;     ///< of B-splines
  /// of the moves; empty: normal to the face, or in boxes every axis
  std::vector<double> direction;
  std::vector<double> box_corner, box_size; ///< [length]
  /// formulas, one per component, of each mode
  std::vector<std::vector<std::string>> modes;
  double                                filter_radius = 0.; ///< [length]
  /// axis -> coordinate [length] of a mirror plane across it
  std::map<std::string, double> symmetry;
  std::vector<std::string>      fixed; ///< "border", control point indices
  InteriorKind                  interior = InteriorKind::linear_blending;
  double                        reach    = 0.; ///< of the interior [length]; 0: all of it
  std::vector<double>           bounds;        ///< lower, upper
  std::vector<double>           initial;       ///< one for all, one each, or empty: 0

  /// "Shape" or "Shape NAME".
  std::string section() const { return name.empty() ? "Shape" : "Shape " + name; }

  void declare(Entries &entries);
  /// As far as no mesh is needed.
  void check(const SectionCheck &section) const;

  /// Whether its basis reads an entry. Of formula modes, Face decides which.
  bool reads(const std::string &entry) const;

  /// Whether its basis moves any nodes: those of a face or of bodies.
  bool moves() const { return reads("Face") || reads("Bodies"); }

  /// Path of an entry, for messages.
  std::string path(const std::string &entry) const { return section() + "/" + entry; }
};
} // namespace snug::shape

#endif
