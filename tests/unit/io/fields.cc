#include <snug/io/fields.h>
#include <snug/io/text_file.h>

#include <gtest/gtest.h>

#include <cmath>
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

std::string piece_of_rank(const std::string &stem)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return stem + ".000" + std::to_string(rank) + ".vtu";
}

/// Component @p c of array @p name at @p point.
double entry(const test::Vtu &vtu, const std::string &name, unsigned int point, unsigned int c = 0)
{
  return vtu.arrays.at(name)[point * vtu.components.at(name) + c];
}

/// The fields of a state whose displacement is linear, with body 1 moved by @p motion.
template <int dim>
void expect_linear_fields(unsigned int degree, const geometry::RigidMotion<dim> &motion = {})
{
  const test::ScratchDirectory scratch;
  Bodies<dim>                  bodies(true, degree);
  bodies.load_case.position.bodies[1] = motion;
  const auto           materials      = test::two_materials();
  io::FieldOutput<dim> output(scratch.path, a_file_per_rank());
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));

  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const auto vtu = test::read_vtu(test::read_file(scratch.file(piece_of_rank("solution-0000"))));
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
      for (unsigned int c = 0; c < 9; ++c)
        EXPECT_NEAR(entry(vtu, "stress", p, c), sigma[c / 3][c % 3], 1e-5);
      auto deviator = sigma;
      for (unsigned int i = 0; i < 3; ++i)
        deviator[i][i] -= trace(sigma) / 3.;
      EXPECT_NEAR(entry(vtu, "von_mises", p), std::sqrt(1.5) * deviator.norm(), 1e-5);
    }
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
  io::FieldOutput<2>           output(scratch.path, a_file_per_rank());
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));
  const auto vtu = test::read_vtu(test::read_file(scratch.file(piece_of_rank("solution-0000"))));
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
    io::FieldOutput<2>           output(scratch.path, parameters);
    output.write(bodies.sources(), 0., linear_state(bodies.mesh));
    return test::read_vtu(test::read_file(scratch.file(piece_of_rank("solution-0000"))));
  };
  const auto all = written(a_file_per_rank());
  for (const unsigned int level : {0, 9})
    EXPECT_EQ(written({Verbosity::normal, scene::OutputParameters().fields, level, 1}).arrays,
              all.arrays);
  auto few = all.arrays;
  for (const char *name : {"stress", "region", "subdomain", "design_displacement"})
    few.erase(name);
  EXPECT_EQ(written({Verbosity::normal, {"von_mises"}, 1, 1}).arrays, few);
}

TEST(FieldOutput, ListsTimesAndPieces)
{
  const test::ScratchDirectory scratch;
  const Bodies<2>              bodies(false, 1);
  io::FieldOutput<2>           output(scratch.path, a_file_per_rank());
  output.write(bodies.sources(), 0., linear_state(bodies.mesh));
  output.write(bodies.sources(), 17., linear_state(bodies.mesh));
  MPI_Barrier(MPI_COMM_WORLD);

  const std::string pvd  = test::read_file(scratch.file("solution.pvd"));
  const std::string pvtu = test::read_file(scratch.file("solution-0001.pvtu"));
  int               size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  EXPECT_NE(pvd.find("timestep=\"0\""), std::string::npos);
  EXPECT_NE(pvd.find("timestep=\"17\""), std::string::npos);
  EXPECT_NE(pvd.find("file=\"solution-0001.pvtu\""), std::string::npos);
  EXPECT_EQ(test::count(pvtu, "<Piece Source=\"solution-0001."), size);
  for (const char *name :
       {"displacement", "stress", "von_mises", "body", "subdomain", "design_displacement"})
    EXPECT_EQ(test::count(pvtu, std::string("Name=\"") + name + "\""), 1) << name;
}

/// Pieces are what is between the words that open and close the grid.
std::string pieces_of(const std::string &file)
{
  const std::string text  = test::read_file(file);
  const auto        begin = text.find("<Piece");
  return text.substr(begin, text.find("</UnstructuredGrid>") - begin);
}

TEST(FieldOutput, RanksShareFiles)
{
  const test::ScratchDirectory scratch;
  const Bodies<2>              bodies(false, 1);
  const auto                   state = linear_state(bodies.mesh);
  io::FieldOutput<2>           alone(scratch.path, a_file_per_rank());
  alone.write(bodies.sources(), 0., state);
  MPI_Barrier(MPI_COMM_WORLD);
  int size;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<std::string> of_rank;
  for (int rank = 0; rank < size; ++rank)
    of_rank.push_back(pieces_of(scratch.file("solution-0000." + io::padded(rank, 4) + ".vtu")));
  MPI_Barrier(MPI_COMM_WORLD);
  auto parameters           = a_file_per_rank();
  parameters.ranks_per_file = 2;
  io::FieldOutput<2> in_pairs(scratch.path, parameters);
  in_pairs.write(bodies.sources(), 0., state);
  MPI_Barrier(MPI_COMM_WORLD);
  for (int first = 0; first < size; first += 2)
    EXPECT_EQ(pieces_of(scratch.file("solution-0000." + io::padded(first / 2, 4) + ".vtu")),
              of_rank[first] + (first + 1 < size ? of_rank[first + 1] : ""));
  EXPECT_EQ(test::count(test::read_file(scratch.file("solution-0000.pvtu")), "<Piece Source"),
            (size + 1) / 2);
}

TEST(FieldOutput, AddsUpTheSharesOfTheShapeGradient)
{
  const test::ScratchDirectory scratch;
  const Bodies<2>              bodies(false, 1);
  io::FieldOutput<2>           output(scratch.path, a_file_per_rank());
  const auto                   state = linear_state(bodies.mesh);
  int                          rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  // all of a node's gradient on one rank, what it is from the position
  auto share = state.displacement;
  for (unsigned int node = 0; node < share.size(); ++node)
    if (bodies.mesh.owner(node) != static_cast<unsigned int>(rank))
      share[node] = 0.;
  output.write(bodies.sources(), 0., state, &share);
  const auto vtu = test::read_vtu(test::read_file(scratch.file(piece_of_rank("solution-0000"))));
  for (unsigned int p = 0; p < vtu.n_points; ++p)
    for (unsigned int c = 0; c < 2; ++c)
      EXPECT_EQ(entry(vtu, "shape_gradient", p, c), entry(vtu, "displacement", p, c));
}

TEST(FieldOutput, RankWithoutCellsWritesAnEmptyPiece)
{
  const test::ScratchDirectory              scratch;
  std::vector<geometry::BodyMeshParameters> bodies(1);
  bodies[0].cells = {1, 1};
  const mesh::BodyMesh<2>          mesh(MPI_COMM_WORLD, bodies, 1);
  std::vector<state::BodyModel<2>> models(1);
  models[0].materials        = {{1., 0.3}};
  const auto         tearing = test::one_subdomain_per_rank(mesh);
  io::FieldOutput<2> output(scratch.path, a_file_per_rank());
  output.write({mesh, tearing, models, state::LoadCase<2>()}, 0., linear_state(mesh));
  const auto vtu = test::read_vtu(test::read_file(scratch.file(piece_of_rank("solution-0000"))));
  EXPECT_EQ(vtu.n_cells, mesh.cells().size());
}

TEST(FieldOutput, EveryRankHearsOfFailure)
{
  const Bodies<2>    bodies(false, 1);
  io::FieldOutput<2> output("/nowhere/at/all", {});
  EXPECT_THROW(output.write(bodies.sources(), 0., linear_state(bodies.mesh)), std::runtime_error);
}
} // namespace
} // namespace snug
