#ifndef snug_scene_placed_force_h
#define snug_scene_placed_force_h

#include <string>
#include <vector>

namespace snug::scene {
/// A force at a point, 'FX FY FZ at X Y Z', or per length along a line, 'FX FY FZ from X Y Z to X Y
/// Z' or 'FX FY FZ along BOUNDARY'. Members that the text does not give are empty.
struct PlacedForce
{
  std::vector<double> force;    ///< [force], along a line [force / length]
  std::vector<double> at;       ///< the point [length]
  std::vector<double> from, to; ///< the ends of the line [length]
  std::string         along;    ///< the boundary whose common edge with the loaded one is the line
};

/// Read a force. @throws std::invalid_argument unless vectors have @p dimension numbers.
PlacedForce placed_force(const std::string &text, unsigned int dimension);

/// Displacement components that are held at a point, 'xy at X Y Z' or 'x = VALUE at X Y Z'.
struct PointHold
{
  std::vector<unsigned int> components; ///< 0, 1, 2: x, y, z
  double                    value = 0.; ///< [length]
  std::vector<double>       at;         ///< the point [length]
};

/// Read a point support. @throws std::invalid_argument unless it has components along axes, and a
/// point of @p dimension numbers.
PointHold point_hold(const std::string &text, unsigned int dimension);
} // namespace snug::scene

#endif
