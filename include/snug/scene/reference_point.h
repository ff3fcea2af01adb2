#ifndef snug_scene_reference_point_h
#define snug_scene_reference_point_h

#include <optional>
#include <string>
#include <vector>

namespace snug {
class Entries;
class Origins;
} // namespace snug

namespace snug::scene {
struct LoadParameters;
struct Scene;

/// Entries of `subsection Reference point NAME`: a point with a rigid motion that faces and
/// obstacles follow.
struct ReferencePoint
{
  std::string              name;
  std::vector<double>      point;         ///< [length]; empty: the origin
  std::vector<std::string> faces;         ///< "body.boundary"
  std::vector<std::string> obstacles;     ///< names
  std::vector<std::string> supports;      ///< names of motion_names()
  std::vector<std::string> displacements; ///< "component = number" [length, rad]
  std::vector<double>      force, moment; ///< [force, force length]; empty: none

  std::string section() const { return "Reference point " + name; }

  void declare(Entries &entries);
};

/// Return the names of the unknowns of a motion: translations along the axes x, y, z, rotations
/// rx, ry, rz about them; y alone in sections of revolution.
std::vector<std::string> motion_names(const Scene &scene);

/// Return the loads of a load case on faces, without those on reference points.
LoadParameters loads_on_faces(const Scene &scene, const LoadParameters &loads);

/// Load and prescribed motion of a reference point in the order of motion_names().
struct PointLoads
{
  std::vector<double>                wrench; ///< force, moment
  std::vector<std::optional<double>> held;   ///< [length, rad]
};

/// Return the loads of a reference point and those that a load case adds, which is the number of a
/// load case, or none for a scene without load cases.
PointLoads loads_on_point(const Scene                &scene,
                          const ReferencePoint       &point,
                          std::optional<unsigned int> load_case);

/// Check the reference points and what load cases prescribe for them. @throws InputError.
void check_points(const Scene &scene, const Origins &origins);
} // namespace snug::scene

#endif
