#include <snug/io/contact_output.h>
#include <snug/io/whole_mesh.h>

#include <gtest/gtest.h>

#include <cmath>

#include "boxes.h"
#include "scratch.h"
#include "vtu_reader.h"

namespace snug {
namespace {
double pressure_at(double x)
{
  return 3. + 2. * x;
}

/// Body 1's bottom (slave) on body 0's top, with a row at every slave node
/// that does not hang and made-up results.
template <int dim>
struct ContactScene
{
  explicit ContactScene(unsigned int degree)
    : mesh(MPI_COMM_WORLD, test::two_boxes<dim>(true), degree)
    , slave(1, geometry::boundary_index(mesh.geometry(1), "bottom"))
    , master(0, geometry::boundary_index(mesh.geometry(0), "top"))
    , surface(mesh, {slave, master})
    , pairs{{{slave, master}, {{slave, master, 0}}, slave, master}}
  {
    state.positions     = mesh.reference_positions();
    state.displacement  = test::linear_field<dim>(state.positions);
    const auto        x = surface.gather(state.positions);
    std::vector<bool> is_slave(surface.n_nodes(), false);
    for (const auto &face : surface.faces())
      if (face.body == 1)
        for (const unsigned int node : face.nodes)
          is_slave[node] = true;
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (is_slave[node] && surface.masters(node).empty())
        {
          places.push_back({0, node});
          state::ContactPoint point;
          point.pressure = pressure_at(x[node][0]);
          point.force    = 0.1 * point.pressure;
          point.area     = 0.1;
          point.gap      = 1e-3 * x[node][0];
          point.active   = x[node][0] < 0.6;
          point.weak     = node % 2 == 0;
          state.contact.push_back(point);
        }
  }

  typename io::ContactOutput<dim>::Sources sources() const
  {
    return {mesh, surface, pairs, places, shared, placed, whole.number_of};
  }

  mesh::BodyMesh<dim>                       mesh;
  std::pair<unsigned int, unsigned int>     slave, master;
  mesh::Surface<dim>                        surface;
  contact::PlacedSurface<dim>               placed{surface, {}};
  std::vector<contact::JoinedPair>          pairs;
  std::vector<contact::RowPlace>            places;
  std::vector<contact::DependentMultiplier> shared;
  state::ContactState<dim>                  state;
  io::WholeMesh<dim> whole = io::gather_mesh<dim>(mesh, mesh.reference_positions());
};

template <int dim>
void expect_contact_faces(unsigned int degree)
{
  const test::ScratchDirectory scratch;
  const ContactScene<dim>      scene(degree);
  io::ContactOutput<dim>       output(scratch.path, {}, {"lower", "upper"});
  output.write(scene.sources(), 0., scene.state);
  if (!scratch.is_first())
    return;

  const auto vtu = test::read_blocks(scratch.file("contact-0000"), ".vtu");
  EXPECT_EQ(vtu.n_cells, scene.surface.faces().size() * std::lround(std::pow(degree, dim - 1)));
  const auto at = [&](const std::string &name, unsigned int p) {
    return vtu.arrays.at(name)[p * vtu.components.at(name)];
  };
  unsigned int slaves = 0;
  double       active = 0.;
  for (unsigned int p = 0; p < vtu.n_points; ++p)
    {
      const double x     = at("", p);
      const bool   slave = at("slave", p) == 1.f;
      slaves += slave;
      active += at("active", p);
      EXPECT_EQ(at("body", p), slave ? 1.f : 0.f);
      // the pressure is linear: hanging nodes interpolate it exactly
      EXPECT_NEAR(at("pressure", p), slave ? pressure_at(x) : 0., 1e-6);
      EXPECT_NEAR(at("gap", p), slave ? 1e-3 * x : 0., 1e-9);
      EXPECT_EQ(at("active", p), slave && x < 0.6 ? 1.f : 0.f);
      EXPECT_EQ(at("design_displacement", p), 0.f);
      double u = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        u += test::displacement_gradient<dim>()[0][c] * vtu.arrays.at("")[3 * p + c];
      EXPECT_NEAR(at("displacement", p), u, 1e-6);
    }
  EXPECT_GT(slaves, 0u);
  EXPECT_LT(slaves, vtu.n_points);
  EXPECT_GT(active, 0.);
}

/// Tables have nine digits.
void expect_digits(const std::string &text, const double expected)
{
  EXPECT_NEAR(std::stod(text), expected, 1e-8 * std::abs(expected));
}

TEST(ContactOutput, ShowsBothSidesWithHangingNodes)
{
  for (const unsigned int degree : {1, 2})
    {
      expect_contact_faces<2>(degree);
      expect_contact_faces<3>(degree);
    }
}

TEST(ContactOutput, NodesWithoutARowShowTheMeanOfThoseThatActForThem)
{
  const test::ScratchDirectory scratch;
  ContactScene<2>              scene(1);
  const unsigned int           node = scene.places.back().slave;
  scene.places.pop_back();
  scene.state.contact.pop_back();
  scene.shared.push_back({node, {{0, 0.25}, {1, 0.75}}});
  io::ContactOutput<2> output(scratch.path, {}, {"lower", "upper"});
  output.write(scene.sources(), 0., scene.state);
  const auto x = scene.surface.gather(scene.state.positions)[node];
  if (!scratch.is_first())
    return;
  const auto   vtu = test::read_blocks(scratch.file("contact-0000"), ".vtu");
  const double mean =
    0.25 * scene.state.contact[0].pressure + 0.75 * scene.state.contact[1].pressure;
  unsigned int found = 0;
  for (unsigned int p = 0; p < vtu.n_points; ++p)
    if (std::abs(vtu.arrays.at("")[3 * p] - x[0]) < 1e-6 && vtu.arrays.at("slave")[p] == 1.f)
      {
        ++found;
        EXPECT_NEAR(vtu.arrays.at("pressure")[p], mean, 1e-6);
        EXPECT_EQ(vtu.arrays.at("candidate")[p], 0.f);
      }
  EXPECT_GT(found, 0u);
}

TEST(ContactOutput, TableReadsBackToNineDigits)
{
  const test::ScratchDirectory scratch;
  const ContactScene<3>        scene(1);
  io::ContactOutput<3>         output(scratch.path, {}, {"lower", "upper"});
  output.write(scene.sources(), 0., scene.state);
  output.write(scene.sources(), 5., scene.state);
  const auto x = scene.surface.gather(scene.state.positions);
  if (!scratch.is_first())
    return;
  const auto table = test::read_csv(test::read_file(scratch.file("contact-0001.csv")));
  ASSERT_EQ(table.size(), scene.state.contact.size() + 1);
  EXPECT_EQ(table[0], (std::vector<std::string>{"pair", "node", "x", "y", "z", "normal_x",
                                                "normal_y", "normal_z", "force", "pressure", "gap",
                                                "area", "active", "weak"}));
  for (unsigned int i = 0; i < scene.state.contact.size(); ++i)
    {
      const auto &fields = table[i + 1];
      const auto &point  = scene.state.contact[i];
      ASSERT_EQ(fields.size(), 14u);
      // The number is that of the node at this place in mesh files.
      for (unsigned int c = 0; c < 3; ++c)
        {
          expect_digits(fields[2 + c], x[scene.places[i].slave][c]);
          expect_digits(fields[2 + c], scene.whole.positions.at(std::stoul(fields[1]) - 1)[c]);
        }
      for (unsigned int c = 0; c < 3; ++c) // of the bottom of a box
        EXPECT_NEAR(std::stod(fields[5 + c]), c == 2 ? -1. : 0., 1e-14);
      expect_digits(fields[8], point.force);
      expect_digits(fields[9], point.pressure);
      expect_digits(fields[10], point.gap);
      expect_digits(fields[11], point.area);
      EXPECT_EQ(fields[12], point.active ? "1" : "0");
      EXPECT_EQ(fields[13], point.weak ? "1" : "0");
    }
  const auto pvd = test::read_file(scratch.file("contact.pvd"));
  EXPECT_EQ(test::count(pvd, "<DataSet"), 2u);
  EXPECT_NE(pvd.find("timestep=\"5\""), std::string::npos);
}

/// The nodes along the bottom of a body in 2D, whose body lies on the left.
TEST(ContactOutput, TableFollowsTheFaceInThePlane)
{
  const test::ScratchDirectory scratch;
  const ContactScene<2>        scene(2);
  io::ContactOutput<2>         output(scratch.path, {}, {"lower", "upper"});
  output.write(scene.sources(), 0., scene.state);
  if (!scratch.is_first())
    return;
  const auto table = test::read_csv(test::read_file(scratch.file("contact-0000.csv")));
  ASSERT_EQ(table.size(), scene.state.contact.size() + 1);
  ASSERT_EQ(table[0][6], "arc_length");
  const double begin = std::stod(table[1][2]) - std::stod(table[1][6]);
  for (unsigned int i = 1; i < table.size(); ++i)
    {
      EXPECT_NEAR(std::stod(table[i][2]) - begin, std::stod(table[i][6]), 1e-14);
      if (i > 1)
        {
          EXPECT_GT(std::stod(table[i][6]), std::stod(table[i - 1][6]));
        }
    }
}

/// The boxes are tied, and not in contact.
TEST(ContactOutput, ShowsTensionAndShearOfTiedPairs)
{
  const test::ScratchDirectory scratch;
  ContactScene<3>              scene(1);
  auto                        &state = scene.state;
  const auto                   x     = scene.surface.gather(state.positions);
  contact::Pair                pair{scene.slave, scene.master};
  pair.parameters.slave  = contact::Slave::first;
  pair.parameters.method = contact::Method::nodal;
  const contact::Contact<3> ties(scene.surface, {pair}, 1, x,
                                 faces::HeldDirections<3>(scene.surface.n_nodes()));
  scene.pairs.clear();
  scene.places.clear();
  state.contact.clear();
  for (const auto &place : ties.places())
    {
      state::ContactPoint point;
      point.pressure    = -pressure_at(x[place.slave][0]);
      point.force       = 0.1 * point.pressure;
      point.area        = 0.1;
      point.traction[1] = x[place.slave][0];
      point.shear[1]    = -0.1 * x[place.slave][0];
      state.tied.push_back(point);
    }
  auto sources = scene.sources();
  sources.ties = &ties;
  io::ContactOutput<3> output(scratch.path, {}, {"lower", "upper"});
  output.write(sources, 0., state);
  if (!scratch.is_first())
    return;
  const auto vtu = test::read_blocks(scratch.file("contact-0000"), ".vtu");
  for (unsigned int p = 0; p < vtu.n_points; ++p)
    {
      const double at    = vtu.arrays.at("")[3 * p];
      const bool   slave = vtu.arrays.at("body")[p] == 1.f;
      EXPECT_NEAR(vtu.arrays.at("tie_tension")[p], slave ? pressure_at(at) : 0., 1e-6);
      EXPECT_NEAR(vtu.arrays.at("tie_shear")[3 * p + 1], slave ? at : 0., 1e-6);
      EXPECT_EQ(vtu.arrays.at("pressure")[p], 0.f);
    }
  const auto table = test::read_csv(test::read_file(scratch.file("ties-0000.csv")));
  ASSERT_EQ(table.size(), state.tied.size() + 1);
  EXPECT_EQ(table[0], (std::vector<std::string>{"pair", "node", "x", "y", "z", "normal_x",
                                                "normal_y", "normal_z", "force", "tension", "area",
                                                "shear_x", "shear_y", "shear_z", "shear_force_x",
                                                "shear_force_y", "shear_force_z"}));
  for (unsigned int i = 1; i < table.size(); ++i)
    {
      const double at = std::stod(table[i][2]);
      expect_digits(table[i][8], 0.1 * pressure_at(at));
      expect_digits(table[i][9], pressure_at(at));
      expect_digits(table[i][12], at);
      expect_digits(table[i][15], 0.1 * at);
    }
}

TEST(ContactOutput, WithoutPairsIsEmptyButValid)
{
  const test::ScratchDirectory           scratch;
  const mesh::BodyMesh<2>                mesh(MPI_COMM_WORLD, test::two_boxes<2>(false), 1);
  const mesh::Surface<2>                 surface(mesh, {});
  const std::vector<contact::JoinedPair> pairs;
  const std::vector<contact::RowPlace>   places;
  const std::vector<contact::DependentMultiplier> shared;
  io::ContactOutput<2>                            output(scratch.path, {}, {"lower", "upper"});
  state::ContactState<2>                          state;
  state.positions    = mesh.reference_positions();
  state.displacement = mesh.reference_positions();
  output.write({mesh, surface, pairs, places, shared, contact::PlacedSurface<2>(surface, {}), {}},
               0., state);
  if (!scratch.is_first())
    return;
  EXPECT_EQ(test::count(test::read_file(scratch.file("contact-0000.vtm")), "<DataSet"), 0u);
}
} // namespace
} // namespace snug
