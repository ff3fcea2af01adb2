#include <snug/base/errors.h>
#include <snug/state/contact_results.h>

#include <gtest/gtest.h>

#include <deal.II/lac/sparse_direct.h>

#include <unit/qp/friction_cases.h>
#include <unit/state/untorn_body.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Two held blocks that overlap by a given gap formula and are pushed aside.
template <int dim>
TestScene<dim> held_blocks(contact::Method method, contact::Friction law, const std::string &value)
{
  auto scene               = two_blocks<dim>(dim == 2 ? 8 : 4, dim == 2 ? 6 : 3, 6.);
  scene.bodies[0].supports = {{face_index(dim - 1, 1), scene.bodies[1].supports.begin()->second}};
  scene.bodies[0].loads    = {};
  auto &side               = scene.bodies[0].loads[face_index(0, 0)];
  side.pressure            = dim == 2 ? 1.5 : 5.;
  side.traction[dim - 1]   = -1.;
  if (dim == 3)
    scene.bodies[0].loads[face_index(1, 1)].traction[1] = 1.;
  scene.pairs             = {{{0, face_index(dim - 1, 0)}, {1, face_index(dim - 1, 1)}}};
  auto &parameters        = scene.pairs[0].parameters;
  parameters.slave        = contact::Slave::first;
  parameters.method       = method;
  parameters.interference = true;
  parameters.gap          = "-0.012";
  parameters.friction     = law;
  (law == contact::Friction::Tresca ? parameters.friction_bound : parameters.friction_coefficient) =
    value;
  scene.solver.relative_tolerance = 1e-11;
  return scene;
}

/// The condensed problem of the contact rows: the compliances C K^-1 C' of bodies that deal.II
/// assembles and UMFPACK factorizes without tearing, for the rows of the program.
template <int dim>
class CondensedProblem
{
public:
  CondensedProblem(const TestScene<dim>           &scene,
                   const Problem<dim>             &problem,
                   const state::ContactState<dim> &state)
  {
    const auto         rows    = problem.solver.rows(state.positions, 0);
    const auto        &contact = problem.solver.contact(0);
    const auto        &surface = problem.solver.surface();
    const auto         X       = surface.gather(problem.mesh.reference_positions());
    const unsigned int n = rows.n_rows(), n_normal = rows.contact.size();
    data.F       = dense::Matrix(n, n);
    data.d       = dense::Matrix(n);
    data.G       = dense::Matrix(0, n);
    data.e       = dense::Matrix(0);
    data.bounded = qp::RowSet(n, 0);
    for (unsigned int i = 0; i < n; ++i)
      data.d(i) = -rows.row(i).gap;
    for (unsigned int b = 0; b < 2; ++b)
      {
        UntornBody<dim>                               body(scene, b);
        std::map<std::array<long, dim>, unsigned int> node_at;
        for (unsigned int node = 0; node < body.flat.size(); ++node)
          node_at[node_key<dim>(body.at_node(body.reference, node))] = node;
        dealii::SparseMatrix<double> K;
        dealii::Vector<double>       f;
        body.assemble(K, f);
        std::vector<dealii::Vector<double>> C;
        for (unsigned int i = 0; i < n; ++i)
          {
            C.emplace_back(body.n_dofs());
            for (const auto &[node, c] : rows.row(i).coefficients)
              if (body_of(surface, node) == b)
                for (unsigned int d = 0; d < dim; ++d)
                  if (const auto dof = body.node_dofs[node_at.at(node_key<dim>(X[node]))][d];
                      !body.constraints.is_constrained(dof))
                    C.back()(dof) += c[d];
          }
        dealii::SparseDirectUMFPACK inverse;
        inverse.initialize(K);
        dealii::Vector<double> u = f;
        inverse.solve(u);
        for (unsigned int i = 0; i < n; ++i)
          data.d(i) += C[i] * u;
        for (unsigned int j = 0; j < n; ++j)
          {
            dealii::Vector<double> x = C[j];
            inverse.solve(x);
            for (unsigned int i = 0; i < n; ++i)
              data.F(i, j) += C[i] * x;
          }
      }
    for (unsigned int i = 0; i < n_normal; ++i)
      data.bounded[i] = 1;
    for (unsigned int j = 0; j < contact.tangents().size(); ++j)
      {
        const auto row = contact.tangents()[j].row;
        if (data.cones.empty() || data.cones.back().normal != row)
          data.cones.push_back({row,
                                {},
                                0,
                                contact.friction(row).coefficient,
                                contact.friction(row).bound * state.contact[row].area});
        auto &cone                       = data.cones.back();
        cone.tangents[cone.n_tangents++] = n_normal + j;
      }
  }

  DenseData data;

private:
  static unsigned int body_of(const mesh::Surface<dim> &surface, unsigned int node)
  {
    for (const auto &face : surface.faces())
      for (const unsigned int other : face.nodes)
        if (other == node)
          return face.body;
    return 2;
  }
};

/// Return the numbers of contacts that slip and that stick.
template <int dim>
std::pair<unsigned int, unsigned int> expect_gauss_seidel(const TestScene<dim> &scene)
{
  Problem<dim> problem(scene);
  const auto   state = problem.solve();
  EXPECT_LE(state.certificate.worst(), scene.solver.relative_tolerance);
  const CondensedProblem<dim> condensed(scene, problem, state);
  const auto                  forces = gauss_seidel(condensed.data, 3000);
  const auto                  found  = state::contact_row_forces(problem.solver, state);
  double                      error = 0., largest = 0.;
  for (unsigned int i = 0; i < found.size(); ++i)
    {
      error   = std::max(error, std::abs(found[i] - forces(i)));
      largest = std::max(largest, std::abs(forces(i)));
    }
  EXPECT_LT(error, 1e-8 * largest);
  return {state.slipping_contacts, state.active_contacts - state.slipping_contacts};
}
} // namespace

TEST(StateFriction, AgreesWithGaussSeidelOnTheUntornBodies)
{
  using contact::Friction;
  using contact::Method;
  unsigned int slipping = 0, sticking = 0;
  const auto   check = [&](const auto &scene) {
    const auto [slip, stick] = expect_gauss_seidel(scene);
    slipping += slip;
    sticking += stick;
  };
  for (const auto method : {Method::nodal, Method::mortar})
    {
      check(held_blocks<2>(method, Friction::Coulomb, "0.2"));
      check(held_blocks<2>(method, Friction::Coulomb, "0.5 - 0.4*x"));
      check(held_blocks<2>(method, Friction::Tresca, "3"));
      check(held_blocks<3>(method, Friction::Coulomb, "0.3"));
      check(held_blocks<3>(method, Friction::Tresca, "3"));
    }
  EXPECT_GT(slipping, 15u);
  EXPECT_GT(sticking, 15u);
}

TEST(StateFriction, NoCoefficientIsNoFriction)
{
  auto with    = held_blocks<3>(contact::Method::mortar, contact::Friction::Coulomb, "0"),
       without = with;
  without.pairs[0].parameters.friction = contact::Friction::none;
  Problem<3> a(with), b(without);
  const auto one = a.solve(), other = b.solve();
  EXPECT_FALSE(one.has_friction());
  EXPECT_EQ(one.f_mults, other.f_mults);
  EXPECT_EQ(one.energy, other.energy);
}

/// A block that lies on another one, pushed with a part of the force that friction holds.
template <int dim>
TestScene<dim> pushed_block(double part)
{
  auto scene                    = two_blocks<dim>(4, 4, 0.);
  scene.bodies[0].supports      = {};
  scene.bodies[0].size[dim - 1] = 0.5;
  auto &load                    = scene.bodies[0].loads[face_index(dim - 1, 1)];
  load.traction[0]              = (dim == 3 ? 0.6 : 1.) * part * 0.3 * load.pressure;
  if (dim == 3)
    load.traction[1] = 0.8 * part * 0.3 * load.pressure;
  scene.friction       = contact::Friction::Coulomb;
  scene.friction_value = "0.3";
  return scene;
}

TEST(StateFriction, BlocksHoldUpToTheLimit)
{
  for (const double part : {0., 0.5, 0.99, 0.999})
    {
      Problem<2> plane(pushed_block<2>(part));
      EXPECT_LE(plane.solve().certificate.worst(), 1e-10) << part;
      Problem<3> space(pushed_block<3>(part));
      EXPECT_LE(space.solve().certificate.worst(), 1e-10) << part;
    }
  const auto message = [](auto &problem) -> std::string {
    try
      {
        problem.solve();
      }
    catch (const SolveError &error)
      {
        return error.what();
      }
    return "";
  };
  Problem<2> plane(pushed_block<2>(1.001));
  EXPECT_EQ(message(plane).rfind("no equilibrium: body punch is not held against its load", 0), 0u)
    << message(plane);
  Problem<3> space(pushed_block<3>(1.001));
  EXPECT_EQ(message(space).rfind("no equilibrium: body punch is not held against its load", 0), 0u)
    << message(space);
  // The bound is that of a state, not of the loads alone.
  auto bounded           = pushed_block<2>(0.5);
  bounded.friction       = contact::Friction::Tresca;
  bounded.friction_value = "1.4"; // the load is 1.5 per length
  Problem<2> tresca(bounded);
  EXPECT_EQ(message(tresca).rfind("slides: body punch", 0), 0u) << message(tresca);
}

/// Nothing holds the bodies, which spread by different amounts and may move together.
TEST(StateFriction, FreeBodiesSpreadOnEachOther)
{
  for (const unsigned int n : {4u, 5u})
    {
      auto scene               = pushed_block<2>(0.);
      scene.friction_value     = "0.1";
      scene.bodies[0].cells    = {n, 3};
      scene.bodies[0].material = {300., 0.1, 0.};
      scene.bodies[1].supports = {};
      const double pressure    = scene.bodies[0].loads[face_index(1, 1)].pressure;
      scene.bodies[1].loads[face_index(1, 0)].pressure = pressure;
      for (auto &body : scene.bodies)
        for (const unsigned int side : {0u, 1u})
          body.loads[face_index(0, side)].pressure = 0.5 * pressure;
      const auto state = Problem<2>(scene).solve();
      EXPECT_LE(state.certificate.worst(), 1e-10);
      EXPECT_GT(state.slipping_contacts, 0u);
      EXPECT_NEAR(state.contact_force[0], 0., 1e-8);
    }
}

/// Friction alone holds the bodies across a gap that the loads close.
TEST(StateFriction, BalancedBodiesHoldAcrossAGap)
{
  for (const auto method : {contact::Method::nodal, contact::Method::mortar})
    {
      auto scene = pushed_block<2>(0.5);
      scene.bodies[0].corner[1] += 1e-2;
      scene.method                       = method;
      auto &foundation                   = scene.bodies[1];
      foundation.supports                = {};
      foundation.loads[face_index(1, 0)] = scene.bodies[0].loads[face_index(1, 1)];
      foundation.loads[face_index(1, 0)].traction *= -1.;
      // The couple of the shears about the middle is balanced by a moment.
      const double couple                                    = 0.5 * 0.3 * 10. * 1.51;
      foundation.loads[face_index(1, 0)].resultant.moment[2] = couple;
      Problem<2> problem(scene);
      const auto state = problem.solve();
      EXPECT_LE(state.certificate.worst(), 1e-10);
      EXPECT_NEAR(std::abs(state.contact_force[0]), 1.5, 1e-8);
    }
}

/// The same state by other subdomains, with the bodies in another order and the axes along the
/// contact exchanged, which turns the tangents.
TEST(StateFriction, DoesNotDependOnSubdomainsOrderAndAxes)
{
  auto scene = pushed_block<3>(0.7);
  // Contacts at the edges slip.
  scene.bodies[0].material.poissons_ratio = 0.45;
  scene.bodies[0].radius                  = 20.;
  const auto reference                    = Problem<3>(scene).solve();
  EXPECT_GT(reference.slipping_contacts, 0u);
  EXPECT_LT(reference.slipping_contacts, reference.active_contacts);
  const auto expect_same = [&](const TestScene<3> &other) {
    const auto state = Problem<3>(other).solve();
    EXPECT_EQ(state.slipping_contacts, reference.slipping_contacts);
    EXPECT_NEAR(state.dissipation, reference.dissipation, 1e-9 * reference.dissipation);
    EXPECT_NEAR(state.strain_energy, reference.strain_energy, 1e-9 * reference.strain_energy);
    EXPECT_NEAR(state.max_pressure, reference.max_pressure, 1e-8 * reference.max_pressure);
  };
  for (const unsigned int n : {2u, 16u})
    {
      auto other       = scene;
      other.subdomains = n;
      expect_same(other);
    }
  auto reordered = scene;
  std::swap(reordered.bodies[0], reordered.bodies[1]);
  reordered.pairs                 = {{{1, face_index(2, 0)}, {0, face_index(2, 1)}}};
  auto &parameters                = reordered.pairs[0].parameters;
  parameters.slave                = contact::Slave::first;
  parameters.method               = scene.method;
  parameters.friction             = scene.friction;
  parameters.friction_coefficient = scene.friction_value;
  expect_same(reordered);
  auto  turned = scene;
  auto &load   = turned.bodies[0].loads[face_index(2, 1)].traction;
  std::swap(load[0], load[1]);
  expect_same(turned);
}

/// A block spreads on a plane, and all contacts slip: one must stick, as nothing else holds it.
TEST(StateFriction, AllSlipWithoutShear)
{
  auto scene                              = pushed_block<2>(0.);
  scene.friction_value                    = "0.01";
  scene.bodies[0].cells                   = {5, 3};
  scene.bodies[0].material.poissons_ratio = 0.45;
  scene.bodies[1].material.youngs_modulus = 1e8;
  const auto state                        = Problem<2>(scene).solve();
  EXPECT_LE(state.certificate.worst(), 1e-10);
  EXPECT_GE(state.slipping_contacts + 2, state.active_contacts);
  EXPECT_NEAR(state.contact_force[0], 0., 1e-8);
}
