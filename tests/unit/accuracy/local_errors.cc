#include <snug/accuracy/estimate.h>
#include <snug/accuracy/jumps.h>
#include <snug/accuracy/local_errors.h>
#include <snug/mesh/shared_nodes.h>

#include <gtest/gtest.h>
#include <unit/accuracy/guided_blocks.h>

namespace snug::test {
namespace {
template <int dim>
accuracy::EnergyEstimate estimate_of(const TestScene<dim> &scene, MPI_Comm comm = MPI_COMM_WORLD)
{
  Problem<dim> problem(scene, comm);
  return accuracy::estimate_energy(problem.solver, problem.solve());
}

/// The cell that holds the point @p x of the reference geometry, whose cells are boxes, and where.
template <int dim>
std::pair<unsigned int, dealii::Point<dim>>
place_of(const mesh::BodyMesh<dim> &mesh, const unsigned int body, const dealii::Point<dim> &x)
{
  for (unsigned int i = 0; i < mesh.cells().size(); ++i)
    {
      const auto &cell = mesh.cells()[i];
      const auto  low  = mesh.reference_positions()[cell.nodes.front()],
                 size  = mesh.reference_positions()[cell.nodes.back()] - low;
      dealii::Point<dim> xi;
      bool               holds = cell.body == body;
      for (unsigned int d = 0; d < dim && holds; ++d)
        {
          xi[d] = (x[d] - low[d]) / size[d];
          holds = xi[d] > 0. && xi[d] < 1.;
        }
      if (holds)
        return {i, xi};
    }
  throw std::logic_error("no cell holds the point");
}

/// Stress of a state in a cell.
template <int dim>
dealii::SymmetricTensor<2, 3> stress_at(const Problem<dim>             &problem,
                                        const state::ContactState<dim> &state,
                                        const unsigned int              i,
                                        const dealii::Point<dim>       &xi)
{
  const auto                         &mesh = problem.mesh;
  const auto                         &cell = mesh.cells()[i];
  std::vector<dealii::Tensor<1, dim>> X, u;
  for (const unsigned int node : cell.nodes)
    {
      X.push_back(mesh.reference_positions()[node]);
      u.push_back(state.displacement[node]);
    }
  const auto &model = problem.model.bodies[cell.body];
  return elasticity::Element<dim>(mesh.degree(), mesh.idealization(), model.formulation)
    .stresses(X, model.material(cell), u, {mesh::lagrange_point<dim>(mesh.degree(), xi)})[0];
}

/// |sigma - sigma_h| in the norm of the complementary energy, which for displacement methods is
/// |u - u_h|, and for mixed ones sees the error of the pressure, too. sigma is that of cells
/// @p finer times finer of degree 2.
template <int dim>
double stress_error(const TestScene<dim> &scene, const unsigned int finer)
{
  auto fine = scene;
  for (auto &body : fine.bodies)
    {
      body.refined_below = 0.;
      for (auto &n : body.cells)
        n *= finer;
    }
  fine.degree = 2;
  Problem<dim> coarse(scene, MPI_COMM_SELF), reference(fine, MPI_COMM_SELF);
  const auto   u_h = coarse.solve(), u = reference.solve();
  const auto  &mesh   = reference.mesh;
  double       square = 0.;
  for (unsigned int i = 0; i < mesh.cells().size(); ++i)
    {
      const auto &cell     = mesh.cells()[i];
      const auto &material = reference.model.bodies[cell.body].material(cell);
      std::vector<dealii::Tensor<1, dim>> X;
      for (const unsigned int node : cell.nodes)
        X.push_back(mesh.reference_positions()[node]);
      for (const auto &shape : mesh::lagrange_gauss_points<dim>(2))
        {
          const auto x               = dealii::Point<dim>(elasticity::value(shape, X));
          const auto [in_coarse, xi] = place_of(coarse.mesh, cell.body, x);
          const auto s =
            stress_at(reference, u, i, shape.point) - stress_at(coarse, u_h, in_coarse, xi);
          square += elasticity::CellPoint<dim>(shape, X, mesh.idealization()).dV *
                    (deviator(s) * deviator(s) / (2. * material.lame_mu()) +
                     trace(s) * trace(s) / (9. * material.bulk_modulus()));
        }
    }
  return std::sqrt(square);
}

/// eta over the error.
template <int dim>
double effectivity(const TestScene<dim> &scene, unsigned int finer)
{
  return estimate_of(scene).error / stress_error(scene, finer);
}

/// Bounds of a smooth solution, on meshes that are not yet fine.
template <int dim>
void expect_effective(const TestScene<dim> &scene, unsigned int finer, const std::string &what)
{
  if (!is_alone())
    return;
  const double found = effectivity(scene, finer);
  EXPECT_GT(found, 0.9) << what;
  EXPECT_LT(found, 1.2) << what;
}
} // namespace

TEST(EnergyEstimate, IsTheErrorOfSmoothStates)
{
  for (const unsigned int degree : {1, 2})
    {
      auto plane   = guided_blocks<2>(8, 8);
      plane.degree = degree;
      expect_effective(plane, 4, "plane");
    }
  auto plane         = guided_blocks<2>(8, 8);
  plane.idealization = {mesh::Idealization::Kind::plane_stress, 0.3};
  expect_effective(plane, 4, "plane stress");
  plane.idealization = {mesh::Idealization::Kind::axisymmetric};
  expect_effective(plane, 4, "axisymmetric");
  expect_effective(guided_blocks<3>(3, 3), 2, "solid");
}

TEST(EnergyEstimate, SeesHangingFaces)
{
  auto scene = guided_blocks<2>(8, 8);
  for (auto &body : scene.bodies)
    body.refined_below = 0.4;
  expect_effective(scene, 4, "hanging");
}

TEST(EnergyEstimate, SeesContactOfMeshesThatDoNotMatch)
{
  auto scene   = guided_blocks<2>(9, 8);
  scene.method = contact::Method::mortar;
  expect_effective(scene, 4, "mortar");
}

/// The error of the stress, whatever Poisson's ratio and the tolerance of the solver.
TEST(EnergyEstimate, SeesNearlyIncompressibleCells)
{
  if (!is_alone())
    return;
  for (const unsigned int degree : {1, 2})
    for (const double nu : {0.3, 0.49, 0.4999})
      {
        const double error = stress_error(nearly_incompressible<2>(8, nu, degree, 1e-9), 4);
        for (const double tolerance : {1e-9, 1e-2})
          {
            const double found =
              estimate_of(nearly_incompressible<2>(8, nu, degree, tolerance)).error / error;
            EXPECT_GT(found, 0.9) << nu << ", degree " << degree << ", to " << tolerance;
            EXPECT_LT(found, 1.6) << nu << ", degree " << degree << ", to " << tolerance;
          }
      }
}

namespace {
/// Compare the local errors of a rough field and of one at a single node with their bound.
template <int dim>
void expect_bound(const TestScene<dim> &scene, const std::string &what)
{
  Problem<dim>                           problem(scene, MPI_COMM_SELF);
  const auto                             state = problem.solve();
  const accuracy::LocalErrors<dim>       local(problem.solver, state);
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const unsigned int                     n = problem.mesh.n_local_nodes();
  for (const unsigned int only : {n, n / 2, n / 3, n - 1})
    {
      mesh::Field<dim> jump(n);
      for (unsigned int node = 0; node < n; ++node)
        for (unsigned int d = 0; d < dim; ++d)
          jump[node][d] = only == n || only == node ? uniform(generator) : 0.;
      problem.mesh.interpolate_hanging(jump);
      double square = 0.;
      for (const auto &cell : local.products({{jump, {}, {}, {}, 0., 0.}}))
        square += cell.norms[0] * cell.norms[0];
      const double bound = accuracy::bound_of_errors(problem.solver, state, jump);
      EXPECT_LT(3. * std::sqrt(square), bound) << what << ", node " << only;
      EXPECT_GT(1e6 * std::sqrt(square), bound) << what << ", node " << only;
    }
}
} // namespace

/// Whatever the materials that meet, Poisson's ratio and the shape of cells.
TEST(EnergyEstimate, BoundsErrorsOfJumps)
{
  if (!is_alone())
    return;
  for (const double nu : {0., 0.49, 0.49999})
    for (const unsigned int degree : {1, 2})
      {
        expect_bound(nearly_incompressible<2>(6, nu, degree, 1e-9), "mixed, plane");
        expect_bound(nearly_incompressible<3>(2, nu, degree, 1e-9), "mixed, solid");
      }
  for (const double modulus : {1e-2, 1e7})
    for (const double flat : {1., 0.01, 50.})
      {
        auto scene = guided_blocks<2>(6, 5);
        for (auto &body : scene.bodies)
          {
            body.core_from           = 0.5;
            body.core.youngs_modulus = modulus;
            body.size[1]             = flat;
          }
        expect_bound(scene, "materials, " + std::to_string(modulus) + ", " + std::to_string(flat));
      }
}

TEST(EnergyEstimate, SeesMaterialsThatMeet)
{
  auto scene = guided_blocks<2>(8, 8);
  scene.bodies.erase(scene.bodies.begin());
  scene.bodies[0].loads[face_index(1, 1)] = {10., {}, {}, {}, [](const dealii::Point<2> &x) {
                                               return 1. +
                                                      0.5 * std::cos(dealii::numbers::PI * x[0]);
                                             }};
  scene.bodies[0].core_from               = 0.5;
  for (const double modulus : {900., 50., 5., 1e5})
    {
      scene.bodies[0].core.youngs_modulus = modulus;
      expect_effective(scene, 4, "materials");
    }
}

TEST(EnergyEstimate, IsNoneOfUniformStates)
{
  auto scene                                 = two_blocks<2>(4, 4, 0.);
  scene.bodies[1].supports[face_index(1, 0)] = {1};
  EXPECT_LT(estimate_of(scene).relative, 1e-8);
  auto solid                                 = two_blocks<3>(2, 2, 0.);
  solid.bodies[1].supports[face_index(2, 0)] = {2};
  EXPECT_LT(estimate_of(solid).relative, 1e-8);
}

TEST(EnergyEstimate, IsThatOfOneRank)
{
  auto scene = guided_blocks<2>(8, 8);
  for (auto &body : scene.bodies)
    body.refined_below = 0.4;
  EXPECT_NEAR(estimate_of(scene).relative / estimate_of(scene, MPI_COMM_SELF).relative, 1., 1e-8);
}

TEST(EnergyEstimate, FallsWithTheCells)
{
  for (const unsigned int degree : {1, 2})
    {
      auto coarse = guided_blocks<2>(4, 4), fine = guided_blocks<2>(8, 8);
      coarse.degree = fine.degree = degree;
      const double ratio          = estimate_of(coarse).error / estimate_of(fine).error;
      EXPECT_NEAR(std::log2(ratio), degree, 0.15);
    }
}
} // namespace snug::test
