#include "files.h"

#include <deal.II/base/numbers.h>

using namespace snug;
using namespace snug::test;
using dealii::Point;

TEST(MeshFiles, AllFormatsGiveTheSameBlock)
{
  for (const auto &row : files())
    {
      SCOPED_TRACE(row.file);
      if (row.dim == 2)
        expect_block<2>(contents(row.file), row.parameters, row.n_cells);
      else
        expect_block<3>(contents(row.file), row.parameters, row.n_cells);
    }
}

TEST(MeshFiles, SurfacesOfAbaqusAreFacesOfElements)
{
  auto       text = contents("block.inp");
  const auto sets = text.find("*ELSET,ELSET=bottom");
  text            = text.substr(0, sets);
  for (const std::string name : {"Surface5", "Surface27"})
    text = replaced(text, ", ELSET=" + name, "");
  text += "*ELSET, ELSET=all, GENERATE\n5, 6, 1\n"
          "*SURFACE, NAME=bottom\nall, S1\n"
          "*SURFACE, NAME=top, TYPE=ELEMENT\n5, S2\n6, S2\n";
  expect_block<3>(text, file_body(), 2);
}

TEST(MeshFiles, WhatIsWrongIsNamedByLineAndElement)
{
  struct Case
  {
    std::string text, says;
  };
  const auto              unnamed = contents("block-unnamed.msh");
  const auto              msh     = contents("block-2.msh");
  const auto              inp     = contents("block.inp");
  const std::string       first   = "5 5 2 1 1 1 9 10 3 5 11 12 8";
  const std::vector<Case> cases   = {
    {unnamed.substr(0, unnamed.find(first) + 13), "line 25: the file ends where a node"},
    {replaced(unnamed, "7 2 1 1\n", "7 2 one 1\n"), "line 12: 'one' is not a number"},
    {replaced(unnamed, "2 2 0 0", "1 2 0 0"), "line 7: node 1 occurs twice"},
    {replaced(unnamed, "5 5 2 1", "5 99 2 1"), "line 25: element type 99 of Gmsh"},
    {replaced(unnamed, first, "5 5 2 1 1 1 9 10 3 5 11 12 99"),
       "line 25: element 5 has the node 99"},
    // the whole mesh may be left-handed, but not one element
    {replaced(unnamed, first, "5 5 2 1 1 5 11 12 8 1 9 10 3"), "line 25: element 5 is inverted"},
    {replaced(unnamed, "12 1 1 1", "12 1 1 -0.5"), "element 5 is inverted"},
    {replaced(unnamed, "1 3 2 2 5 1 9 10 3", "1 3 2 2 5 1 9 12 3"),
       "line 21: element 1 is not a face of a cell"},
    {replaced(msh, "\"bottom\"", "bottom"), "line 6: a physical name in quotes"},
    {replaced(msh, "2.2 0 8", "3.0 0 8"), "version 3.0"},
    {msh.substr(0, msh.find("$Elements")), "the file has no elements"},
    {replaced(inp, "type=C3D8", "type=Q31H"), "element type 'Q31H'"},
    {replaced(inp, "5, 6, \n", "5, 66, \n"), "the element 66, which does not exist"},
    {"solid part\n", "not a mesh file of Gmsh"},
    {"# vtk DataFile Version 2.0\n", "'meshio convert -o gmsh22 FILE part.msh' converts"},
    {"", "the file ends"}};
  for (const auto &item : cases)
    {
      const auto message = failure_reason(item.text, numbered_body(), 3);
      EXPECT_EQ(message.rfind("entry 'File' = 'the.mesh': ", 0), 0u) << message;
      EXPECT_NE(message.find(item.says), std::string::npos)
        << message << "\n  and not: " << item.says;
    }
  EXPECT_NE(failure_reason(contents("square.msh"), file_body(), 3)
              .find("it has 4 lines, 2 triangles and 1 quadrilateral: shells, membranes, rigid "
                    "elements or faces, without a volume"),
            std::string::npos);
  EXPECT_NE(failure_reason(msh, file_body(), 2).find("is a solid"), std::string::npos);
  auto region    = file_body();
  region.regions = {"blocks"};
  EXPECT_NE(failure_reason(msh, region, 3).find("which has the regions block"), std::string::npos);
}

TEST(MeshFiles, TruncatedFilesAreErrorsOrWhole)
{
  for (const auto &row : files())
    {
      const std::string text = contents(row.file);
      unsigned int      n    = 0;
      for (std::size_t length = 0; length < text.size(); length += 3)
        n += failure_reason(text.substr(0, length), row.parameters, row.dim) != "";
      // what is missing at the end may be unimportant
      EXPECT_GT(3 * n, 0.8 * text.size()) << row.file;
    }
}

TEST(MeshFiles, LeftHandedFilesAreTurned)
{
  auto text = contents("block-unnamed.msh");
  text      = replaced(text, "1 9 10 3 5 11 12 8", "5 11 12 8 1 9 10 3");
  text      = replaced(text, "9 2 4 10 11 6 7 12", "11 6 7 12 9 2 4 10");
  expect_block<3>(text, numbered_body(), 2);
}

TEST(MeshFiles, ClockwiseElementsAreTurnedButNotInvertedOnes)
{
  const auto square = contents("square.msh");
  // one surface, one element of a surface, and all elements
  for (const unsigned int n : {1, 2, 3})
    {
      auto text     = n == 2 ? square : replaced(square, "5 1 2 4 3", "5 1 3 4 2");
      text          = n == 1 ? text : replaced(text, "6 2 5 6", "6 5 2 6");
      text          = n == 1 ? text : replaced(text, "7 2 6 4", "7 6 2 4");
      auto body     = file_body();
      body.imported = mesh_file::import_mesh(text, body, 2);
      EXPECT_EQ(body.imported->notes.front(),
                std::to_string(n) + " clockwise element" + (n == 1 ? "" : "s") + " turned around");
      EXPECT_NEAR(file_volume(mesh::BodyMesh<2>(MPI_COMM_WORLD, {body}, 1)), 2., 1e-12);
    }
  // The node at (2, 1) makes the last triangle clockwise, but its edges are those of its
  // neighbours.
  const auto tangled = replaced(square, "6\n2 1 0", "6\n0.5 0.4 0");
  EXPECT_NE(failure_reason(tangled, file_body(), 2).find("element 7 is inverted"),
            std::string::npos)
    << failure_reason(tangled, file_body(), 2);
}

TEST(MeshFiles, GroupsWithoutANameAreCalledByTheirNumbers)
{
  const auto text     = contents("block-unnamed.msh");
  const auto names_of = [&](const std::map<std::string, std::string> &given) {
    auto body             = file_body();
    body.boundary_numbers = given;
    return mesh_file::import_mesh(text, body, 3)->solid->boundary_names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names_of({}), (Names{"group-2", "group-3", "free"}));
  EXPECT_EQ(names_of({{"3", "top"}}), (Names{"group-2", "top", "free"}));
  EXPECT_EQ(names_of({{"group-2", "bottom"}}), (Names{"bottom", "group-3", "free"}));
  // the same number of another dimension has a name
  const auto msh = replaced(contents("block-2.msh"), "2 2 \"bottom\"", "1 2 \"bottom\"");
  EXPECT_EQ(mesh_file::import_mesh(msh, file_body(), 3)->solid->boundary_names.front(), "group-2");
  auto sets          = numbered_body();
  sets.boundary_sets = {"group-2"};
  EXPECT_EQ(mesh_file::import_mesh(text, sets, 3)->solid->boundary_names,
            (Names{"bottom", "free"}));
}

TEST(MeshFiles, CellsMayBeTurnedAgainstEachOther)
{
  const auto text =
    replaced(contents("block-unnamed.msh"), "9 2 4 10 11 6 7 12", "2 6 7 4 9 11 12 10");
  expect_block<3>(text, numbered_body(), 2);
}

TEST(MeshFiles, HexahedraInATwistedRingAreSplit)
{
  // the section turns by 90 degrees on the way round
  const unsigned int n = 8;
  std::ostringstream nodes, elements;
  nodes.precision(17);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int k = 0; k < 4; ++k)
      {
        const double phi  = 2. * dealii::numbers::PI * i / n;
        const double turn = dealii::numbers::PI / 2. * (k + 1. * i / n);
        const double r    = 4. + std::cos(turn);
        nodes << 4 * i + k + 1 << ' ' << r * std::cos(phi) << ' ' << r * std::sin(phi) << ' '
              << -std::sin(turn) << '\n';
      }
  for (unsigned int i = 0; i < n; ++i)
    {
      elements << i + 1 << " 5 2 1 1";
      for (const unsigned int end : {0, 1})
        for (unsigned int k = 0; k < 4; ++k)
          elements << ' ' << (i + end < n ? 4 * (i + end) + k : (k + 1) % 4) + 1;
      elements << '\n';
    }
  auto body     = file_body();
  body.imported = mesh_file::import_mesh(gmsh_text(nodes.str(), elements.str()), body, 3);
  EXPECT_NE(body.imported->notes[0].find("no consistent directions"), std::string::npos);
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, {body}, 2);
  EXPECT_EQ(mesh.n_global_cells(), 8 * n);
  EXPECT_GT(file_volume(mesh), 0.);
}

TEST(MeshFiles, CurvedBoundariesStayOnTheirCircles)
{
  // half of a ring of radii 1 and 2 about (3, 0), in 4 quadrilaterals
  std::ostringstream nodes, elements;
  nodes.precision(17);
  for (unsigned int i = 0; i < 10; ++i)
    {
      const double angle = i / 2 * dealii::numbers::PI / 4, r = 1 + i % 2;
      nodes << i + 1 << ' ' << 3 + r * std::cos(angle) << ' ' << r * std::sin(angle) << " 0\n";
    }
  for (unsigned int i = 0; i < 4; ++i)
    elements << i + 1 << " 3 2 1 1 " << 2 * i + 1 << ' ' << 2 * i + 2 << ' ' << 2 * i + 4 << ' '
             << 2 * i + 3 << '\n'
             << i + 5 << " 1 2 1 1 " << 2 * i + 1 << ' ' << 2 * i + 3 << '\n'
             << i + 9 << " 1 2 2 1 " << 2 * i + 2 << ' ' << 2 * i + 4 << '\n';
  const auto text       = gmsh_text(nodes.str(), elements.str());
  auto       body       = file_body();
  body.boundary_numbers = {{"1", "inner"}, {"2", "outer"}};
  body.surfaces         = {{"inner", "smooth"}, {"outer", "smooth"}};
  body.refinements      = 2;
  body.imported         = mesh_file::import_mesh(text, body, 2);
  const mesh::BodyMesh<2> mesh(MPI_COMM_WORLD, {body}, 2);
  // quadratic edges of 11 degrees
  EXPECT_NEAR(file_volume(mesh), 1.5 * dealii::numbers::PI, 1e-4);
  const auto &names = mesh.geometry(0).boundary_names();
  for (const auto &face : mesh.boundary_faces())
    if (names[face.boundary] != "free")
      {
        const double radius = names[face.boundary] == "inner" ? 1. : 2.;
        for (const unsigned int node : face.nodes)
          EXPECT_NEAR((mesh.reference_positions()[node] - Point<2>(3., 0.)).norm(), radius, 1e-12);
      }
}

TEST(MeshFiles, CurvedBoundariesThatMeetLeaveNoGaps)
{
  // A ring whose side is a cylinder and whose cap a sphere: in its section, the two meet at the
  // corner (1, 1) of two quadrilaterals, one of which has only the side, the other only the cap.
  const unsigned int n                                 = 8;
  const double       section[6][2]                     = {{0.5, 0.}, {0.8, -0.3},       {1., 0.},
                                                          {1., 1.},  {0.5, sqrt(1.75)}, {0.2, 0.5}};
  const std::vector<std::array<unsigned int, 4>> quads = {{{0, 1, 2, 3}}, {{0, 3, 4, 5}}};
  for (const unsigned int first : {0, 1})
    {
      std::ostringstream nodes, elements;
      nodes.precision(17);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < 6; ++k)
          {
            const double phi = 2. * dealii::numbers::PI * i / n;
            nodes << 6 * i + k + 1 << ' ' << section[k][0] * std::cos(phi) << ' '
                  << section[k][0] * std::sin(phi) << ' ' << section[k][1] << '\n';
          }
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int next = 6 * ((i + 1) % n) + 1, own = 6 * i + 1;
          for (const unsigned int q : {first, 1 - first})
            {
              elements << 4 * i + q + 1 << " 5 2 1 1";
              for (const unsigned int at : {own, next})
                for (const unsigned int k : quads[q])
                  elements << ' ' << at + k;
              elements << '\n'
                       << 4 * i + q + 3 << " 3 2 " << q + 1 << " 1 " << own + q + 2 << ' '
                       << own + q + 3 << ' ' << next + q + 3 << ' ' << next + q + 2 << '\n';
            }
        }
      auto body             = file_body();
      body.boundary_numbers = {{"1", "side"}, {"2", "cap"}};
      body.surfaces         = {{"side", "smooth"}, {"cap", "smooth"}};
      body.imported       = mesh_file::import_mesh(gmsh_text(nodes.str(), elements.str()), body, 3);
      const auto geometry = geometry::make_geometry<3>(body);
      const auto cells    = geometry->coarse_mesh().cells;
      using Info          = dealii::GeometryInfo<3>;
      std::map<std::set<unsigned int>, Point<3>> middles;
      for (unsigned int c = 0; c < cells.size(); ++c)
        for (unsigned int e = 0; e < Info::lines_per_cell; ++e)
          {
            const unsigned int a = Info::line_to_cell_vertices(e, 0),
                               b = Info::line_to_cell_vertices(e, 1);
            const auto x         = geometry->position(
              {c, Info::unit_cell_vertex(a) +
                            (Info::unit_cell_vertex(b) - Info::unit_cell_vertex(a)) / 2.});
            const auto entry = middles.emplace(std::set<unsigned int>{cells[c][a], cells[c][b]}, x);
            EXPECT_NEAR(x.distance(entry.first->second), 0., 1e-14) << x;
          }
      EXPECT_EQ(middles.size(), n * (6u + 7u));
    }
}

TEST(MeshFiles, NamedRegionsGoBeforeOthers)
{
  auto       body = file_body();
  const auto text = contents("bar.inp");
  // every element is in the set all, which is the last
  EXPECT_EQ(mesh_file::import_mesh(text, body, 2)->flat->regions,
            (std::vector<unsigned int>{1, 1, 1}));
  body.named_regions = {"core", "coat"};
  const auto mesh    = mesh_file::import_mesh(text, body, 2)->flat;
  EXPECT_EQ(mesh->region_names, (std::vector<std::string>{"core", "all", "coat"}));
  EXPECT_EQ(mesh->regions, (std::vector<unsigned int>{0, 2, 2}));
  body.named_regions = {"core", "all"};
  EXPECT_NE(failure_reason(text, body, 2)
              .find("line 13: element 1 belongs to the "
                    "regions 'core' and 'all'"),
            std::string::npos);
}

TEST(MeshFiles, RegionsAreBodiesOrMaterials)
{
  auto text = contents("block-unnamed.msh");
  text      = replaced(text, "6 5 2 1", "6 5 2 9");
  auto body = numbered_body();
  EXPECT_EQ(mesh_file::import_mesh(text, body, 3)->solid->region_names,
            (std::vector<std::string>{"group-1", "group-9"}));
  body.regions        = {"group-9"};
  body.imported       = mesh_file::import_mesh(text, body, 3);
  const auto geometry = geometry::make_geometry<3>(body);
  EXPECT_EQ(geometry->n_coarse_cells(), 1.);
  EXPECT_EQ(geometry->boundary_names().size(), 3u);
}
