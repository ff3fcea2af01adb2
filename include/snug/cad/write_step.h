#ifndef snug_cad_write_step_h
#define snug_cad_write_step_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace snug::cad {
/// The spans of B-splines along one parameter of a curve or surface.
struct SplineSpans
{
  std::vector<double> breaks; ///< ends of the spans, ascending
  bool                closed; ///< periodic; function i is not zero from breaks i - degree to i + 1
};

/**
 * A face with the surface S(s, t) = sum_ij B_i(s) B_j(t) c_ij of B-splines with simple knots, or
 * the face that a curve S(s) describes.
 */
struct SplineFace
{
  /// Face of a curve.
  enum class Sweep
  {
    none,
    extruded, ///< along the direction; the parameters are (s, length)
    revolved  ///< about the axis through the centre; the parameters are (angle, s)
  };

  std::string                   name;
  unsigned int                  degree;
  std::vector<SplineSpans>      axes;   ///< one of a curve, two of a surface
  std::vector<dealii::Point<3>> points; ///< control points, the first axis fastest
  Sweep                         sweep     = Sweep::none;
  dealii::Point<3>              centre    = {};    ///< of the axis of a revolution
  dealii::Point<3>              direction = {};    ///< of the sweep, a unit vector
  double                        extent    = 1.;    ///< of the sweep [length or radian]
  bool                          reversed  = false; ///< the outward normal is opposite to S_u x S_v
  /// The loops that bound the face, the outer one first, each a list of smooth pieces through
  /// parameters (u, v) = (s, t), or those of the sweep. Without loops, the face has all parameters.
  std::vector<std::vector<std::vector<dealii::Point<2>>>> loops = {};
};

/**
 * Write faces to a STEP file (AP214). Each face is a product with the name of the face, and the
 * face entity has this name as well. Numbers are written as they are, in the unit of length @p
 * unit: m, cm, um, in, ft, km, or else mm. @throws std::runtime_error if OpenCASCADE fails. For one
 * rank.
 */
void write_step(const std::string             &path,
                const std::string             &unit,
                const std::vector<SplineFace> &faces);

/// Return whether STEP files may have the unit @p unit.
bool is_step_unit(const std::string &unit);
} // namespace snug::cad

#endif
