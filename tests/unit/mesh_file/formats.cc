#include "files.h"

using namespace snug;
using namespace snug::test;

TEST(MeshFormats, AbaqusKeywordsThatMakeOrMoveAMeshAreRefused)
{
  const auto        inp  = contents("bar.inp");
  const std::string node = "*NODE\n";
  for (const std::string line : {"*NGEN, NSET=a\n", "*ncopy\n", "*ELGEN\n", "*INCLUDE, INPUT=a\n",
                                 "*SYSTEM\n", "*Node, system=C\n", "*NODE, INPUT=a\n"})
    {
      const auto message = failure_reason(replaced(inp, node, line + node), file_body(), 2);
      EXPECT_NE(message.find(": line 3: *"), std::string::npos) << line << message;
      EXPECT_NE(message.find("is not supported; write all nodes"), std::string::npos)
        << line << message;
    }
  EXPECT_NE(failure_reason(replaced(inp, node, "*Instance, name=a, part=b\n" + node), file_body(),
                           2)
              .find("line 3: *INSTANCE has no *END"),
            std::string::npos);
  EXPECT_EQ(failure_reason(replaced(inp, node, "*NODE, NSET=a, SYSTEM=R\n"), file_body(), 2), "");
}

TEST(MeshFormats, AxisymmetricShellsOfAbaqusAreCalledByTheirOrder)
{
  // lines on the bottom; the middle node of a SAX2 is its second one, not a corner
  const auto inp  = replaced(contents("bar.inp"), "*ELSET, ELSET=core",
                             "*ELEMENT, TYPE=SAX1, ELSET=one\n4, 1, 3\n"
                              "*ELEMENT, TYPE=SAX2, ELSET=two\n5, 5, 2, 7\n*ELSET, ELSET=core");
  const auto mesh = mesh_file::import_mesh(replaced(inp, "all, S1\n", "2, S1\n"), file_body(), 2);
  EXPECT_EQ(mesh->flat->boundary_names,
            (std::vector<std::string>{"one", "two", "left", "right", "sides"}));
}

TEST(MeshFormats, SetsOfAbaqusAreGroupsInOneSpelling)
{
  const auto inp  = contents("bar.inp");
  auto       text = replaced(inp, "*ELSET, ELSET=all\n", "*ELSET, elset=CORE\n");
  EXPECT_EQ(mesh_file::import_mesh(replaced(text, "all, S1\nall, S3", "Core, S1\nCORE, S3"),
                                   file_body(), 2)
              ->flat->region_names,
            (std::vector<std::string>{"core", "coat"}));
  // Abaqus/CAE's own sets are elements of surfaces but no regions
  text            = replaced(inp, "ELSET=all", "ELSET=_sides_S1, internal");
  text            = replaced(text, "all, S1\nall, S3", "_sides_S1, S1\n_SIDES_S1, S3");
  const auto mesh = mesh_file::import_mesh(text, file_body(), 2)->flat;
  EXPECT_EQ(mesh->region_names, (std::vector<std::string>{"core", "coat"}));
  EXPECT_EQ(mesh->regions, (std::vector<unsigned int>{0, 1, 1}));
  EXPECT_EQ(mesh->boundaries.size(), 8u);
}

TEST(MeshFormats, GhostPartitionsOfGmshHaveNegativeTags)
{
  auto text = contents("block-2.msh");
  // number, type, tags: group, entity, number of partitions, own and ghost partition
  text = replaced(text, "5 5 2 1 1 1 9", "5 5 5 1 1 2 1 -2 1 9");
  expect_block<3>(text, file_body(), 2);
}

TEST(MeshFormats, OnlyTheBodyMustLieInAPlane)
{
  auto text = replaced(contents("bar.inp"), "*ELEMENT, TYPE=CPE4\n",
                       "9, 0, 0, 5\n10, 1, 0, 5\n11, 0, 1, 6\n12, 0, 0, 7\n"
                       "*ELEMENT, TYPE=S3, ELSET=tool\n9, 9, 10, 11\n"
                       "*ELEMENT, TYPE=C3D4, ELSET=solid\n10, 9, 10, 11, 12\n"
                       "*ELEMENT, TYPE=CPE4\n");
  EXPECT_NE(failure_reason(text, file_body(), 2).find("is a solid"), std::string::npos);
  auto body    = file_body();
  body.regions = {"all"};
  EXPECT_EQ(failure_reason(text, body, 2), "");
  body.regions = {"all", "tool"};
  EXPECT_NE(failure_reason(text, body, 2).find("is not in the plane"), std::string::npos);
  // a lone point, as Gmsh writes those of physical points
  text =
    gmsh_text("1 0 0 7\n2 0 0 0\n3 1 0 0\n4 1 1 0\n5 0 1 0\n", "1 15 2 0 1 1\n2 3 2 0 1 2 3 4 5\n");
  EXPECT_EQ(failure_reason(text, file_body(), 2), "");
}
