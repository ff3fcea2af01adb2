#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unit/state/test_scene.h>

namespace {
using namespace snug;
using namespace snug::test;

/// Entries of the owned rows of B with their unknowns.
struct RowEntry
{
  unsigned int row;
  double       value;
};
using Columns = std::map<std::pair<unsigned int, unsigned int>, std::vector<RowEntry>>;

template <int dim>
Columns owned_columns(const Problem<dim> &problem)
{
  const auto               &gluing = problem.solver.gluing(0);
  const auto                rows   = problem.solver.rows(problem.mesh.reference_positions(), 0);
  std::vector<double>       values;
  std::vector<feti::BEntry> B;
  for (unsigned int s = 0; s < problem.tearing.subdomains.size(); ++s)
    {
      gluing.fill_B(s, rows, B);
      for (const auto &entry : B)
        values.push_back(entry.value);
    }
  const auto  gathered = gluing.layout().gather_entries(1, values);
  const auto &start    = gluing.layout().entry_start();
  Columns     columns;
  for (unsigned int row = 0; row < gluing.layout().n_owned(); ++row)
    for (unsigned int e = start[row]; e < start[row + 1]; ++e)
      {
        const auto &unknown = gluing.layout().entry_unknowns()[e];
        columns[{unknown.subdomain, unknown.dof}].push_back({row, gathered[e]});
      }
  return columns;
}

/// Largest entry of B B' - I, over the gluing and support rows and over all.
template <int dim>
std::pair<double, double> distance_from_orthonormal(const Problem<dim> &problem)
{
  std::map<std::pair<unsigned int, unsigned int>, double> BB;
  for (const auto &column : owned_columns(problem))
    for (const RowEntry &a : column.second)
      for (const RowEntry &b : column.second)
        BB[{a.row, b.row}] += a.value * b.value;
  const auto &bounded = problem.solver.gluing(0).layout().contact_rows();
  double      gluing = 0., all = 0.;
  for (const auto &entry : BB)
    {
      const unsigned int i = entry.first.first, j = entry.first.second;
      const double       error = std::abs(entry.second - (i == j));
      all                      = std::max(all, error);
      if (!bounded[i] && !bounded[j])
        gluing = std::max(gluing, error);
    }
  return {dealii::Utilities::MPI::max(gluing, MPI_COMM_WORLD),
          dealii::Utilities::MPI::max(all, MPI_COMM_WORLD)};
}

template <int dim>
TestScene<dim> node_to_node(unsigned int degree, bool hanging)
{
  auto scene   = two_blocks<dim>(4, 4, 0.);
  scene.degree = degree;
  scene.bodies[0].supports.clear();
  if (hanging)
    for (auto &body : scene.bodies)
      body.refined_below = 0.45;
  return scene;
}

TEST(Gluing, RowsAreOrthonormalForNodeToNodeContact)
{
  const double round_off = 1e-14;
  for (const unsigned int degree : {1, 2})
    {
      EXPECT_LT(distance_from_orthonormal(Problem<2>(node_to_node<2>(degree, false))).second,
                round_off);
      EXPECT_LT(distance_from_orthonormal(Problem<2>(node_to_node<2>(degree, true))).second,
                round_off);
    }
  EXPECT_LT(distance_from_orthonormal(Problem<3>(node_to_node<3>(1, false))).second, round_off);
}

TEST(Gluing, GluingRowsAreOrthonormalAlways)
{
  auto scene = two_blocks<3>(4, 3, 3.);
  set_design(scene, 3, 0.03);
  for (auto &body : scene.bodies)
    body.refined_below = 0.45;
  scene.bodies[1].supports[face_index(0, 0)] = {0};
  const auto distance                        = distance_from_orthonormal(Problem<3>(scene));
  EXPECT_LT(distance.first, 1e-14);
  // node to face, and rollers at contact nodes: what W is for
  EXPECT_GT(distance.second, 1e-3);
}

TEST(Gluing, EqualityRowsThatShareAnUnknownHaveOneOwner)
{
  auto scene = two_blocks<3>(4, 3, 3.);
  for (auto &body : scene.bodies)
    body.refined_below = 0.45;
  scene.subdomains = 12;
  const Problem<3>          problem(scene);
  std::vector<unsigned int> owned;
  const auto               &of_contact = problem.solver.gluing(0).layout().contact_rows();
  for (const auto &column : owned_columns(problem))
    if (std::any_of(column.second.begin(), column.second.end(),
                    [&](const RowEntry &entry) { return !of_contact[entry.row]; }))
      {
        owned.push_back(column.first.first);
        owned.push_back(column.first.second);
      }
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> owners;
  for (const auto &part : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, owned))
    for (unsigned int i = 0; i < part.size(); i += 2)
      EXPECT_EQ(++owners[std::make_pair(part[i], part[i + 1])], 1u);
}

/// A continuous field that the supports allow, per subdomain.
template <int dim>
feti::PrimalVectors continuous_field(const Problem<dim> &problem)
{
  feti::PrimalVectors u;
  for (const auto &subdomain : problem.tearing.subdomains)
    {
      u.emplace_back(dim * subdomain.nodes.size());
      for (unsigned int a = 0; a < subdomain.nodes.size(); ++a)
        {
          const unsigned int node = subdomain.nodes[a];
          const auto        &x    = problem.mesh.reference_positions()[node];
          const auto        &body = problem.scene.bodies[problem.mesh.body_of_node(node)];
          for (unsigned int c = 0; c < dim; ++c)
            {
              double value = std::sin(1. + c + 3. * x[0] + 5. * x[1]) + 0.1 * x[dim - 1];
              for (const auto &support : body.supports)
                for (const unsigned int fixed : support.second)
                  if (fixed == c)
                    value *= x[support.first / 2] - body.corner[support.first / 2] -
                             (support.first % 2) * body.size[support.first / 2];
              u.back()(dim * a + c) = value;
            }
        }
    }
  return u;
}

template <int dim>
void expect_rows_of_B(const TestScene<dim> &scene)
{
  Problem<dim> problem(scene);
  const auto   state  = problem.solve(); // fills B at the design
  const auto   u      = continuous_field(problem);
  const auto   Bu     = problem.solver.feti(state).linearization().multiply_B(u);
  const auto  &gluing = problem.solver.gluing(0);
  for (unsigned int i = 0; i < Bu.n_rows(); ++i)
    EXPECT_TRUE(gluing.layout().contact_rows()[i] || std::abs(Bu(i)) < 1e-13);
  // contact rows: the physical row over nr, on the displacement field
  const auto                  &surface = problem.solver.surface();
  typename Problem<dim>::Field field(problem.mesh.n_local_nodes());
  for (unsigned int s = 0; s < u.size(); ++s)
    for (unsigned int a = 0; a < u[s].n_rows(); ++a)
      field[problem.tearing.subdomains[s].nodes[a / dim]][a % dim] = u[s](a);
  const auto at_surface = surface.gather(field);
  const auto rows       = problem.solver.rows(state.positions, 0);
  const auto of_rows    = gluing.gather_contact(Bu).front();
  const auto right      = gluing.right_hand_side(rows, 0);
  const auto gaps       = gluing.gather_contact(right).front();
  ASSERT_EQ(rows.contact.size(), gluing.n_contact_rows());
  EXPECT_TRUE(gluing.vanished_rows().empty());
  for (unsigned int i = 0; i < rows.contact.size(); ++i)
    {
      double value = 0.;
      for (const auto &c : rows.contact[i].coefficients)
        value += c.second * at_surface[c.first];
      const double nr = gluing.contact_scales()[i];
      EXPECT_NEAR(of_rows[i], value / nr, 1e-13);
      EXPECT_NEAR(gaps[i], rows.contact[i].gap / nr, 1e-14);
    }
}

TEST(Gluing, RowsOfBAreTheConstraints2D)
{
  auto scene = two_blocks<2>(4, 5, 3.);
  set_design(scene, 3, 0.03);
  scene.degree = 2;
  expect_rows_of_B(scene);
}

TEST(Gluing, RowsOfBAreTheConstraints3D)
{
  // without hanging nodes on boundaries: the field is no interpolation there
  auto scene = two_blocks<3>(4, 3, 3.);
  set_design(scene, 3, 0.03);
  scene.bodies[1].supports[face_index(0, 0)] = {0};
  scene.subdomains                           = 12;
  expect_rows_of_B(scene);
}

TEST(Gluing, RowsBetweenHeldNodesVanish)
{
  // slave and master held vertically at the left: no dual row, but a check
  auto scene                                 = two_blocks<2>(4, 4, 0.);
  scene.bodies[0].supports[face_index(0, 0)] = {0, 1};
  scene.bodies[1].supports[face_index(0, 0)] = {0, 1};
  Problem<2> problem(scene);
  EXPECT_EQ(problem.solver.gluing(0).vanished_rows().size(), 1u);
  const auto state = problem.solve();
  EXPECT_LE(state.certificate.worst(), 1e-10);
  EXPECT_EQ(state.contact[problem.solver.gluing(0).vanished_rows()[0]].force, 0.);
  // lifting that corner into the held punch cannot be
  scene.control_points = {2, 1};
  Problem<2> lifted(scene);
  EXPECT_THROW(lifted.solve({0.01, 0.}), SolveError);
  EXPECT_NO_THROW(lifted.solve({-0.01, 0.}));
}
} // namespace
