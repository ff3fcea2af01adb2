#include <snug/io/shape_export.h>

#include <gtest/gtest.h>

#include <cmath>

#include "boxes.h"
#include "scratch.h"

namespace snug {
namespace {
struct Stl
{
  double               area      = 0.;
  unsigned int         triangles = 0;
  dealii::Tensor<1, 3> area_vector;               ///< by the order of the corners
  double               largest_normal_error = 0.; ///< written against computed normal
};

Stl read_stl(const std::string &text)
{
  Stl                               stl;
  std::istringstream                words(text);
  std::vector<dealii::Tensor<1, 3>> corners;
  dealii::Tensor<1, 3>              normal;
  for (std::string word; words >> word;)
    {
      dealii::Tensor<1, 3> x;
      if (word == "normal" || word == "vertex")
        words >> x[0] >> x[1] >> x[2];
      if (word == "normal")
        normal = x;
      if (word == "vertex")
        corners.push_back(x);
      if (word != "endloop")
        continue;
      EXPECT_EQ(corners.size(), 3u);
      const auto area = 0.5 * cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
      stl.area += area.norm();
      stl.area_vector += area;
      stl.largest_normal_error =
        std::max(stl.largest_normal_error, (normal - area / area.norm()).norm());
      ++stl.triangles;
      corners.clear();
    }
  return stl;
}

mesh::Surface<3> surface_of(const mesh::BodyMesh<3> &mesh, const std::string &face)
{
  return mesh::Surface<3>(mesh, {{1u, geometry::boundary_index(mesh.geometry(1), face)}});
}

TEST(SurfaceExport, FlatFaceHasItsAreaAndPointsOut)
{
  const test::ScratchDirectory                      scratch;
  const std::map<std::string, dealii::Tensor<1, 3>> outward = {
    {"top", dealii::Tensor<1, 3>({0., 0., 1.})},
    {"bottom", dealii::Tensor<1, 3>({0., 0., -1.})},
    {"left", dealii::Tensor<1, 3>({-1., 0., 0.})},
    {"back", dealii::Tensor<1, 3>({0., 1., 0.})}};
  for (const unsigned int degree : {1, 2})
    {
      const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, test::two_boxes<3>(true), degree);
      for (const auto &face : outward)
        {
          const auto surface   = surface_of(mesh, face.first);
          const auto positions = surface.gather(mesh.reference_positions());
          if (!scratch.is_first())
            continue;
          io::write_surface(scratch.file("shape.stl"), surface, positions);
          const auto stl = read_stl(test::read_file(scratch.file("shape.stl")));
          EXPECT_EQ(stl.triangles, 2 * degree * degree * surface.faces().size());
          EXPECT_NEAR(stl.area, 1., 1e-12) << face.first;
          EXPECT_NEAR((stl.area_vector - face.second).norm(), 0., 1e-12) << face.first;
          EXPECT_LT(stl.largest_normal_error, 1e-12);
        }
    }
}

TEST(SurfaceExport, IsNamedAfterItsFile)
{
  const test::ScratchDirectory scratch;
  const mesh::BodyMesh<3>      mesh(MPI_COMM_WORLD, test::two_boxes<3>(false), 1);
  const auto                   surface   = surface_of(mesh, "top");
  const auto                   positions = surface.gather(mesh.reference_positions());
  if (!scratch.is_first())
    return;
  io::write_surface(scratch.file("shape.stl"), surface, positions);
  const auto text = test::read_file(scratch.file("shape.stl"));
  EXPECT_EQ(text.rfind("solid shape\n", 0), 0u);
  EXPECT_NE(text.find("\nendsolid shape\n"), std::string::npos);
}

TEST(ControlPoints, ReadBackBitForBit)
{
  const test::ScratchDirectory scratch;
  if (!scratch.is_first())
    return;
  std::vector<shape::MovedPoint<3>> points(2);
  points[0]           = {"a", 0, {0.1, 0.2, 1. / 3.}, {}};
  points[1]           = {"a", 1, {-1., 0., 1e-30}, {}};
  points[0].move[2]   = 0.7;
  points[1].move[0]   = -0.1;
  points[0].variables = {{12, 1.}, {3, -1.}};
  points[0].on_body   = {0.3, 0.25, 1. / 7.};
  io::write_control_points<3>(scratch.file("c.csv"), points);
  const auto table = test::read_csv(test::read_file(scratch.file("c.csv")));
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0], (std::vector<std::string>{"shape", "index", "x", "y", "z", "dx", "dy", "dz",
                                                "variables", "body_x", "body_y", "body_z"}));
  EXPECT_EQ(table[1][8], "design[12] -design[3]");
  EXPECT_EQ(table[2][8], ""); // fixed
  for (unsigned int i = 0; i < 2; ++i)
    {
      EXPECT_EQ(table[i + 1][0], "a");
      EXPECT_EQ(table[i + 1][1], std::to_string(i));
      for (unsigned int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(std::stod(table[i + 1][2 + c]), points[i].position[c], 1e-8); // nine digits
          EXPECT_NEAR(std::stod(table[i + 1][5 + c]), points[i].move[c], 1e-8);     // nine digits
          EXPECT_NEAR(std::stod(table[i + 1][9 + c]), points[i].on_body[c], 1e-8);  // nine digits
        }
    }
}
} // namespace
} // namespace snug
