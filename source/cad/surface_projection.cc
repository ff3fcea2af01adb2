#include <snug/cad/surface_projection.h>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>

#include <algorithm>
#include <cmath>

namespace snug::cad {
namespace {
using Parameters = std::array<double, 2>;

/// The gradient and the Hessian of |S(u, v) - x|^2 / 2, and the derivatives of S.
struct SquareDistance
{
  SquareDistance(const GeomAdaptor_Surface &surface, const Parameters &at, const gp_XYZ &x)
  {
    gp_Pnt on;
    gp_Vec uu, vv, uv;
    surface.D2(at[0], at[1], on, along[0], along[1], uu, vv, uv);
    const gp_Vec off = on.XYZ() - x;
    gradient         = {{off * along[0], off * along[1]}};
    hessian          = {{along[0] * along[0] + off * uu, along[1] * along[1] + off * vv,
                         along[0] * along[1] + off * uv}};
  }

  /// Return the step to the minimum of the quadratic model. The parameters that are @p held do not
  /// change. Return nothing if the model has no minimum.
  std::optional<Parameters> step(const std::array<bool, 2> &held) const
  {
    if (held[0] && held[1])
      return Parameters{{0., 0.}};
    for (const unsigned int d : {0u, 1u})
      if (!held[d] && !(hessian[d] > 0.))
        return {};
    if (held[0])
      return Parameters{{0., -gradient[1] / hessian[1]}};
    if (held[1])
      return Parameters{{-gradient[0] / hessian[0], 0.}};
    const double determinant = hessian[0] * hessian[1] - hessian[2] * hessian[2];
    if (!(determinant > 1e-10 * hessian[0] * hessian[1]))
      return {};
    return Parameters{{(hessian[2] * gradient[1] - hessian[1] * gradient[0]) / determinant,
                       (hessian[2] * gradient[0] - hessian[0] * gradient[1]) / determinant}};
  }

  std::array<gp_Vec, 2> along;
  Parameters            gradient;
  std::array<double, 3> hessian; ///< uu, vv, uv
};
} // namespace

SurfaceProjection::SurfaceProjection(const TopoDS_Face &face)
  : surface(BRep_Tool::Surface(face)), search(new ShapeAnalysis_Surface(surface.Surface()))
{
  surface.Surface()->Bounds(lower[0], upper[0], lower[1], upper[1]);
  const std::array<bool, 2> is_periodic = {
    {bool(surface.IsUPeriodic()), bool(surface.IsVPeriodic())}};
  for (unsigned int d = 0; d < 2; ++d)
    if (is_periodic[d])
      {
        lower[d] = -HUGE_VAL;
        upper[d] = HUGE_VAL;
      }
  Parameters first, last;
  BRepTools::UVBounds(face, first[0], last[0], first[1], last[1]);
  const unsigned int n = 6, m = 5;
  static_assert(n * n == n_blocks);
  for (unsigned int b = 0; b < n_blocks; ++b)
    {
      Block block;
      for (unsigned int k = 0; k < m * m; ++k)
        {
          const std::array<unsigned int, 2> index = {{b / n * m + k / m, b % n * m + k % m}};
          Parameters                        at;
          for (unsigned int d = 0; d < 2; ++d)
            at[d] = first[d] + (last[d] - first[d]) * index[d] / (n * m - 1);
          block.samples.push_back({at, surface.Value(at[0], at[1]).XYZ()});
        }
      block.centre = block.samples[m * m / 2].on;
      for (const auto &sample : block.samples)
        block.radius = std::max(block.radius, (sample.on - block.centre).Modulus());
      blocks.push_back(block);
    }
  for (const auto &block : blocks)
    size = std::max(size, (block.centre - blocks[0].centre).Modulus());
}

dealii::Point<3> SurfaceProjection::project(const dealii::Point<3> &x) const
{
  const gp_Pnt2d at = parameters({x[0], x[1], x[2]});
  const gp_Pnt   on = surface.Value(at.X(), at.Y());
  return {on.X(), on.Y(), on.Z()};
}

gp_Pnt2d SurfaceProjection::parameters(const gp_Pnt &x) const
{
  const Sample *closest = nullptr;
  double        least   = HUGE_VAL;
  const auto    visit   = [&](const Block &block) {
    for (const auto &sample : block.samples)
      {
        const double distance = (sample.on - x.XYZ()).SquareModulus();
        if (distance < least)
          {
            least   = distance;
            closest = &sample;
          }
      }
  };
  std::array<double, n_blocks> distances;
  for (unsigned int b = 0; b < n_blocks; ++b)
    distances[b] = (blocks[b].centre - x.XYZ()).Modulus();
  const auto first = std::min_element(distances.begin(), distances.end()) - distances.begin();
  visit(blocks[first]);
  for (unsigned int b = 0; b < n_blocks; ++b)
    if (b != first && distances[b] - blocks[b].radius < std::sqrt(least))
      visit(blocks[b]);
  const auto at = near(x.XYZ(), *closest);
  return at ? gp_Pnt2d((*at)[0], (*at)[1]) : search->ValueOfUV(x, 1e-12);
}

std::optional<Parameters> SurfaceProjection::near(const gp_XYZ &x, const Sample &start) const
{
  Parameters at = start.at;
  for (unsigned int turn = 0; turn < 20; ++turn)
    {
      const SquareDistance distance(surface, at, x);
      std::array<bool, 2>  held;
      for (unsigned int d = 0; d < 2; ++d)
        held[d] = (at[d] <= lower[d] && distance.gradient[d] > 0.) ||
                  (at[d] >= upper[d] && distance.gradient[d] < 0.);
      const auto step = distance.step(held);
      if (!step)
        return {};
      double length = 0.;
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double next = std::clamp(at[d] + (*step)[d], lower[d], upper[d]);
          length += std::abs(next - at[d]) * distance.along[d].Magnitude();
          at[d] = next;
        }
      // The error after a step is of the order of the square of the step, that is of the rounding.
      if (length > 1e-9 * size)
        continue;
      const gp_XYZ on = surface.Value(at[0], at[1]).XYZ();
      if ((on - x).Modulus() > (start.on - x).Modulus() + 1e-9 * size)
        return {};
      return at;
    }
  return {};
}
} // namespace snug::cad
