#include <snug/response/measured_place.h>
#include <snug/response/response.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Boxes of edge 1, hanging nodes in the foundation, which does not move.
template <int dim>
TestScene<dim> plain_scene(unsigned int degree)
{
  auto scene                    = two_blocks<dim>(2, 3, 0.);
  scene.degree                  = degree;
  scene.bodies[0].material      = {1000., 0.3, 2.};
  scene.bodies[1].material      = {500., 0.2, 3., 0., 40.};
  scene.bodies[1].refined_below = 0.45;
  return scene;
}

/// u = A x + b of all bodies, with A_ij = (1 + i + 2 j)/100.
template <int dim>
dealii::Tensor<1, dim> linear(const dealii::Tensor<1, dim> &x)
{
  dealii::Tensor<1, dim> u;
  for (unsigned int i = 0; i < dim; ++i)
    {
      u[i] = 0.3 * i;
      for (unsigned int j = 0; j < dim; ++j)
        u[i] += (1. + i + 2. * j) / 100. * x[j];
    }
  return u;
}

/// The state with that displacement.
template <int dim>
state::ContactState<dim> linear_state(Problem<dim> &problem)
{
  auto state = problem.solve();
  for (unsigned int s = 0; s < state.u.size(); ++s)
    {
      const auto &nodes = problem.tearing.subdomains[s].nodes;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const auto u = linear(state.positions[nodes[a]]);
          for (unsigned int c = 0; c < dim; ++c)
            state.u[s](dim * a + c) = u[c];
        }
    }
  return state;
}

template <int dim>
double value(const Problem<dim>                 &problem,
             const state::ContactState<dim>     &state,
             const response::ResponseParameters &parameters)
{
  const auto response = response::make_response<dim>(parameters);
  response->check(problem.solver);
  return response->value(problem.solver, state);
}

template <int dim>
void check_displacements(unsigned int degree)
{
  Problem<dim> problem(plain_scene<dim>(degree));
  const auto   state = linear_state(problem);

  response::ResponseParameters at_point;
  at_point.quantity  = "displacement";
  at_point.body      = "foundation";
  at_point.component = response::Component::y;
  dealii::Tensor<1, dim> x;
  at_point.point.resize(dim);
  for (const double first : {0., 0.123, 0.5, 0.987, 1.})
    {
      for (unsigned int d = 0; d < dim; ++d)
        at_point.point[d] = x[d] = d == 0 ? first : 0.31 + 0.23 * d;
      EXPECT_NEAR(value(problem, state, at_point), linear(x)[1], 1e-12);
    }

  response::ResponseParameters on_face;
  on_face.quantity = "displacement";
  on_face.face     = "foundation.right";
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = d == 0 ? 1. : 0.5;
  EXPECT_NEAR(value(problem, state, on_face), linear(x)[0], 1e-12);
  on_face.component = response::Component::y;
  EXPECT_NEAR(value(problem, state, on_face), linear(x)[1], 1e-12);
  // its outward normal is -x
  on_face.face      = "foundation.left";
  on_face.component = response::Component::normal;
  x[0]              = 0.;
  EXPECT_NEAR(value(problem, state, on_face), -linear(x)[0], 1e-12);
}

TEST(Displacement, OfALinearFieldIsExact)
{
  check_displacements<2>(1);
  check_displacements<2>(2);
  check_displacements<3>(1);
}

std::string failure_reason(const Problem<2>                   &problem,
                           const response::ResponseParameters &parameters)
{
  try
    {
      response::make_response<2>(parameters)->check(problem.solver);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

TEST(Displacement, PointsMustLieInOneBody)
{
  const Problem<2>             problem(plain_scene<2>(1));
  response::ResponseParameters parameters;
  parameters.name      = "tip";
  parameters.quantity  = "displacement";
  parameters.component = response::Component::x;
  // The cells of the punch have the edge 1/2.
  parameters.point = {0.5, 2.051};
  EXPECT_EQ(failure_reason(problem, parameters),
            "entry 'Response tip/Point' = '0.5, 2.051': lies outside the "
            "bodies by more than a tenth of a cell");
  parameters.point = {0.5, 1.};
  EXPECT_EQ(failure_reason(problem, parameters),
            "entry 'Response tip/Point' = '0.5, 1': lies in the bodies punch, "
            "foundation: name one with 'Body'");
  parameters.body = "punch";
  EXPECT_EQ(failure_reason(problem, parameters), "");
}

template <int dim>
void check_points_outside()
{
  Problem<dim>                 problem(plain_scene<dim>(1));
  const auto                   state = linear_state(problem);
  response::ResponseParameters parameters;
  parameters.quantity  = "displacement";
  parameters.component = response::Component::y;
  parameters.point.assign(dim, 0.3);
  parameters.point[dim - 1] = 2.02;
  dealii::Tensor<1, dim> nearest;
  for (unsigned int d = 0; d < dim; ++d)
    nearest[d] = parameters.point[d];
  nearest[dim - 1] = 2.;
  EXPECT_NEAR(value(problem, state, parameters), linear(nearest)[1], 1e-12);
  // next to an edge of several cells
  parameters.point[0] = 0.5 + 1e-3;
  nearest[0]          = 0.5 + 1e-3;
  EXPECT_NEAR(value(problem, state, parameters), linear(nearest)[1], 1e-12);
  parameters.point[0] = 1.04;
  nearest[0]          = 1.;
  EXPECT_NEAR(value(problem, state, parameters), linear(nearest)[1], 1e-12);
}

TEST(Displacement, PointsCloseToABodyAreMovedOntoIt)
{
  check_points_outside<2>();
  check_points_outside<3>();
}

template <int dim>
void check_bodies(unsigned int degree)
{
  Problem<dim> problem(plain_scene<dim>(degree));
  const auto   state = linear_state(problem);

  response::ResponseParameters parameters;
  parameters.quantity = "mass";
  EXPECT_NEAR(value(problem, state, parameters), 2. + 3., 1e-12);
  parameters.body = "foundation";
  EXPECT_NEAR(value(problem, state, parameters), 3., 1e-12);
  parameters.quantity = "volume";
  EXPECT_NEAR(value(problem, state, parameters), 1., 1e-12);

  // one stress everywhere: its norms are the von Mises stress itself
  dealii::SymmetricTensor<2, 3> strain;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      strain[i][j] = (2. + 3. * (i + j)) / 200.;
  const auto   s      = deviator(strain);
  const double mu     = 500. / 2.4;
  const double stress = 2. * mu * std::sqrt(1.5) * s.norm();
  parameters.quantity = "von Mises norm";
  for (const double p : {1., 2., 30.})
    {
      parameters.exponent = p;
      EXPECT_NEAR(value(problem, state, parameters), stress, 1e-11 * stress);
    }
  // The punch has no yield stress and is left out.
  parameters.quantity = "yield utilization";
  for (const std::string body : {"foundation", ""})
    {
      parameters.body = body;
      EXPECT_NEAR(value(problem, state, parameters), stress / 40., 1e-11 * stress);
    }
  parameters.body = "punch";
  EXPECT_THROW(response::make_response<dim>(parameters)->check(problem.solver), InputError);
}

TEST(Response, OfOneBody)
{
  check_bodies<2>(1);
  check_bodies<2>(2);
  check_bodies<3>(1);
}

TEST(Response, ContactForceBalancesTheLoad)
{
  auto          scene = two_blocks<3>(3, 4, 3.);
  contact::Pair pair{{0, face_index(2, 0)}, {1, face_index(2, 1)}};
  pair.slave_name       = "punch.bottom";
  pair.master_name      = "foundation.top";
  pair.parameters.slave = contact::Slave::first;
  scene.pairs           = {pair};
  Problem<3>                   problem(scene);
  const auto                   state = problem.solve();
  response::ResponseParameters parameters;
  parameters.quantity  = "contact force";
  parameters.pair      = "foundation.top: punch.bottom";
  parameters.component = response::Component::z;
  // pressure 10 on an area of 1; what holds up the slave side
  EXPECT_NEAR(value(problem, state, parameters), 10., 1e-8);
  parameters.component = response::Component::normal;
  EXPECT_GE(value(problem, state, parameters), 10. - 1e-8);
  parameters.pair = "punch.top: foundation.top";
  EXPECT_THROW(value(problem, state, parameters), InputError);
}
} // namespace
