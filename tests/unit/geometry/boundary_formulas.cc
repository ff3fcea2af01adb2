#include <snug/base/errors.h>
#include <snug/mesh/body_mesh.h>

#include <gtest/gtest.h>

using namespace snug;

namespace {
using Formulas = std::vector<std::pair<std::string, std::string>>;

/// The centres of the faces of each boundary.
template <int dim>
std::map<std::string, std::vector<dealii::Point<dim>>>
faces_of(const geometry::BodyMeshParameters &parameters)
{
  const mesh::BodyMesh<dim>                              mesh(MPI_COMM_SELF, {parameters}, 1);
  std::map<std::string, std::vector<dealii::Point<dim>>> result;
  for (const auto &face : mesh.boundary_faces())
    {
      dealii::Point<dim> centre;
      for (const unsigned int node : face.nodes)
        centre += mesh.reference_positions()[node] / double(face.nodes.size());
      result[mesh.geometry(0).boundary_names()[face.boundary]].push_back(centre);
    }
  return result;
}

geometry::BodyMeshParameters box(const Formulas &formulas)
{
  geometry::BodyMeshParameters parameters;
  parameters.size              = {2., 1., 1.};
  parameters.cells             = {8, 4, 2};
  parameters.shift             = {10., 0., 0.};
  parameters.boundary_formulas = formulas;
  return parameters;
}
} // namespace

TEST(BoundaryFormulas, PartsOfFacesInPlace)
{
  auto parameters              = box({{"pad", "top & max(abs(x - 11), abs(y - 0.5)) < 0.25"},
                                      {"start", "top & x < 11"},
                                      {"side", "front & z > 0.5"}});
  parameters.refine_where      = "11 - x";
  parameters.local_refinements = 1;
  const auto faces             = faces_of<3>(parameters);
  // 2 x 2 faces about the middle of the top, of which half are refined
  ASSERT_EQ(faces.at("pad").size(), 2u + 2u * 4u);
  for (const auto &centre : faces.at("pad"))
    EXPECT_LT(std::max(std::abs(centre[0] - 11.), std::abs(centre[1] - 0.5)), 0.25);
  EXPECT_EQ(faces.at("start").size(), 4u * (16u - 2u));
  EXPECT_EQ(faces.at("top").size(), 16u - 2u);
  for (const auto &centre : faces.at("side"))
    EXPECT_GT(centre[2], 0.5);
  EXPECT_EQ(faces.at("back").size(), 4u * 8u + 8u);
}

TEST(BoundaryFormulas, PartsOfCurvedFacesKeepTheirSurface)
{
  geometry::BodyMeshParameters parameters;
  parameters.source            = geometry::Source::disc;
  parameters.radius            = 2.;
  parameters.round_cells       = {4};
  parameters.boundary_formulas = {{"cap", "outer & y > abs(x)"}};
  const auto geometry          = geometry::make_geometry<2>(parameters);
  EXPECT_EQ(geometry->boundary_names(), (std::vector<std::string>{"outer", "cap"}));
  EXPECT_EQ(geometry->boundary_shape(0).name, geometry->boundary_shape(1).name);
  const auto faces = faces_of<2>(parameters);
  EXPECT_EQ(4 * faces.at("cap").size(), faces.at("cap").size() + faces.at("outer").size());
}

TEST(BoundaryFormulas, WhatCutsFacesIsNamed)
{
  const auto failure = [](const Formulas &formulas) -> std::string {
    try
      {
        geometry::make_geometry<3>(box(formulas));
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  };
  EXPECT_EQ(failure({{"a", "top & x < 11"}, {"b", "bottom & x > 11.25"}}), "");
  const auto cut = failure({{"a", "top & x < 11.1"}});
  EXPECT_NE(cut.find("cuts 4 faces, the first at (11.1 "), std::string::npos) << cut;
  EXPECT_NE(cut.find("cells of the size 0.05 have nodes there"), std::string::npos) << cut;
  EXPECT_NE(failure({{"a", "top & x < 10"}}).find("positive on a face"), std::string::npos);
  EXPECT_NE(failure({{"a", "lid & x < 11"}}).find("left, right"), std::string::npos);
  EXPECT_NE(failure({{"a", "x < 11"}}).find("boundary & FORMULA"), std::string::npos);
  EXPECT_NE(failure({{"left", "top & x < 11"}}).find("no boundary has"), std::string::npos);
}
