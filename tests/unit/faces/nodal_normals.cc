#include "one_box.h"

#include <snug/base/errors.h>
#include <snug/faces/nodal_normals.h>

#include <gtest/gtest.h>

using namespace snug;
using namespace snug::faces;

namespace {
template <int dim>
using Field = typename BoxTop<dim>::Field;

/// Rollers along x at x = 0.
template <int dim>
HeldDirections<dim> rollers(const BoxTop<dim> &box)
{
  HeldDirections<dim> held(box.surface.n_nodes());
  for (unsigned int node = 0; node < held.size(); ++node)
    if (box.positions[node][0] == 0.)
      {
        held[node].emplace_back();
        held[node].back()[0] = 1.;
      }
  return held;
}

/// Derivatives against differences of fourth order, and the transpose against the derivatives.
template <int dim>
void expect_exact_derivatives(BoxTop<dim> box)
{
  const auto held = rollers(box);
  box.shake();
  const auto              velocity = box.random_velocity(1);
  const NodalNormals<dim> here(box.surface, box.faces, box.shape, box.positions, &held);
  const auto              exact = here.derivative(velocity);
  const double            h     = 1e-5;
  Field<dim>              numbers(exact.size());
  for (const auto &[step, factor] : {std::make_pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
    {
      const auto              at = box.moved(step * h, velocity);
      const NodalNormals<dim> there(box.surface, box.faces, box.shape, at, &held);
      for (unsigned int i = 0; i < numbers.size(); ++i)
        numbers[i] += factor / (12. * h) * there.normals()[i];
    }
  double largest = 0.;
  for (unsigned int i = 0; i < numbers.size(); ++i)
    {
      largest = std::max(largest, exact[i].norm());
      EXPECT_LT((exact[i] - numbers[i]).norm(), 1e-7);
    }
  EXPECT_GT(largest, 1.);
  const auto weights = box.random_field(2, exact.size());
  Field<dim> gradient(box.surface.n_points());
  here.add_transpose(weights, gradient);
  const double direct = inner_product(weights, exact);
  EXPECT_NEAR(direct, inner_product(gradient, velocity), 1e-13 * largest * exact.size());
}

template <int dim>
void expect_radial_normals(unsigned int degree)
{
  const BoxTop<dim>       box(degree, true, dim == 2 ? "cylinder z 3" : "sphere 3");
  const NodalNormals<dim> normals(box.surface, box.faces, box.shape, box.positions);
  dealii::Tensor<1, dim>  centre;
  for (int d = 0; d < dim - 1; ++d)
    centre[d] = 0.5;
  centre[dim - 1] = -2.;
  for (unsigned int node = 0; node < box.surface.n_nodes(); ++node)
    if (box.surface.masters(node).empty())
      {
        const auto exact = (box.positions[node] - centre) / 3.;
        EXPECT_NEAR((normals.normals()[node] - exact).norm(), 0., 1e-13);
      }
}
/// The derivative of x^2.3 vanishes at x = 0, and that of the polynomial through its samples is
/// negative there.
TEST(NodalNormals, TrueSurfacesThatTurnBackHaveNone)
{
  auto bodies                  = BoxTop<2>::bodies(false, "");
  bodies[0].sampled_boundaries = {"top"};
  for (const auto &[warp, is_good] :
       {std::make_pair("x^2.3-x", false), std::make_pair("0.9*(x^2.3-x)", true)})
    {
      bodies[0].warp = {warp, "0.01*x"};
      const mesh::BodyMesh<2>   mesh(MPI_COMM_WORLD, bodies, 1);
      const mesh::Surface<2>    surface(mesh, {{0, 3}});
      std::vector<unsigned int> faces(surface.faces().size());
      std::iota(faces.begin(), faces.end(), 0u);
      const FaceShape<2> shape(1);
      const auto         normals = [&] {
        return NodalNormals<2>(surface, faces, shape, surface.reference_positions());
      };
      if (is_good)
        EXPECT_NO_THROW(normals());
      else
        EXPECT_THROW(normals(), TangledMesh);
    }
}
} // namespace

TEST(NodalNormals, DerivativesAgreeWithFiniteDifferences)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_exact_derivatives(BoxTop<2>(degree, true));
      expect_exact_derivatives(BoxTop<3>(degree, true));
      expect_exact_derivatives(BoxTop<2>(degree, false, "cylinder z 3"));
      expect_exact_derivatives(BoxTop<3>(degree, false, "sphere 3"));
    }
}

TEST(NodalNormals, OfASphereAreRadial)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_radial_normals<2>(degree);
      expect_radial_normals<3>(degree);
    }
}

/// The mean over the faces on one side of a symmetry plane leans off it.
TEST(NodalNormals, StayInSymmetryPlanes)
{
  const BoxTop<3>       box(1, false, "-(x^2+y^2)/4");
  const auto            held = rollers(box);
  const NodalNormals<3> free(box.surface, box.faces, box.shape, box.positions);
  const NodalNormals<3> supported(box.surface, box.faces, box.shape, box.positions, &held);
  for (unsigned int node = 0; node < held.size(); ++node)
    {
      EXPECT_NEAR(supported.normals()[node].norm(), 1., 1e-15);
      if (held[node].empty())
        EXPECT_EQ((supported.normals()[node] - free.normals()[node]).norm(), 0.);
      else
        EXPECT_EQ(supported.normals()[node][0], 0.);
    }
}

/// A support that holds the normal itself does not change the normal.
TEST(NodalNormals, LeanOnSupportsWhereTheyAreMeantTo)
{
  const BoxTop<2>   box(1, false);
  HeldDirections<2> held(box.surface.n_nodes());
  for (auto &directions : held)
    {
      directions.emplace_back();
      directions.back()[1] = 1.;
    }
  const NodalNormals<2> normals(box.surface, box.faces, box.shape, box.positions, &held);
  for (const auto &n : normals.normals())
    EXPECT_NEAR(n[1], 1., 1e-15);
}

TEST(NodalNormals, FoldedFacesHaveNone)
{
  BoxTop<2> box(1, false);
  for (auto &x : box.positions)
    x[0] = 0.;
  EXPECT_THROW(NodalNormals<2>(box.surface, box.faces, box.shape, box.positions), TangledMesh);
}
