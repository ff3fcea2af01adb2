#include <snug/io/fields.h>
#include <snug/io/state_files.h>
#include <snug/io/text_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "boxes.h"
#include "scratch.h"
#include "vtu_reader.h"

namespace snug {
namespace {
/// A linear displacement of a design moved by (0.25, 0.5, ..).
template <int dim>
state::ContactState<dim> linear_state(const mesh::BodyMesh<dim> &mesh)
{
  state::ContactState<dim> state;
  state.positions = mesh.reference_positions();
  for (auto &x : state.positions)
    for (unsigned int k = 0; k < dim; ++k)
      x[k] += 0.25 * (k + 1);
  state.displacement = test::linear_field<dim>(state.positions);
  return state;
}

/// A mesh and all that is written beside its states.
template <int dim>
struct Bodies
{
  Bodies(const bool hanging, const unsigned int degree)
    : mesh(MPI_COMM_WORLD, test::two_boxes<dim>(hanging), degree)
    , tearing(test::one_subdomain_per_rank(mesh))
    , models(test::two_bodies<dim>())
  {}

  typename io::FieldOutput<dim>::Sources sources() const
  {
    return {mesh, tearing, models, load_case};
  }

  const mesh::BodyMesh<dim>                mesh;
  const mesh::Tearing                      tearing;
  const std::vector<state::BodyModel<dim>> models;
  state::LoadCase<dim>                     load_case;
};

scene::OutputParameters a_file_per_rank()
{
  scene::OutputParameters parameters;
  parameters.ranks_per_file = 1;
  return parameters;
}

const std::vector<std::string> names = {"lower", "upper"};

/// The first state of the bodies on this rank.
test::Vtu bodies_of_rank(const test::ScratchDirectory &scratch)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return test::read_blocks(scratch.file("solution-0000"), "." + io::padded(rank, 4) + ".vtu",
                           {0, 2});
}

/// Component @p c of array @p name at @p point.
double entry(const test::Vtu &vtu, const std::string &name, unsigned int point, unsigned int c = 0)
{
  return vtu.arrays.at(name)[point * vtu.components.at(name) + c];
}

/// The principal stresses are ordered and have the invariants of the stress.
void expect_principal_stress(const test::Vtu            &vtu,
                             const unsigned int          point,
                             const dealii::Tensor<2, 3> &sigma)
{
  double principal[3];
  for (unsigned int c = 0; c < 3; ++c)
    principal[c] = entry(vtu, "principal_stress", point, c);
  EXPECT_GE(principal[0], principal[1]);
  EXPECT_GE(principal[1], principal[2]);
  EXPECT_NEAR(principal[0] + principal[1] + principal[2], trace(sigma), 1e-5);
  EXPECT_NEAR(std::hypot(principal[0], principal[1], principal[2]), sigma.norm(), 1e-5);
  // relative to the product of the factors' sizes
  EXPECT_NEAR(principal[0] * principal[1] * principal[2], determinant(sigma),
              1e-6 * std::pow(sigma.norm(), 3));
}

/// The fields of a state whose displacement is linear, with body 1 moved by @p motion.
template <int dim>
void expect_linear_fields(unsigned int degree, const geometry::RigidMotion<dim> &motion = {})
{
  const test::ScratchDirectory scratch;
  Bodies<dim>                  bodies(true, degree);
  bodies.load_case.position.bodies[1] = motion;
  const auto           materials      = test::two_materials();
  io::FieldOutput<dim> output(scratch.path, a_file_per_rank(), names);
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));

  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const auto vtu = bodies_of_rank(scratch);
  EXPECT_EQ(vtu.n_cells, bodies.mesh.cells().size() * std::lround(std::pow(degree, dim)));
  const auto A = test::displacement_gradient<dim>();
  for (unsigned int p = 0; p < vtu.n_points; ++p)
    {
      dealii::Tensor<1, dim> x;
      for (unsigned int c = 0; c < dim; ++c)
        x[c] = entry(vtu, "", p, c);
      const geometry::RigidMotion<dim> to_space =
        entry(vtu, "body", p) == 1. ? motion : geometry::RigidMotion<dim>();
      x                       = to_space.point_back(x);
      const unsigned int body = x[dim - 1] < 1. + 0.25 * dim ? 0 : 1;
      // on the interface of the bodies x does not tell which one it is
      if (std::abs(x[dim - 1] - (1. + 0.25 * dim)) > 1e-6)
        {
          EXPECT_EQ(entry(vtu, "body", p), body);
        }
      dealii::Tensor<1, dim> moved;
      for (unsigned int c = 0; c < dim; ++c)
        moved[c] = 0.25 * (c + 1);
      moved        = to_space.vector(moved);
      const auto u = to_space.vector(A * x);
      // single precision of numbers of order 1 (fields) and 10 (stress)
      for (unsigned int c = 0; c < dim; ++c)
        {
          EXPECT_NEAR(entry(vtu, "displacement", p, c), u[c], 2e-6);
          EXPECT_NEAR(entry(vtu, "design_displacement", p, c), moved[c], 1e-6);
        }
      dealii::Tensor<2, 3> Q = dealii::unit_symmetric_tensor<3>();
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          Q[c][d] = to_space.Q[c][d];
      const auto sigma =
        Q * test::hooke(materials[std::lround(entry(vtu, "body", p))], A) * transpose(Q);
      const unsigned int row[] = {0, 1, 2, 0, 1, 0}, column[] = {0, 1, 2, 1, 2, 2};
      for (unsigned int c = 0; c < 6; ++c)
        EXPECT_NEAR(entry(vtu, "stress", p, c), sigma[row[c]][column[c]], 1e-5);
      expect_principal_stress(vtu, p, sigma);
      auto deviator = sigma;
      for (unsigned int i = 0; i < 3; ++i)
        deviator[i][i] -= trace(sigma) / 3.;
      EXPECT_NEAR(entry(vtu, "von_mises", p), std::sqrt(1.5) * deviator.norm(), 1e-5);
    }
  if (vtu.n_cells == 0) // a rank without cells has no blocks
    return;
  for (const float subdomain : vtu.arrays.at("subdomain"))
    EXPECT_EQ(subdomain, rank);
  EXPECT_EQ(vtu.arrays.at("subdomain").size(), vtu.n_cells);
}

TEST(FieldOutput, HoldsALinearStateIn2D)
{
  expect_linear_fields<2>(1);
  expect_linear_fields<2>(2);
}

TEST(FieldOutput, HoldsALinearStateIn3D)
{
  expect_linear_fields<3>(1);
  expect_linear_fields<3>(2);
}

TEST(FieldOutput, ShowsBodiesInTheirPositions)
{
  expect_linear_fields<2>(2, geometry::rigid_motion<2>("rotate z 30 about 1 0.5, shift 0.2 0"));
  expect_linear_fields<3>(1, geometry::rigid_motion<3>("rotate x 30, rotate z 10 about 1 0 0"));
}

/// The file of this rank has as many points as its cells have nodes.
TEST(FieldOutput, CellsShareTheirPoints)
{
  const test::ScratchDirectory scratch;
  const Bodies<2>              bodies(false, 2);
  io::FieldOutput<2>           output(scratch.path, a_file_per_rank(), names);
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));
  const auto             vtu = bodies_of_rank(scratch);
  std::set<unsigned int> nodes;
  for (const auto &cell : bodies.mesh.cells())
    nodes.insert(cell.nodes.begin(), cell.nodes.end());
  EXPECT_EQ(vtu.n_points, nodes.size());
}

TEST(FieldOutput, WritesWhatIsAskedForAtAnyCompression)
{
  const Bodies<2> bodies(false, 1);
  const auto      written = [&](const scene::OutputParameters &parameters) {
    const test::ScratchDirectory scratch;
    io::FieldOutput<2>           output(scratch.path, parameters, names);
    output.write(bodies.sources(), 0., linear_state(bodies.mesh));
    return bodies_of_rank(scratch);
  };
  const auto all = written(a_file_per_rank());
  for (const unsigned int level : {0, 9})
    EXPECT_EQ(written({Verbosity::normal, scene::OutputParameters().fields, level, 1}).arrays,
              all.arrays);
  auto few = all.arrays;
  for (const char *name :
       {"stress", "principal_stress", "region", "subdomain", "design_displacement"})
    few.erase(name);
  EXPECT_EQ(written({Verbosity::normal, {"von_mises"}, 1, 1}).arrays, few);
}

TEST(FieldOutput, ListsTimesAndPieces)
{
  const test::ScratchDirectory scratch;
  const Bodies<2>              bodies(false, 1);
  io::FieldOutput<2>           output(scratch.path, a_file_per_rank(), names);
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));
  output.write(bodies.sources(), 17., linear_state(bodies.mesh));
  MPI_Barrier(MPI_COMM_WORLD);

  const std::string pvd  = test::read_file(scratch.file("solution.pvd"));
  const std::string pvtu = test::read_file(scratch.file("solution-0001.pvtu"));
  EXPECT_NE(pvd.find("timestep=\"0\""), std::string::npos);
  EXPECT_NE(pvd.find("timestep=\"17\""), std::string::npos);
  EXPECT_NE(pvd.find("file=\"solution-0001.vtm\""), std::string::npos);
  // A file per body and rank with cells of the body, all of which are files of a block.
  const std::string vtm = test::read_file(scratch.file("solution-0001.vtm"));
  const auto        n   = test::count(pvtu, "<Piece Source=\"solution-0001/");
  EXPECT_GE(n, 2);
  EXPECT_EQ(test::count(vtm, "\"solution-0001/00-lower.") + test::count(vtm, "/01-upper.00"), n);
  for (const auto &body : names)
    EXPECT_EQ(test::count(vtm, " name=\"" + body + '"'), 1);
  EXPECT_EQ(test::count(vtm, "<Piece"), 0); // PyVista does not read pieces
  for (const char *name : {"displacement", "stress", "von_mises", "principal_stress", "body",
                           "subdomain", "design_displacement"})
    EXPECT_EQ(test::count(pvtu, std::string("Name=\"") + name + "\""), 1) << name;
}

/// Pieces are what is between the words that open and close the grid; none in a missing file.
std::string pieces_of(const std::string &file)
{
  if (!std::filesystem::exists(file))
    return "";
  const std::string text  = test::read_file(file);
  const auto        begin = text.find("<Piece");
  return text.substr(begin, text.find("</UnstructuredGrid>") - begin);
}

TEST(FieldOutput, RanksShareFiles)
{
  const Bodies<2> bodies(false, 1);
  const auto      state = linear_state(bodies.mesh);
  int             size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  // The pieces of the body "lower" per file, and the number of files of both bodies.
  const auto written = [&](const unsigned int ranks_per_file) {
    const test::ScratchDirectory scratch;
    auto                         parameters = a_file_per_rank();
    parameters.ranks_per_file               = ranks_per_file;
    io::FieldOutput<2> output(scratch.path, parameters, names);
    output.write(bodies.sources(), 0., state);
    MPI_Barrier(MPI_COMM_WORLD);
    std::vector<std::string> pieces;
    for (int group = 0; group < size; ++group)
      pieces.push_back(
        pieces_of(scratch.file("solution-0000/00-lower." + io::padded(group, 4) + ".vtu")));
    MPI_Barrier(MPI_COMM_WORLD);
    return pieces;
  };
  const auto alone = written(1), in_pairs = written(2), together = written(0);
  EXPECT_NE(alone[0] + alone.back(), "");
  for (int first = 0; first < size; first += 2)
    EXPECT_EQ(in_pairs[first / 2], alone[first] + (first + 1 < size ? alone[first + 1] : ""));
  EXPECT_EQ(together[0], std::accumulate(alone.begin(), alone.end(), std::string()));
}

TEST(FieldOutput, NumberOfFilesIsBounded)
{
  for (const unsigned int n_ranks : {1, 2, 16, 17, 256, 257, 1000, 1024, 100000})
    {
      const unsigned int n       = io::ranks_of_a_file(0, n_ranks);
      const unsigned int n_files = (n_ranks + n - 1) / n;
      EXPECT_EQ(n_files, n_ranks <= 256 ? (n_ranks + 15) / 16 : 16) << n_ranks;
      EXPECT_EQ(io::ranks_of_a_file(3, n_ranks), 3u);
    }
}

/// Boundaries have the points of their faces with the fields of their cells.
TEST(FieldOutput, NamesBoundaries)
{
  const test::ScratchDirectory scratch;
  const Bodies<3>              bodies(true, 2);
  io::FieldOutput<3>           output(scratch.path, {}, names);
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));
  MPI_Barrier(MPI_COMM_WORLD);
  const auto all = test::read_blocks(scratch.file("solution-0000"), ".vtu", {2, 99});
  EXPECT_EQ(all.n_cells,
            4 * dealii::Utilities::MPI::sum(bodies.mesh.boundary_faces().size(), MPI_COMM_WORLD));
  const auto A = test::displacement_gradient<3>();
  for (unsigned int body = 0; body < 2; ++body)
    for (const std::string boundary : {"left", "right", "front", "back", "bottom", "top"})
      {
        const auto vtu = test::read_blocks(scratch.file("solution-0000"),
                                           names[body] + '.' + boundary + ".0000.vtu");
        ASSERT_GT(vtu.n_points, 0u) << boundary;
        const unsigned int   index = geometry::boundary_index(bodies.mesh.geometry(body), boundary);
        std::set<float>      across;
        dealii::Tensor<1, 3> x;
        for (unsigned int p = 0; p < vtu.n_points; ++p)
          {
            for (unsigned int c = 0; c < 3; ++c)
              x[c] = entry(vtu, "", p, c);
            across.insert(entry(vtu, "", p, index / 2));
            EXPECT_NEAR(entry(vtu, "displacement", p, 1), (A * x)[1], 2e-6);
            EXPECT_EQ(entry(vtu, "body", p), body);
          }
        EXPECT_LT(*across.rbegin() - *across.begin(), 1e-6) << boundary;
      }
}

TEST(FieldOutput, AddsUpTheSharesOfTheShapeGradient)
{
  const test::ScratchDirectory scratch;
  const Bodies<2>              bodies(false, 1);
  io::FieldOutput<2>           output(scratch.path, a_file_per_rank(), names);
  const auto                   state = linear_state(bodies.mesh);
  int                          rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  // all of a node's gradient on one rank, what it is from the position
  auto share = state.displacement;
  for (unsigned int node = 0; node < share.size(); ++node)
    if (bodies.mesh.owner(node) != static_cast<unsigned int>(rank))
      share[node] = 0.;
  output.write(bodies.sources(), 0., state, &share);
  const auto vtu = bodies_of_rank(scratch);
  for (unsigned int p = 0; p < vtu.n_points; ++p)
    for (unsigned int c = 0; c < 2; ++c)
      EXPECT_EQ(entry(vtu, "shape_gradient", p, c), entry(vtu, "displacement", p, c));
}

TEST(FieldOutput, RankWithoutCellsWritesNoFile)
{
  const test::ScratchDirectory              scratch;
  std::vector<geometry::BodyMeshParameters> bodies(1);
  bodies[0].cells = {1, 1};
  const mesh::BodyMesh<2>          mesh(MPI_COMM_WORLD, bodies, 1);
  std::vector<state::BodyModel<2>> models(1);
  models[0].materials        = {{1., 0.3}};
  const auto         tearing = test::one_subdomain_per_rank(mesh);
  io::FieldOutput<2> output(scratch.path, a_file_per_rank(), names);
  output.write({mesh, tearing, models, state::LoadCase<2>()}, 0., linear_state(mesh));
  MPI_Barrier(MPI_COMM_WORLD);
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const auto vtu =
    test::read_blocks(scratch.file("solution-0000"), "." + io::padded(rank, 4) + ".vtu", {0, 1});
  EXPECT_EQ(vtu.n_cells, mesh.cells().size());
}

TEST(FieldOutput, EveryRankHearsOfFailure)
{
  const Bodies<2>    bodies(false, 1);
  io::FieldOutput<2> output("/nowhere/at/all", {}, names);
  EXPECT_THROW(output.write(bodies.sources(), 0., linear_state(bodies.mesh)), std::runtime_error);
}
} // namespace
} // namespace snug
