#ifndef snug_scene_load_parameters_h
#define snug_scene_load_parameters_h

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace snug::scene {
/**
 * Dead loads on faces and prescribed displacements: those of a body, by
 * boundary, or of a load case, by "body.boundary". Formulas are of the
 * reference position.
 */
struct LoadParameters
{
  /// formula [force / length^2], positive pushes on the body
  std::map<std::string, std::string> pressure;
  /// formulas of the components, separated by blanks [force / length^2]
  std::map<std::string, std::string> traction;
  /// total force [force]
  std::map<std::string, std::vector<double>> force;
  /// about the centroid of the face [force length]; one number in 2D
  std::map<std::string, std::vector<double>> moment;
  /// "component = formula" [length]
  std::vector<std::pair<std::string, std::string>> displacements;
};

/// Entries of `subsection Load case NAME`.
struct LoadCaseParameters
{
  std::string         name;
  double              weight = 1.; ///< in the objective
  LoadParameters      loads;       ///< besides those of the bodies
  std::vector<double> gravity;     ///< [length / time^2], besides the scene's
};
} // namespace snug::scene

#endif
