#include <gtest/gtest.h>

#include <deal.II/base/mpi.h>

#include <unit/state/untorn_solver.h>

#include <set>

namespace {
using namespace snug;
using namespace snug::test;

/// States are solved to 1e-10; u follows the residual times the ratio of
/// displacement to F_ii lambda, which is below 1e3 in these scenes.
const double agreement = 1e-7;

template <int dim>
void expect_same_displacement(const Problem<dim>             &problem,
                              const state::ContactState<dim> &state,
                              const Untorn<dim>              &untorn)
{
  double largest = 0., error = 0.;
  for (const auto &cell : problem.mesh.cells())
    for (const unsigned int node : cell.nodes)
      {
        const auto u = untorn.displacement(cell.body, problem.mesh.reference_positions()[node]);
        largest      = std::max(largest, u.norm());
        error        = std::max(error, (u - state.displacement[node]).norm());
      }
  EXPECT_LT(error, agreement * largest);
}

template <int dim>
void expect_same_contact(const Problem<dim>             &problem,
                         const state::ContactState<dim> &state,
                         const Untorn<dim>              &untorn)
{
  const auto &surface = problem.solver.surface();
  const auto  x       = surface.gather(problem.mesh.reference_positions());
  ASSERT_EQ(state.contact.size(), untorn.contacts.size());
  double largest[2] = {0., 0.}, error[2] = {0., 0.};
  for (unsigned int i = 0; i < state.contact.size(); ++i)
    {
      const unsigned int slave  = problem.solver.contact(0).places()[i].slave;
      const auto        &other  = untorn.contacts.at(untorn.node_at[0].at(node_key<dim>(x[slave])));
      const double       here[] = {state.contact[i].force, state.contact[i].pressure};
      const double       there[] = {other.force, other.pressure};
      for (unsigned int k = 0; k < 2; ++k)
        {
          largest[k] = std::max(largest[k], std::abs(there[k]));
          error[k]   = std::max(error[k], std::abs(here[k] - there[k]));
        }
    }
  EXPECT_LT(error[0], agreement * largest[0]);
  EXPECT_LT(error[1], agreement * largest[1]);
}

/// A sliding punch is free to slide: only its forces and energies compare.
template <int dim>
void expect_same(const TestScene<dim> &scene, const Untorn<dim> &untorn)
{
  Problem<dim> problem(scene);
  const auto   state = problem.solve();
  if (!scene.punch_slides)
    expect_same_displacement(problem, state, untorn);
  expect_same_contact(problem, state, untorn);
  // The untorn energies count thermal loads like other loads.
  if (!scene.bodies[1].temperature)
    {
      EXPECT_LT(relative_difference(state.energy, untorn.energy), agreement);
      EXPECT_LT(relative_difference(state.compliance, untorn.compliance), agreement);
    }
  EXPECT_LT(state.certificate.worst(), scene.solver.relative_tolerance);
  EXPECT_GT(state.active_contacts, 0u);
}

/// Compare single subdomains, and clusters of subdomains.
template <int dim>
void expect_same(TestScene<dim> scene)
{
  Untorn<dim> untorn(scene);
  untorn.solve();
  expect_same(scene, untorn);
  SCOPED_TRACE("clusters");
  scene.subdomains   = 24;
  scene.cluster_edge = 2;
  // Moments of joints on subdomains of one or two cells are nearly dependent, and cost digits.
  scene.solver.relative_tolerance = 1e-9;
  expect_same(scene, untorn);
}

/// Hanging nodes on the contact surface, and nodes that a subdomain reaches
/// only as masters of its hanging nodes: what a scene is to cover.
template <int dim>
std::pair<unsigned int, unsigned int> count_hanging(const TestScene<dim> &scene)
{
  const Problem<dim> problem(scene);
  unsigned int       on_contact = 0, foreign = 0;
  for (unsigned int i = 0; i < problem.solver.surface().n_nodes(); ++i)
    on_contact += !problem.solver.surface().masters(i).empty();
  for (const auto &subdomain : problem.tearing.subdomains)
    {
      std::set<unsigned int> own;
      for (const unsigned int cell : subdomain.cells)
        own.insert(problem.mesh.cells()[cell].nodes.begin(),
                   problem.mesh.cells()[cell].nodes.end());
      for (const unsigned int node : subdomain.nodes)
        foreign += own.count(node) == 0;
    }
  return {on_contact, dealii::Utilities::MPI::sum(foreign, MPI_COMM_WORLD)};
}

TEST(Untorn, MatchingMeshes2D)
{
  auto scene = two_blocks<2>(6, 6, 3.);
  set_design(scene, 4, 0.03);
  expect_same(scene);
}

TEST(Untorn, TwoMaterialsInEachBody)
{
  auto flat = two_blocks<2>(6, 7, 3.);
  set_design(flat, 3, 0.03);
  auto solid = two_blocks<3>(3, 4, 3.);
  set_design(solid, 2, 0.03);
  flat.bodies[1].refined_below = 0.45;
  flat.bodies[0].core_from = solid.bodies[0].core_from = 0.5;
  flat.bodies[1].core_from = solid.bodies[1].core_from = 0.3;
  expect_same(flat);
  expect_same(solid);
}

TEST(Untorn, OtherMeshes2D)
{
  // hanging nodes inside both bodies, body force, side pressure
  auto scene = two_blocks<2>(5, 7, 2.);
  narrow_punch(scene);
  set_design(scene, 3, 0.03);
  for (auto &body : scene.bodies)
    body.refined_below = 0.45;
  scene.bodies[0].body_force[1]                       = -3.;
  scene.bodies[1].body_force[0]                       = 2.;
  scene.bodies[1].loads[face_index(0, 1)].pressure    = 1.5;
  scene.bodies[1].loads[face_index(0, 0)].traction[0] = 0.3;
  scene.bodies[1].material                            = {300., 0.2};
  expect_same(scene);
}

TEST(Untorn, Quadratic2D)
{
  auto scene   = two_blocks<2>(3, 4, 2.);
  scene.degree = 2;
  set_design(scene, 4, 0.03);
  scene.bodies[1].refined_below = 0.45;
  scene.bodies[0].refined_below = 0.4;
  expect_same(scene);
}

TEST(Untorn, MatchingMeshes3D)
{
  // hanging nodes on both contact faces, rollers at contact nodes of both
  auto scene = two_blocks<3>(4, 4, 3.);
  set_design(scene, 3, 0.02);
  for (auto &body : scene.bodies)
    body.refined_below = 0.45;
  scene.bodies[1].supports[face_index(0, 0)] = {0};
  scene.subdomains                           = 30;
  const auto hanging                         = count_hanging(scene);
  EXPECT_GT(hanging.first, 0u);
  EXPECT_GT(hanging.second, 0u);
  expect_same(scene);
}

TEST(Untorn, OtherMeshes3D)
{
  auto scene = two_blocks<3>(3, 4, 2.);
  narrow_punch(scene);
  set_design(scene, 3, 0.02);
  scene.bodies[1].refined_below                    = 0.45;
  scene.bodies[1].loads[face_index(0, 1)].pressure = 1.5;
  scene.bodies[0].body_force[2]                    = -3.;
  scene.subdomains                                 = 12;
  expect_same(scene);
}

/// The foundation on springs alone, of very different stiffness along the axes.
template <int dim>
TestScene<dim> sprung_foundation(unsigned int n, unsigned int m)
{
  auto scene = two_blocks<dim>(n, m, 3.);
  set_design(scene, 3, 0.02);
  auto &foundation = scene.bodies[1];
  foundation.supports.clear();
  auto &springs = foundation.springs[face_index(dim - 1, 0)];
  for (unsigned int c = 0; c + 1 < dim; ++c)
    springs.emplace_back(c, 2.);
  springs.emplace_back(dim - 1, 3e4);
  foundation.springs[face_index(0, 1)]           = {{0, 70.}};
  foundation.loads[face_index(0, 0)].traction[0] = 0.3;
  foundation.refined_below                       = 0.45;
  return scene;
}

TEST(Untorn, Springs)
{
  for (const unsigned int degree : {1, 2})
    {
      auto flat   = sprung_foundation<2>(6 / degree, 8 / degree);
      flat.degree = degree;
      for (const auto preconditioner :
           {feti::Preconditioner::Dirichlet, feti::Preconditioner::lumped})
        for (const auto scaling : {feti::Scaling::stiffness, feti::Scaling::multiplicity})
          {
            flat.feti.preconditioner = preconditioner;
            flat.feti.scaling        = scaling;
            expect_same(flat);
          }
    }
  auto solid       = sprung_foundation<3>(3, 4);
  solid.subdomains = 12;
  expect_same(solid);
}

/// A heated foundation with two materials that expand differently.
TEST(Untorn, Temperature)
{
  auto scene                         = two_blocks<3>(3, 4, 3.);
  scene.bodies[1].core_from          = 0.5;
  scene.bodies[1].material.expansion = 1e-5;
  scene.bodies[1].core.expansion     = 3e-5;
  scene.bodies[1].refined_below      = 0.45;
  scene.bodies[1].temperature        = [](const auto &x) { return 100. + 50. * x[0] * x[2]; };
  set_design(scene, 2, 0.02);
  expect_same(scene);
}

TEST(Untorn, SlidingPunch2D)
{
  auto scene = two_blocks<2>(4, 5, 0.);
  narrow_punch(scene);
  scene.bodies[0].supports.clear();
  scene.punch_slides = true;
  expect_same(scene);
}

TEST(Untorn, SlidingPunch3D)
{
  // three rigid motions of the punch are in the kernel of B
  auto scene = two_blocks<3>(2, 3, 0.);
  narrow_punch(scene);
  scene.bodies[0].supports.clear();
  scene.punch_slides = true;
  expect_same(scene);
}
} // namespace
