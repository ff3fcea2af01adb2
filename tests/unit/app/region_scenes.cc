#include <snug/io/mesh_summary.h>

#include <gtest/gtest.h>

#include <cmath>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
/// A bar of length 3 along x, its first third of rubber, the rest of steel,
/// guided at its sides and pressed at its end.
std::string bar(const std::string &mesh)
{
  return R"(
set Bodies    = bar
set Materials = steel, rubber
set Gravity   = 0, 0, 0
subsection Material rubber
  set Young's modulus = 10
  set Poisson's ratio = 0.4
  set Density         = 2
end
subsection Material steel
  set Young's modulus = 2000
  set Density         = 7
end
subsection Body bar
  set Refinements = 1
  set Materials   = core: rubber, coat: steel
  set Supports    = left: x, sides: normal
  set Pressure    = right: 3
)" + mesh +
         "\nend\n";
}

std::string of_file(const std::string &name)
{
  return bar("set Mesh = file\nset File = " SNUG_MESHES + name);
}

std::string of_formulas(unsigned int dim)
{
  auto              text  = bar(dim == 2 ? "set Box size = 3, 1\nset Box cells = 3, 2\n"
                                                         "set Region formulas = core: 1 - x; coat: 1"
                                         : "set Box size = 3, 1, 1\n"
                                                         "set Box cells = 3, 1, 1\n"
                                                         "set Region formulas = core: 1 - x; coat: 1");
  const std::string sides = "sides: normal";
  return text.replace(text.find(sides), sides.size(),
                      dim == 2 ? "bottom: y, top: y" : "bottom: z, top: z, front: y, back: y");
}

/// Stress over strain along an axis, without strain across it.
double guided_modulus(double E, double nu)
{
  return E * (1. - nu) / ((1. + nu) * (1. - 2. * nu));
}

template <int dim>
std::vector<std::string> settings(const std::string &more)
{
  return with(
    {"Dimension=" + std::to_string(dim), dim == 2 ? "Gravity=0, 0" : "Gravity=0, 0, 0", more});
}

/// u_x = -p x / M in the core and from there on -p / M of the coat.
template <int dim>
void expect_bar_in_series(const std::string &text)
{
  const double           p = 3., core = guided_modulus(10., 0.4), coat = guided_modulus(2000., 0.3);
  const SolvedScene<dim> solved(text, settings<dim>("Decomposition/Subdomains=4"));
  const double           whole = p / core + 2. * p / coat;
  for (const auto &cell : solved.mesh.cells())
    for (const unsigned int node : cell.nodes)
      {
        const double x        = solved.positions[node][0];
        const double expected = -p * (std::min(x, 1.) / core + std::max(x - 1., 0.) / coat);
        const auto  &u        = solved.state.displacement[node];
        EXPECT_NEAR(u[0], expected, 1e-9 * whole);
        for (unsigned int d = 1; d < dim; ++d)
          EXPECT_NEAR(u[d], 0., 1e-9 * whole);
      }
  EXPECT_NEAR(solved.state.strain_energy, 0.5 * p * whole, 1e-9 * p * whole);
}

/// Half of the coat's weight acts at the interface and half of it is borne by
/// the coat: compliance of a hanging bar of two materials.
template <int dim>
void expect_weight_in_series(const std::string &text)
{
  const double           g     = 2.;
  const std::string      zeros = dim == 2 ? ", 0" : ", 0, 0";
  const SolvedScene<dim> solved(text, with({"Dimension=" + std::to_string(dim), "Gravity=2" + zeros,
                                            "Element degree=2", "Body bar/Pressure="}));
  const double           core = guided_modulus(10., 0.4), coat = guided_modulus(2000., 0.3);
  const double           w_core = 2. * g, w_coat = 7. * g;
  // int N^2 / M, N = w_coat (3 - x) in the coat, 2 w_coat + w_core (1 - x)
  // in the core
  const double twice = w_coat * w_coat * 8. / 3. / coat +
                       (4. * w_coat * w_coat + 2. * w_coat * w_core + w_core * w_core / 3.) / core;
  EXPECT_NEAR(solved.state.strain_energy, 0.5 * twice, 1e-9 * twice);
}
} // namespace

TEST(RegionScenes, BarOfTwoMaterialsInSeries)
{
  expect_bar_in_series<2>(of_file("bar.inp"));
  expect_bar_in_series<3>(of_file("bar.msh"));
  expect_bar_in_series<2>(of_formulas(2));
  expect_bar_in_series<3>(of_formulas(3));
}

TEST(RegionScenes, WeightOfTwoMaterials)
{
  expect_weight_in_series<2>(of_file("bar.inp"));
  expect_weight_in_series<3>(of_file("bar.msh"));
}

TEST(RegionScenes, OneMaterialMayBeNamedForAll)
{
  const auto           sets = settings<3>("Body bar/Materials=rubber");
  const SolvedScene<3> named(of_file("bar.msh"), sets);
  const double         p = 3.;
  EXPECT_NEAR(named.state.strain_energy, 1.5 * p * p / guided_modulus(10., 0.4), 1e-8);
}

TEST(RegionScenes, RegionsAreListed)
{
  const SolvedScene<2> solved(of_file("bar.inp"), {"Dimension=2", "Gravity=0, 0"});
  const auto           body = io::summarize_mesh(solved.scene, solved.mesh).bodies.at(0);
  std::ostringstream   text;
  io::print(io::summarize_mesh(solved.scene, solved.mesh), text);
  ASSERT_EQ(body.regions.size(), 3u);
  EXPECT_EQ(body.regions[0].name, "core");
  EXPECT_EQ(body.regions[1].name, "all");
  EXPECT_EQ(body.regions[2].name, "coat");
  for (const unsigned int r : {0, 1, 2})
    {
      const unsigned int cells[] = {4, 0, 8};
      EXPECT_EQ(body.regions[r].n_cells, cells[r]);
      EXPECT_NEAR(body.regions[r].volume, cells[r] / 4., 1e-12);
    }
  EXPECT_NE(text.str().find("region coat: 8 cells, volume 2\n"), std::string::npos);
}
