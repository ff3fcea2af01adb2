#include <snug/base/errors.h>
#include <snug/geometry/regions.h>
#include <snug/mesh/body_mesh.h>

#include <gtest/gtest.h>

using namespace snug;

namespace {
geometry::BodyMeshParameters layered_box()
{
  geometry::BodyMeshParameters parameters;
  parameters.size            = {2., 1., 1.};
  parameters.cells           = {4, 2, 2};
  parameters.shift           = {10., 0., 0.};
  parameters.rotate          = {{"x", "90"}};
  parameters.region_formulas = {{"core", "x - 11"}, {"skin", "z - 0.6"}};
  return parameters;
}
} // namespace

TEST(Regions, FormulasAreTakenInPlaceAndInOrder)
{
  const auto geometry = geometry::make_geometry<3>(layered_box());
  EXPECT_EQ(geometry->region_names(), (std::vector<std::string>{"body", "core", "skin"}));
  EXPECT_EQ(geometry::cells_of_regions(*geometry), (std::vector<unsigned long>{4, 8, 4}));
}

TEST(Regions, RefinedCellsStayInTheirRegions)
{
  auto parameters              = layered_box();
  parameters.refine_where      = "11.2 - x";
  parameters.local_refinements = 1;
  const mesh::BodyMesh<3> mesh(MPI_COMM_WORLD, {parameters}, 1);
  for (const auto &cell : mesh.cells())
    {
      dealii::Tensor<1, 3> centre;
      for (const unsigned int node : cell.nodes)
        centre += mesh.reference_positions()[node] / 8.;
      EXPECT_EQ(cell.region, centre[0] > 11. ? 1u : centre[2] > 0.5 ? 2u : 0u);
    }
}

TEST(Regions, WrongFormulasAreNamed)
{
  const auto failure_reason = [](const auto &formulas) {
    auto parameters            = layered_box();
    parameters.region_formulas = formulas;
    try
      {
        geometry::make_geometry<3>(parameters);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  using Formulas = std::vector<std::pair<std::string, std::string>>;
  EXPECT_NE(failure_reason(Formulas{{"core", "x +"}}).find("'Region formulas'"), std::string::npos);
  EXPECT_NE(failure_reason(Formulas{{"a", "x"}, {"a", "y"}}).find("twice"), std::string::npos);
}
