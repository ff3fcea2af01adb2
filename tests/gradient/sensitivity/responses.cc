#include <gradient/sensitivity/check_responses.h>

namespace {
using namespace snug;
using namespace snug::test;

/// The shape of a basis in the foundation of test scenes, small enough that
/// no contact opens or closes.
template <int dim>
shape::ShapeParameters shape_in_foundation(const std::string &basis)
{
  shape::ShapeParameters shape;
  shape.basis  = basis;
  shape.bounds = {-0.03, 0.03};
  shape.degree = 2;
  if (basis.find("box") != std::string::npos)
    {
      shape.bodies         = {"foundation"};
      shape.control_points = std::vector<unsigned int>(dim, 3);
      shape.box_corner     = std::vector<double>(dim, -0.1);
      shape.box_size       = std::vector<double>(dim, 1.3);
      // the lower side of the box cuts the foundation: frozen there
      shape.box_corner[dim - 1] = 0.3;
      shape.box_size[dim - 1]   = 0.8;
    }
  else if (basis == "formula modes")
    {
      shape.bodies = {"foundation"};
      shape.modes.assign(3, std::vector<std::string>(dim, "0"));
      const std::string up   = dim == 2 ? "y" : "z";
      shape.modes[0].back()  = up + "*x*(1-x)";
      shape.modes[1].front() = up + "^2*sin(2*x)";
      shape.modes[2].back()  = up + "*cos(3*x)";
    }
  else
    {
      shape.face           = "foundation.top";
      shape.filter_radius  = 0.5;
      shape.control_points = {4};
      if (dim == 3)
        shape.control_points.push_back(3);
      if (basis == "node-wise")
        shape.control_points.clear();
    }
  return shape;
}

/// All exact methods on all responses with the variables of one basis.
template <int dim>
void check_all_responses(const std::string &basis, contact::Method method = contact::Method::nodal)
{
  auto given                      = two_blocks<dim>(dim == 2 ? 6 : 3, 0, 3.);
  given.bodies[1].cells           = std::vector<unsigned int>(dim, 4);
  given.bodies[1].material        = {800., 0.25, 0.7, 0., 20.};
  given.bodies[0].material        = {1000., 0.3, 0.2};
  given.bodies[1].core            = {900., 0.3, 0.4, 0., 30.};
  given.bodies[1].core_from       = 0.5;
  given.solver.relative_tolerance = 1e-12;
  given.method                    = method;
  if (method == contact::Method::mortar)
    narrow_punch(given);
  GradientScene<dim> scene(given, shape_in_foundation<dim>(basis));
  check_responses(scene);
}

class EveryResponse : public testing::TestWithParam<std::string>
{
};

TEST_P(EveryResponse, In2D)
{
  check_all_responses<2>(GetParam());
}

TEST_P(EveryResponse, In3D)
{
  check_all_responses<3>(GetParam());
}

TEST(Gradient, EveryResponseOfMortarContact2D)
{
  check_all_responses<2>("Bezier patch", contact::Method::mortar);
}

TEST(Gradient, EveryResponseOfMortarContact3D)
{
  check_all_responses<3>("Bezier patch", contact::Method::mortar);
}

std::vector<std::string> bases()
{
  std::vector<std::string> names;
  for (const auto &row : shape::shape_basis_table<2>())
    if (row.name != "none")
      names.push_back(row.name);
  return names;
}

/// "Bezier patch" as a name of tests, which have no blanks.
std::string joined(const testing::TestParamInfo<std::string> &info)
{
  std::string name;
  for (const char c : info.param)
    if (std::isalnum(c))
      name += c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Gradient, EveryResponse, testing::ValuesIn(bases()), joined);
} // namespace
