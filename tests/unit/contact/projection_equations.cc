#include "two_boxes.h"

#include <snug/base/errors.h>
#include <snug/contact/normal_projection.h>

#include <gtest/gtest.h>

using namespace snug;
using namespace snug::contact;

namespace {
/// A face of the master of ball_and_socket(), a sphere or circle of radius 2 about (0.5, .., -1).
template <int dim>
struct RoundFace
{
  TwoBoxes<dim>                    scene;
  faces::FaceShape<dim>            shape;
  std::vector<unsigned int>        master;
  dealii::Tensor<1, dim>           centre;
  typename TwoBoxes<dim>::Field    normals;
  std::uniform_real_distribution<> uniform{0.1, 0.9};
  std::mt19937                     random{5};

  explicit RoundFace(unsigned int degree)
    : scene(TwoBoxes<dim>::ball_and_socket(5, 3, 2.), degree), shape(degree)
  {
    for (unsigned int f = 0; f < scene.surface.faces().size(); ++f)
      if (scene.surface.faces()[f].body == 1)
        master.push_back(f);
    for (int d = 0; d < dim - 1; ++d)
      centre[d] = 0.5;
    centre[dim - 1] = -1.;
    normals = faces::NodalNormals<dim>(scene.surface, master, shape, scene.positions).normals();
  }

  ProjectionEquations<dim> equations(unsigned int face) const
  {
    return {scene.surface.faces()[face], shape, scene.positions, normals};
  }

  dealii::Point<dim - 1> random_xi()
  {
    dealii::Point<dim - 1> xi;
    for (int a = 0; a < dim - 1; ++a)
      xi[a] = uniform(random);
    return xi;
  }
};

/// Normals of a sphere lead from its centre through x(xi) to p, and meet the sphere at its radius.
template <int dim>
void expect_radial_projections(unsigned int degree)
{
  RoundFace<dim> round(degree);
  for (const unsigned int face : round.master)
    {
      const auto equations = round.equations(face);
      const auto xi        = round.random_xi();
      const auto at        = equations.at(xi, round.centre);
      const auto p         = round.centre + (1. + 0.1 * round.uniform(round.random)) * at.x;
      const auto found     = equations.solve(p, round.random_xi());
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->values.point.distance(xi), 0., 1e-11);
      EXPECT_NEAR((found->x + found->t * found->v).norm(), 0., 1e-14);
      const auto meets = equations.intersection(xi);
      const auto y     = at.x + meets.s * at.v;
      EXPECT_NEAR(y.norm(), 2., 1e-7);
      dealii::Tensor<1, dim> on_surface;
      const auto            &samples = round.scene.surface.faces()[face].samples;
      for (unsigned int k = 0; k < samples.size(); ++k)
        on_surface += meets.values.value[k] * (round.scene.positions[samples[k]] - round.centre);
      EXPECT_NEAR((y - on_surface).norm(), 0., 1e-14);
    }
}

/// The matrix of the slopes against differences of fourth order.
template <int dim>
void expect_exact_slopes(unsigned int degree)
{
  RoundFace<dim> round(degree);
  const auto     equations = round.equations(round.master[0]);
  const auto     xi        = round.random_xi();
  const double   t = 0.3, h = 1e-3;
  const auto     slope = equations.at(xi, {}, t).slope;
  for (int a = 0; a < dim; ++a)
    {
      dealii::Tensor<1, dim> number;
      for (const auto &[step, factor] : {std::make_pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
        {
          auto moved = xi;
          if (a < dim - 1)
            moved[a] += step * h;
          const auto point = equations.at(moved, {}, a < dim - 1 ? t : t + step * h);
          number += factor / (12. * h) * (point.x + point.t * point.v);
        }
      for (int d = 0; d < dim; ++d)
        EXPECT_NEAR(slope[d][a], number[d], 1e-11);
    }
}

/// Weights of the moving foot point along a random velocity, with or without normals of the slave:
/// forward against differences, and reverse against forward.
template <int dim>
void expect_exact_weights(unsigned int degree, bool has_mean_normals)
{
  RoundFace<dim>     round(degree);
  const auto        &scene    = round.scene;
  const auto         velocity = scene.random_velocity(1);
  const unsigned int size     = round.normals.size();
  const auto   dn = TwoBoxes<dim>::random_field(2, size), dm = TwoBoxes<dim>::random_field(3, size);
  const double h        = 1e-5;
  unsigned int n_moving = 0;
  // Slave normals that are not opposite to those of the master.
  auto of_slave = TwoBoxes<dim>::random_field(4, size);
  for (auto &m : of_slave)
    {
      m *= has_mean_normals ? 0.1 : 0.;
      m[dim - 1] -= has_mean_normals ? 1. : 0.;
    }
  for (const auto &projection : scene.projections())
    {
      const NormalProjection<dim> moving(scene.surface, round.shape, projection, scene.positions,
                                         {round.normals, of_slave});
      using Forward = faces::Differential<1>;
      const faces::PointField<dim, Forward> n_forward(round.normals, dn), m_forward(of_slave, dm);
      const auto forward = moving.at(faces::PointField<dim, Forward>(scene.positions, velocity),
                                     NormalFields<dim, Forward>{n_forward, m_forward});
      std::vector<double> numbers(forward.surface.size(), 0.);
      for (const auto &[step, factor] : {std::make_pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
        {
          const auto x = sum(scene.positions, step * h, velocity);
          const auto n = sum(round.normals, step * h, dn);
          const auto m = has_mean_normals ? sum(of_slave, step * h, dm) : of_slave;
          const faces::PointField<dim, double> of_n(n), of_m(m);
          const auto                           there =
            moving.at(faces::PointField<dim, double>(x), NormalFields<dim, double>{of_n, of_m});
          for (unsigned int k = 0; k < numbers.size(); ++k)
            numbers[k] += factor / (12. * h) * there.surface[k].second;
        }
      faces::Recording                              recording;
      const faces::PointField<dim, faces::Recorded> x(scene.positions, recording),
        n(round.normals, recording), m(of_slave, recording);
      const auto reverse = moving.at(x, NormalFields<dim, faces::Recorded>{n, m});
      double     direct  = 0.;
      for (unsigned int k = 0; k < numbers.size(); ++k)
        {
          EXPECT_NEAR(forward.surface[k].second.slope[0], numbers[k], 1e-7);
          recording.add(reverse.surface[k].second, k + 1.);
          direct += (k + 1.) * forward.surface[k].second.slope[0];
        }
      recording.sweep();
      typename TwoBoxes<dim>::Field by_x(velocity.size()), by_n(dn.size()), by_m(dm.size());
      x.add_derivatives(by_x);
      n.add_derivatives(by_n);
      m.add_derivatives(by_m);
      double transposed = 0.;
      for (unsigned int i = 0; i < by_x.size(); ++i)
        transposed += by_x[i] * velocity[i];
      for (unsigned int i = 0; i < by_n.size(); ++i)
        transposed += by_n[i] * dn[i] + by_m[i] * dm[i];
      EXPECT_NEAR(direct, transposed, 1e-11 * (1. + std::abs(direct)));
      n_moving += std::abs(direct) > 1e-3;
    }
  EXPECT_GT(n_moving, 3u);
}
} // namespace

TEST(ProjectionEquations, NormalsOfASphereAreRadial)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_radial_projections<2>(degree);
      expect_radial_projections<3>(degree);
    }
}

TEST(ProjectionEquations, SlopesAgreeWithFiniteDifferences)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_exact_slopes<2>(degree);
      expect_exact_slopes<3>(degree);
    }
}

TEST(ProjectionEquations, FixedCoordinatesHaveTrivialEquations)
{
  ReducedEquations<3> reduced;
  reduced.fixed = {{false, true}};
  dealii::Tensor<2, 3> slope;
  dealii::Tensor<1, 3> F;
  for (int i = 0; i < 3; ++i)
    {
      F[i] = i + 1.;
      for (int j = 0; j < 3; ++j)
        slope[i][j] = 3. * i + j;
    }
  const auto residual = reduced.residual(F);
  const auto matrix   = reduced.matrix(slope);
  for (int j = 0; j < 3; ++j)
    {
      EXPECT_EQ(residual[j], j == 1 ? 0. : F[j]);
      EXPECT_EQ(matrix[0][j], slope[0][j]);
      EXPECT_EQ(matrix[1][j], j == 1 ? 1. : 0.);
      EXPECT_EQ(matrix[2][j], slope[2][j]);
    }
}

/// No normal of a face leads to a point from which the faces are seen edge on.
TEST(ProjectionEquations, ParallelNormalsLeadNowhere)
{
  RoundFace<2> round(1);
  const auto  &nodes = round.scene.surface.faces()[round.master[0]].nodes;
  // Normals along the face never leave its line.
  auto along = round.scene.positions[nodes[1]] - round.scene.positions[nodes[0]];
  for (auto &n : round.normals)
    n = along;
  EXPECT_FALSE(round.equations(round.master[0]).solve(round.centre, dealii::Point<1>(0.5)));
}

TEST(NormalProjection, DerivativesOfWeightsAgreeWithFiniteDifferences)
{
  for (const unsigned int degree : {1, 2})
    {
      for (const bool has_mean_normals : {false, true})
        {
          expect_exact_weights<2>(degree, has_mean_normals);
          expect_exact_weights<3>(degree, has_mean_normals);
        }
    }
}
