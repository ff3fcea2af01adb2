#include <gradient/sensitivity/check_derivatives.h>

namespace {
using namespace snug;
using namespace snug::test;

/// A curved punch, pressed and pushed aside, on a foundation with a shaped top. Some contacts slip,
/// others stick.
template <int dim>
TestScene<dim> pushed_punch(unsigned int n_cells, double coefficient, contact::Method method)
{
  auto scene = two_blocks<dim>(n_cells, n_cells, 20.);
  set_design(scene, 4, 0.04);
  scene.bodies[0].supports.clear();
  scene.bodies[0].loads[face_index(dim - 1, 1)].traction[0] = 0.7 * 10. * coefficient;
  if (dim == 3)
    scene.bodies[0].loads[face_index(dim - 1, 1)].traction[1] = 0.3 * 10. * coefficient;
  scene.method                    = method;
  scene.friction                  = contact::Friction::Coulomb;
  scene.friction_value            = std::to_string(coefficient);
  scene.solver.relative_tolerance = 1e-12;
  return scene;
}

template <int dim>
void check(const TestScene<dim> &given)
{
  GradientScene<dim> scene(given, 0.05);
  const auto         state = scene.solve(scene.design);
  std::cout << state.active_contacts << " active, " << state.slipping_contacts << " slip, "
            << state.dissipation << " " << state.friction_distance << std::endl;
  EXPECT_GT(state.slipping_contacts, 0u);
  EXPECT_LT(state.slipping_contacts, state.active_contacts);
  check_derivatives(scene);
}

TEST(FrictionGradient, Nodal2D)
{
  check(pushed_punch<2>(12, 0.4, contact::Method::nodal));
}

TEST(FrictionGradient, Mortar2D)
{
  auto scene            = pushed_punch<2>(12, 0.4, contact::Method::mortar);
  scene.bodies[0].cells = {10, 10};
  check(scene);
}

TEST(FrictionGradient, Nodal3D)
{
  check(pushed_punch<3>(6, 0.4, contact::Method::nodal));
}
} // namespace
