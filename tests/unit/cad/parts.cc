#include <snug/base/errors.h>
#include <snug/base/values.h>
#include <snug/cad/import_cad.h>
#include <snug/cad/part.h>
#include <snug/mesh/body_mesh.h>
#include <snug/mesh_file/mesh_file.h>

#include <deal.II/base/mpi.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <TopoDS_Compound.hxx>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

using namespace snug;

namespace {
geometry::BodyMeshParameters part(const std::string &file, const double size)
{
  geometry::BodyMeshParameters parameters;
  parameters.source       = geometry::Source::cad;
  parameters.file         = SNUG_MESHES + file;
  parameters.element_size = size;
  return parameters;
}

/// Return the mesh of a part. Each number of ranks has a directory of its own, because tests run at
/// the same time.
std::shared_ptr<const geometry::ImportedMesh> imported(const geometry::BodyMeshParameters &of,
                                                       const unsigned int                  dim)
{
  const auto  *info = testing::UnitTest::GetInstance()->current_test_info();
  std::ostream nowhere(nullptr);
  RunContext   context(MPI_COMM_WORLD, nowhere);
  return cad::import_cad(of, dim,
                         "cad-test-" + std::to_string(context.n_ranks()) + "/" + info->name(),
                         context);
}

std::string failure_reason(const geometry::BodyMeshParameters &of, const unsigned int dim)
{
  try
    {
      imported(of, dim);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}

/// Return the maximum of @p error over nodes and samples of the true surface of a boundary.
template <int dim>
double largest_on(const geometry::BodyMeshParameters                          &of,
                  const std::string                                           &boundary,
                  const std::function<double(const dealii::Tensor<1, dim> &)> &error)
{
  const mesh::BodyMesh<dim> mesh(MPI_COMM_WORLD, {of}, 2);
  const auto                index   = geometry::boundary_index(mesh.geometry(0), boundary);
  double                    largest = 0., n_nodes = 0.;
  for (const auto &face : mesh.boundary_faces())
    if (face.boundary == index)
      {
        for (const unsigned int node : face.nodes)
          // Quadratic elements interpolate the positions of other nodes than their own ten.
          if (!mesh.is_hanging(node))
            {
              ++n_nodes;
              largest = std::max(largest, std::abs(error(mesh.reference_positions()[node])));
            }
      }
  EXPECT_GT(dealii::Utilities::MPI::sum(n_nodes, MPI_COMM_WORLD), 0.);
  return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
}

/// Return whether all faces of boundaries called @p round have a known surface.
bool has_known(const geometry::BlockMesh<3> &mesh, const std::set<std::string> &round)
{
  for (const auto &[face, boundary] : mesh.boundaries)
    if ((mesh.known.count(face) > 0) != (round.count(mesh.boundary_names[boundary]) > 0))
      return false;
  return true;
}
} // namespace

/// The parameters of the CAD surfaces are exact, so nodes lie on them to rounding, also where a
/// fillet continues a cylinder and a plane.
TEST(Cad, nodes_lie_on_cylinder_fillet_and_planes)
{
  auto pin       = part("pins.step", 0.5);
  pin.solid      = 1;
  pin.cad_faces  = {{"shank", "1"}, {"round", "2"}};
  pin.face_sizes = {{"round", 0.1}};
  pin.imported   = imported(pin, 3);
  EXPECT_TRUE(has_known(*pin.imported->solid, {"shank", "round"}));
  EXPECT_LT(largest_on<3>(pin, "shank", [](const auto &x) { return std::hypot(x[0], x[1]) - 0.5; }),
            1e-14);
  EXPECT_LT(largest_on<3>(pin, "round",
                          [](const auto &x) {
                            return std::hypot(std::hypot(x[0], x[1]) - 0.3, x[2] - 1.8) - 0.2;
                          }),
            1e-14);
  EXPECT_LT(largest_on<3>(pin, "face-4", [](const auto &x) { return x[2] - 2.; }), 1e-14);
}

/// A parabola as Bezier curve is exactly y = x^2. A chord of the mesh would be 0.02 off.
TEST(Cad, nodes_lie_on_free_curves_and_extruded_surfaces)
{
  const auto off  = [](const auto &x) { return x[1] - x[0] * x[0]; };
  auto       flat = part("parabola.step", 0.4);
  flat.imported   = imported(flat, 2);
  EXPECT_LT(largest_on<2>(flat, "edge-1", off), 1e-12);
  EXPECT_LT(largest_on<2>(flat, "edge-3",
                          [](const auto &x) { return std::hypot(x[0], x[1] - 0.6) - 0.15; }),
            1e-14);
  auto bar     = part("parabola-bar.step", 0.6);
  bar.imported = imported(bar, 3);
  EXPECT_LT(largest_on<3>(bar, "face-1", off), 1e-12);
}

/// Chains contain the faces that continue each other without an edge.
TEST(Cad, boundaries_consist_of_named_numbered_and_continued_faces)
{
  auto pin        = part("pins.step", 1.);
  pin.solid       = 1;
  pin.face_sizes  = {{"skin", 0.9}};
  pin.cad_faces   = {{"skin", "chain 4"}};
  const auto mesh = imported(pin, 3);
  EXPECT_EQ(std::set<std::string>(mesh->solid->boundary_names.begin(),
                                  mesh->solid->boundary_names.end()),
            (std::set<std::string>{"skin", "foot"}));
  ASSERT_EQ(mesh->faces.size(), 4u);
  EXPECT_NE(mesh->faces[0].find("cylinder of radius 0.5"), std::string::npos) << mesh->faces[0];
  EXPECT_NE(mesh->faces[0].find("beside 2 (smooth) 3"), std::string::npos) << mesh->faces[0];
  // 2 pi r h
  EXPECT_NE(mesh->faces[0].find("area 5.6549"), std::string::npos) << mesh->faces[0];
}

/// Two runs of Gmsh make the same mesh, and all formats give the same part.
TEST(Cad, meshes_are_reproducible)
{
  auto step       = part("pins.step", 1.);
  step.solid      = 2;
  auto brep       = step;
  brep.file       = SNUG_MESHES "pins.brep";
  const auto mesh = imported(step, 3);
  EXPECT_EQ(mesh->text_hash, imported(step, 3)->text_hash);
  EXPECT_EQ(mesh->faces, imported(brep, 3)->faces);
  EXPECT_EQ(dealii::Utilities::MPI::sum(mesh->text_hash % 1000, MPI_COMM_WORLD),
            mesh->text_hash % 1000 * dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
}

/// The mesh of Gmsh that is kept for the user has the names of the boundaries.
TEST(Cad, kept_meshes_have_named_groups)
{
  auto pin      = part("pins.step", 1.);
  pin.solid     = 1;
  pin.cad_faces = {{"skin", "chain 4"}};
  imported(pin, 3);
  std::ifstream      in("cad-test-" +
                        std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
                        "/kept_meshes_have_named_groups.msh");
  std::ostringstream text;
  text << in.rdbuf();
  std::set<std::string> groups;
  for (const auto &element : mesh_file::read_mesh_file(text.str()).elements)
    groups.insert(element.groups.begin(), element.groups.end());
  EXPECT_EQ(groups, (std::set<std::string>{"skin", "foot", "body"}));
}

/// A file of IGES has the faces of the shape, without a solid.
TEST(Cad, faces_of_iges_are_sewn_to_a_solid)
{
  auto brep  = part("pins.brep", 1.);
  brep.solid = 2;
  auto iges  = part("", 1.);
  iges.file =
    "cad-test-" + std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) + ".igs";
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      IGESControl_Writer writer;
      writer.AddShape(cad::read_part(brep.file, brep.solid, 3).shape);
      ASSERT_TRUE(writer.Write(iges.file.c_str()));
    }
  MPI_Barrier(MPI_COMM_WORLD);
  auto sorted = [](std::vector<std::string> faces) {
    for (auto &face : faces)
      face = face.substr(face.find("area"), face.find("beside") - face.find("area"));
    std::sort(faces.begin(), faces.end());
    return faces;
  };
  EXPECT_EQ(sorted(imported(iges, 3)->faces), sorted(imported(brep, 3)->faces));
}

/// Elements on a face have its size, and grow away from it.
TEST(Cad, elements_are_small_near_a_face_and_grow)
{
  auto block        = part("pins.step", 0.4);
  block.solid       = 2;
  block.face_sizes  = {{"face-1", 0.1}};
  block.size_growth = 0.5;
  block.imported    = imported(block, 3);
  const auto &mesh  = *block.imported->solid;
  // The mean area of the faces of a split triangle with edges of h is h^2 sqrt(3)/12.
  std::map<std::string, double> n_faces;
  for (const auto &[face, boundary] : mesh.boundaries)
    n_faces[mesh.boundary_names[boundary]] += 1.;
  // Other ranks than 0 have no faces.
  for (const auto &name : mesh.boundary_names)
    n_faces[name] = dealii::Utilities::MPI::sum(n_faces[name], MPI_COMM_WORLD);
  const double small = 0.5 / n_faces.at("face-1"), large = 0.5 / n_faces.at("face-2");
  EXPECT_NEAR(std::sqrt(small * 12. / std::sqrt(3.)), 0.1, 0.02);
  EXPECT_NEAR(std::sqrt(large * 12. / std::sqrt(3.)), 0.35, 0.1);
}

/// Elements have half of the size at a place, and half of the size everywhere if no place is given.
TEST(Cad, halved_elements_have_half_of_the_size)
{
  auto block         = part("pins.step", 0.4);
  block.solid        = 2;
  const auto n_cells = [&]() {
    return dealii::Utilities::MPI::sum(1. * imported(block, 3)->solid->blocks.size(),
                                       MPI_COMM_WORLD);
  };
  // The edges of the box of the solid: x 2 to 3, y 0 to 1, z 0 to 0.5.
  const dealii::Point<3> corner(2., 0., 0.);
  const auto             n_near = [&]() {
    const auto mesh = imported(block, 3);
    double     n    = 0.;
    for (const auto &cell : mesh->solid->blocks)
      n += mesh->solid->vertices[cell.front()].distance(corner) < 0.2;
    return dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD);
  };
  const double all = n_cells(), near = n_near();
  block.halved = {{corner}, {corner}};
  EXPECT_GT(n_near(), 10. * near);
  EXPECT_LT(n_cells(), 20. * all); // elsewhere elements grow by 0.3 of the distance
  block.halved       = {{}};
  const double finer = n_cells();
  block.halved       = {{}, {}};
  EXPECT_NEAR(n_cells() / finer, 8., 2.5); // Gmsh attains sizes to about 10 %
}

/// Each message names the entry and what is allowed.
TEST(Cad, wrong_parts_are_refused_on_all_ranks)
{
  const auto expect = [](const geometry::BodyMeshParameters &of, const unsigned int dim,
                         const std::string &entry, const std::string &why) {
    const std::string message = failure_reason(of, dim);
    EXPECT_EQ(message.rfind("entry '" + entry + "'", 0), 0u) << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  auto pin = part("pins.step", 0.5);
  expect(pin, 3, "Solid", "contains 2: 1: x -0.5 to 0.5");
  expect(pin, 2, "File", "contains a solid");
  pin.solid = 3;
  expect(pin, 3, "Solid", "must be at most 2");
  pin.solid        = 1;
  pin.element_size = 0.;
  expect(pin, 3, "Element size", "must be positive");
  pin.element_size = 1e-4;
  expect(pin, 3, "Element size", "more than a million elements; increase the size");
  pin.face_sizes = {{"foot", 1e-5}};
  expect(pin, 3, "Element size", "more than a million elements with 'Face sizes'; increase the");
  pin.face_sizes = {};
  pin.halved     = {{}};
  expect(pin, 3, "Element size", "more than a million elements in mesh 2 for 'Target'");
  pin.halved       = {};
  pin.element_size = 0.5;
  pin.cad_faces    = {{"a", "5"}};
  expect(pin, 3, "CAD faces", "the numbers 1 to 4");
  pin.cad_faces = {{"a", "1"}, {"b", "chain 2"}};
  expect(pin, 3, "CAD faces", "face 1 belongs to the boundary 'a' as well");
  pin.cad_faces  = {};
  pin.face_sizes = {{"heel", 0.1}};
  expect(pin, 3, "Face sizes", "the boundaries are face-1");
  pin.face_sizes = {{"foot", 0.6}};
  expect(pin, 3, "Face sizes", "at most 'Element size'");
  expect(part("parabola.step", 0.5), 3, "File", "no solid");
  expect(part("nowhere.step", 0.5), 3, "File", "no such file");
  expect(part("block.inp", 0.5), 3, "File", "'Mesh = file'");
}

/// Faces that do not meet are refused with the tolerance with which they enclose a solid.
TEST(Cad, faces_with_gaps_name_the_tolerance_that_closes_them)
{
  const auto      block = cad::read_part(SNUG_MESHES "pins.brep", 2, 3);
  BRep_Builder    builder;
  TopoDS_Compound faces;
  builder.MakeCompound(faces);
  gp_Trsf lift;
  lift.SetTranslation({0., 0., 1e-3});
  for (const auto &face : block.faces())
    builder.Add(faces, face.IsSame(block.faces()[5]) ? face.Moved(TopLoc_Location(lift)) : face);
  auto of = part("", 1.);
  of.file =
    "cad-gap-" + std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) + ".brep";
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      ASSERT_TRUE(BRepTools::Write(faces, of.file.c_str()));
    }
  MPI_Barrier(MPI_COMM_WORLD);
  // The diagonal of the block is 1.5.
  EXPECT_NE(failure_reason(of, 3).find("if they are sewn with the tolerance of 0.0015"),
            std::string::npos)
    << failure_reason(of, 3);
}

/// Files that only have the ending of a CAD file are refused.
TEST(Cad, damaged_files_are_refused)
{
  const std::string folder =
    "cad-damaged-" + std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  std::filesystem::create_directories(folder);
  for (const std::string ending : {"step", "brep", "iges"})
    {
      auto of = part("", 1.);
      of.file = folder + "/damaged." + ending;
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::ofstream(of.file) << "no part\n";
      const std::string message = failure_reason(of, 3);
      EXPECT_EQ(message.rfind("entry 'File'", 0), 0u) << message;
    }
}
