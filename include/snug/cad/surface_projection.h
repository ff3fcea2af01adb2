#ifndef snug_cad_surface_projection_h
#define snug_cad_surface_projection_h

#include <snug/geometry/known_surface.h>

#include <GeomAdaptor_Surface.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>

#include <array>
#include <optional>

namespace snug::cad {
/**
 * This class projects points on the surface of a face, beyond the edges of the face as well.
 * Newton's method starts from the closest one of fixed samples of the face, so that the result does
 * not depend on the points that were projected before. If Newton's method fails, OpenCASCADE
 * searches the whole surface, which takes at least thirty times as long.
 */
class SurfaceProjection : public geometry::Projection<3>
{
public:
  explicit SurfaceProjection(const TopoDS_Face &face);

  dealii::Point<3> project(const dealii::Point<3> &x) const override;

  /// Return the parameters (u, v) of the projection of @p x.
  gp_Pnt2d parameters(const gp_Pnt &x) const;

private:
  struct Sample
  {
    std::array<double, 2> at; ///< u and v
    gp_XYZ                on; ///< S(u, v)
  };

  /// Samples of a part of the face, which lie in a ball.
  struct Block
  {
    std::vector<Sample> samples = {};
    gp_XYZ              centre  = {};
    double              radius  = 0.;
  };

  static constexpr unsigned int n_blocks = 36;

  GeomAdaptor_Surface surface;
  Handle(ShapeAnalysis_Surface) search;
  std::array<double, 2> lower, upper; ///< bounds of u and v; infinite if periodic
  std::vector<Block>    blocks;
  double                size = 0.; ///< about the diameter of the face [length]

  /// Return the parameters of the projection by Newton's method, or nothing if it fails.
  std::optional<std::array<double, 2>> near(const gp_XYZ &x, const Sample &start) const;
};
} // namespace snug::cad

#endif
