#ifndef snug_scene_bolt_h
#define snug_scene_bolt_h

#include <optional>
#include <string>
#include <utility>

namespace snug {
class Entries;
class Origins;
} // namespace snug

namespace snug::scene {
struct Scene;

/// Entries of `subsection Bolt NAME`.
struct Bolt
{
  std::string           name;
  std::string           pair;                ///< "side: side" of the tied pair that cuts the shank
  std::optional<double> preload, shortening; ///< [force], [length]

  std::string section() const { return "Bolt " + name; }

  void declare(Entries &entries);

  /// Return the sides of the pair.
  std::pair<std::string, std::string> sides() const;
};

/// State of a bolt in a load case: one of both is given, or the bolt keeps its length.
struct Tightening
{
  std::optional<double> preload, shortening; ///< [force], [length]
};

/// Return the state of a bolt in the load case @p load_case, or in the scene without load cases.
Tightening tightening(const Scene &scene, const Bolt &bolt, unsigned int load_case);

/// Check the bolts and what load cases prescribe for them. @throws InputError.
void check_bolts(const Scene &scene, const Origins &origins);
} // namespace snug::scene

#endif
