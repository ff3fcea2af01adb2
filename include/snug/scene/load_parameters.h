#ifndef snug_scene_load_parameters_h
#define snug_scene_load_parameters_h

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::scene {
/**
 * Dead loads on faces and prescribed displacements of a body, by boundary, or of a load case, by
 * "body.boundary". Formulas are functions of the reference position.
 */
struct LoadParameters
{
  /// formula [force / length^2]; a positive pressure pushes on the body
  std::map<std::string, std::string> pressure;
  /// formulas of the components, separated by blanks [force / length^2]
  std::map<std::string, std::string> traction;
  /// total force [force]
  std::map<std::string, std::vector<double>> force;
  /// moment about the centroid of the face [force length]; one number in 2D
  std::map<std::string, std::vector<double>> moment;
  /// forces at points [force] and along lines [force / length], see placed_force()
  std::vector<std::pair<std::string, std::string>> point_forces, line_forces;
  /// "component = formula" [length]
  std::vector<std::pair<std::string, std::string>> displacements;

  /// Declare the entries. Their keys are called @p key: boundary or body.boundary, as @p where is.
  void declare(Entries &entries, const std::string &key, const std::string &where);

  /// Pairs of a boundary, "body.boundary", and a component held there.
  using Held = std::set<std::pair<std::string, unsigned int>>;
  /// Function that throws unless a key of an entry's value names a boundary.
  using RequireKey =
    std::function<void(const std::string &entry, const std::string &value, const std::string &key)>;

  void check(const SectionCheck &section, const RequireKey &require_key) const;

  /// Check the forces at points and along lines, as check() does.
  void check_placed(const SectionCheck &section, const RequireKey &require_key) const;

  /// Check the prescribed displacements. @p held contains the components held by supports, and
  /// the prescribed components are added. @p prefix completes a key to "body.boundary".
  void
  check_displacements(const SectionCheck &section, const std::string &prefix, Held &held) const;
};

/// Entries of `subsection Load case NAME`.
struct LoadCaseParameters
{
  std::string    name;
  double         weight = 1.; ///< weight in the objective
  LoadParameters loads;       ///< loads besides those of the bodies
  /// formulas of temperatures by body, in addition to those of the bodies
  std::map<std::string, std::string> temperatures;
  std::vector<double> gravity; ///< [length / time^2], in addition to the scene's gravity
  /// cases that the section stands for; with_cases() has replaced sections with more than one
  unsigned int                  cases = 1;
  std::map<std::string, double> preloads, shortenings; ///< by bolt [force], [length]
  /// motions of bodies and obstacles by name, see geometry::rigid_motion()
  std::vector<std::pair<std::string, std::string>> positions;
  /// whether contacts continue from their slips in the load case before this one
  bool load_step = false;
  /// whether loads keep their directions in space, instead of turning with the bodies
  bool loads_in_space = false;

  std::string section() const { return "Load case " + name; }

  void declare(Entries &entries);
  /// Check that each position moves one of the bodies or obstacles called @p names.
  void check_positions(const SectionCheck &section, const std::vector<std::string> &names) const;
};

/// Declare the entry Gravity of a scene or a load case.
void declare_gravity(Entries &entries, std::vector<double> &gravity);
} // namespace snug::scene

#endif
