#include "row_checks.h"

using namespace snug;
using namespace snug::contact;

namespace {
/// A ball of radius 2 under a socket of radius 2.1 whose poles touch.
template <int dim>
struct Socket : public TwoBoxes<dim>
{
  Socket(unsigned int       n_slave,
         unsigned int       n_master,
         unsigned int       degree,
         const std::string &used_method)
    : TwoBoxes<dim>(TwoBoxes<dim>::ball_and_socket(n_slave, n_master, 2.), degree)
  {
    this->method = used_method;
  }

  /// Distance of the spheres from @p x on the socket along the normal of the ball.
  static double gap(const dealii::Tensor<1, dim> &x)
  {
    dealii::Tensor<1, dim> from_centre = x;
    for (unsigned int d = 0; d < dim - 1; ++d)
      from_centre[d] -= 0.5;
    from_centre[dim - 1] -= 1. - 2.;
    return from_centre.norm() - 2.;
  }
};

/// Derivatives where nodes and samples of both sides have moved at random.
template <int dim>
void expect_derivatives(const std::string &method, unsigned int degree)
{
  Socket<dim> scene(5, 3, degree, method);
  ASSERT_GT(scene.surface.n_points(), scene.surface.n_nodes());
  const auto moves = scene.random_velocity(3);
  for (unsigned int i = 0; i < moves.size(); ++i)
    scene.positions[i] += 2e-3 * moves[i];
  const auto contact = scene.contact();
  // of fourth order: (h / face)^4 against rounding / h
  EXPECT_LT(derivative_error(scene, contact, 1e-5), 3e-8) << method << degree << dim;
  EXPECT_LT(reverse_error(scene, contact), 1e-12) << method << degree << dim;
}
} // namespace

TEST(TrueSurfaces, DerivativesByNodesAndSamples)
{
  for (const std::string method : {"nodal", "mortar"})
    for (const unsigned int degree : {1, 2})
      {
        expect_derivatives<2>(method, degree);
        expect_derivatives<3>(method, degree);
      }
}

TEST(TrueSurfaces, NodalGapsAreThoseOfTheSpheres)
{
  const auto expect_gaps = [](const auto &scene) {
    const auto contact = scene.contact();
    const auto rows    = contact.rows(scene.positions);
    for (unsigned int i = 0; i < rows.size(); ++i)
      // Polynomials of degree 4 over faces of 1/4 on a radius of 2.
      EXPECT_NEAR(rows[i].gap, scene.gap(scene.positions[contact.places()[i].slave]), 1e-7);
  };
  for (const unsigned int degree : {1, 2})
    {
      expect_gaps(Socket<2>(5, 4, degree, "nodal"));
      expect_gaps(Socket<3>(5, 4, degree, "nodal"));
    }
}

/// Means of a gap of 0 to 0.006 over faces: facets alone are off by their heights, up to 0.008.
TEST(TrueSurfaces, MortarGapsAreMeansOfThoseOfTheSpheres)
{
  const auto expect_gaps = [](const auto &scene, double tolerance) {
    const auto contact = scene.contact();
    const auto rows    = contact.rows(scene.positions);
    double     worst   = 0.;
    for (unsigned int i = 0; i < rows.size(); ++i)
      worst = std::max(worst, std::abs(rows[i].gap -
                                       scene.gap(scene.positions[contact.places()[i].slave])));
    // The mean over the faces at a node is not the value there.
    EXPECT_LT(worst, tolerance);
  };
  expect_gaps(Socket<2>(8, 6, 1, "mortar"), 2e-4);
  expect_gaps(Socket<3>(8, 6, 1, "mortar"), 4e-4);
}
