#ifndef tests_unit_scene_scene_text_h
#define tests_unit_scene_scene_text_h

#include <snug/base/errors.h>
#include <snug/scene/read_scene.h>

#include <sstream>
#include <string>
#include <vector>

/// A valid scene of 37 lines: two boxes of different meshes in contact, the top
/// of the lower one shaped.
inline std::string scene_text()
{
  return R"(# comment
set Task      = optimize
set Dimension = 3
set Bodies    = punch, foundation

subsection Body punch
  set Box corner      = 0, 0, 1
  set Box cells       = 3, 4, 5     # comment
  set Curved faces    = bottom: sphere 4; top: 0.1*min(x,y)
  set Young's modulus = 210000
  set Poisson's ratio = 0.3
  set Supports        = left: x, \
                        front: y
  set Pressure        = top: 100
  set Traction        = top: 0 0 -5.5, left:  1 0  0
end
subsection Body foundation
  set Box size        = 2, 1, 1
  set Box cells       = 2, 2, 2
  set Box grading     = 1, 1, 0.5
  set Refinements     = 1
  set Young's modulus = 70000
  set Supports        = bottom: xyz
end
subsection Contact
  set Pairs = punch.bottom: foundation.top
end
subsection Shape
  set Basis          = Bezier patch
  set Face           = foundation.top
  set Control points = 3, 2
  set Direction      = 0, 0, 1
  set Bounds         = -0.25, 0.25
end
subsection Optimization
  set Constraints = volume: initial
end
)";
}

inline snug::scene::Scene read_with(const std::vector<std::string> &sets,
                                    const std::string              &text = scene_text())
{
  return snug::scene::read_scene({"scene.prm", text, sets, ""});
}

/// @p text with the first @p from replaced by @p to.
inline std::string replaced(std::string text, const std::string &from, const std::string &to)
{
  const auto place = text.find(from);
  return place == std::string::npos ? "" : text.replace(place, from.size(), to);
}

/// Message of the InputError that reading throws; "" if there is none.
inline std::string error_of(const std::vector<std::string> &sets,
                            const std::string              &text = scene_text())
{
  try
    {
      read_with(sets, text);
    }
  catch (const snug::InputError &error)
    {
      return error.what();
    }
  return "";
}

inline std::string printed(const snug::scene::Scene &scene)
{
  std::ostringstream text;
  snug::scene::print(scene, text);
  return text.str();
}

#endif
