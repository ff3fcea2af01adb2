#include <gtest/gtest.h>

#include <cmath>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
const double radius = 32., half_width = 0.1, modulus = 1000. / (1. - 0.3 * 0.3);
/// Force per length and maximum pressure of Hertz for the half-width.
const double force = dealii::numbers::PI * half_width * half_width * modulus / (4. * radius),
             p0    = 2. * force / (dealii::numbers::PI * half_width);

/// The right half of a cylinder on a rigid plane. The body is 80 times as large as the half-width.
std::string cylinder_on_plane(const double yield_stress)
{
  return R"(
set Dimension = 2
set Bodies = cylinder
set Obstacles = floor
subsection Body cylinder
  set Box size = 8, 8
  set Box cells = 32, 32
  set Curved faces = bottom: -(x^2)/(2*32)
  set Refine where = 0.3 - sqrt(x^2 + y^2)
  set Local refinements = 5
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
  set Yield stress = )" +
         to_text(yield_stress) + R"(
  set Supports = left: x
  set Pressure = top: )" +
         to_text(force / 16.) + R"(
end
subsection Contact
  set Pairs = cylinder.bottom: floor
end
)";
}

/// Stresses over p0 in plane strain under the pressure of Hertz, at x > 0 and the depth z in
/// half-widths. Source: Johnson, Contact Mechanics (1985), section 4.2 (after McEwen).
struct LineContact
{
  double von_mises, shear;

  LineContact(const double x, const double z, const double nu = 0.3)
  {
    const double b = 1. - x * x + z * z, root = std::sqrt(b * b + 4. * x * x * z * z);
    const double mm = 0.5 * (root + b), nn = 0.5 * (root - b), m = std::sqrt(mm);
    const double s_x = 2. * z - m * (1. + (z * z + nn) / (mm + nn)),
                 s_z = -m * (1. - (z * z + nn) / (mm + nn)), s_y = nu * (s_x + s_z);
    shear = std::sqrt(std::max(0., nn)) * (mm - z * z) / (mm + nn);
    von_mises =
      std::sqrt(0.5 * (std::pow(s_x - s_y, 2) + std::pow(s_y - s_z, 2) + std::pow(s_z - s_x, 2)) +
                3. * shear * shear);
  }
};

/// Maxima over the half-plane, and where the von Mises stress exceeds a part of p0.
struct Maxima
{
  double von_mises = 0., at = 0., shear = 0., area = 0., depth = 0.;

  explicit Maxima(const double part)
  {
    const double h = 0.005; // half-widths
    for (double z = 0.5 * h; z < 3.; z += h)
      for (double x = 0.5 * h; x < 3.; x += h)
        {
          const LineContact stress(x, z);
          if (stress.von_mises > von_mises)
            {
              von_mises = stress.von_mises;
              at        = z;
            }
          shear = std::max(shear, std::abs(stress.shear));
          if (stress.von_mises > part)
            {
              area += h * h;
              depth = std::max(depth, z);
            }
        }
  }
};

/// The limits that the log and doc/theory.md state, in yield stresses in shear k. No residual
/// stress changes the shear along the surface, so that k bounds its maximum after shakedown.
TEST(Yield, LimitsOfLineContact)
{
  const Maxima exact(0.45);
  EXPECT_NEAR(exact.von_mises, 0.558, 0.001);
  EXPECT_NEAR(exact.at, 0.704, 0.005);
  EXPECT_NEAR(std::sqrt(3.) / exact.von_mises, 3.1, 0.05);
  EXPECT_NEAR(1. / exact.shear, 4., 0.01);
}

TEST(Yield, UnderALineContact)
{
  const double         part = 0.45;
  const Maxima         exact(part);
  const SolvedScene<2> solved(cylinder_on_plane(part * p0));
  const auto           peak = solved.state.stress_peak();
  // 13 cells over the half-width, of degree 1, and a body that is no half-plane
  EXPECT_NEAR(solved.state.max_pressure, p0, 0.01 * p0);
  EXPECT_NEAR(peak.von_mises, exact.von_mises * p0, 0.02 * exact.von_mises * p0);
  EXPECT_NEAR(peak.place[1], exact.at * half_width, 0.1 * half_width);
  EXPECT_NEAR(peak.yield.utilization, exact.von_mises / part, 0.02 * exact.von_mises / part);
  EXPECT_NEAR(peak.yield.pressure_over_shear, std::sqrt(3.) / part, 0.01 * std::sqrt(3.) / part);
  EXPECT_NEAR(peak.yield.depth, exact.depth * half_width, 0.08 * half_width); // a cell
  const double area = exact.area * half_width * half_width;
  EXPECT_NEAR(peak.yield.volume, area, 0.06 * area);
}

TEST(Yield, IsNotReachedBelowIt)
{
  const SolvedScene<2> solved(cylinder_on_plane(p0));
  const auto           yield = solved.state.stress_peak().yield;
  EXPECT_LT(yield.utilization, 0.6);
  EXPECT_EQ(yield.volume, 0.);
  EXPECT_EQ(yield.depth, 0.);
  const SolvedScene<2> without(cylinder_on_plane(0.));
  EXPECT_EQ(without.state.stress_peak().yield.yield_stress, 0.);
}
} // namespace
