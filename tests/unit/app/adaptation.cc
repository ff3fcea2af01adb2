#include <snug/app/adaptation.h>
#include <snug/scene/read_scene.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace snug;

namespace {
/// A round punch on a block with a variable surface, one cell each, and a target that the first
/// mesh meets. This mesh needs one application of F, and the finer mesh needs three.
const std::string coarse_punch = R"(
set Dimension = 2
set Bodies = punch, block
subsection Body punch
  set Box corner = 0, 1
  set Box cells = 1, 1
  set Curved faces = bottom: cylinder z 4
  set Young's modulus = 1000
  set Supports = left: x
  set Pressure = top: 5
end
subsection Body block
  set Box cells = 1, 1
  set Young's modulus = 1000
  set Supports = left: x, bottom: y
end
subsection Contact
  set Pairs = punch.bottom: block.top
end
subsection Shape
  set Basis = Bezier patch
  set Face = block.top
  set Control points = 2
  set Direction = 0, 1
  set Bounds = -0.1, 0.1
end
subsection Optimization
  set Objective = potential energy
end
subsection Accuracy
  set Target = potential energy: 300 %
end
)";

/// The first mesh of the punch and the finer mesh of its verification.
struct Verified
{
  explicit Verified(const std::vector<std::string> &sets)
    : scene(scene::read_scene({"scene.prm", coarse_punch, sets, "",
                               [](const std::string &file) { return scene::read_text(file); }}))
    , context(MPI_COMM_WORLD, log)
    , adaptation(context, scene)
  {
    adaptation.start();
    EXPECT_EQ(adaptation.reach(1.), "");
    why = adaptation.verify();
  }

  std::ostringstream log;
  const scene::Scene scene;
  RunContext         context;
  app::Adaptation<2> adaptation;
  std::string        why; ///< what verify() returned
};
} // namespace

TEST(Verification, FailsWithTheFinerMeshOnlyIfVerifyIsTrue)
{
  for (const std::string verify : {"auto", "true", "false"})
    {
      const Verified    limited({"Solver/Maximum F-mults=2", "Accuracy/Verify=" + verify});
      const std::string failed = "the analysis on the mesh for verification failed: ";
      EXPECT_TRUE(limited.adaptation.summary.verified.empty());
      EXPECT_EQ(limited.why.empty(), verify != "true") << limited.why;
      EXPECT_EQ(limited.log.str().find(failed) != std::string::npos, verify != "true");
    }
}

TEST(Verification, AdvisesVerifyOnlyWhereItIsRead)
{
  const auto why = [](const std::string &task) {
    return Verified({"Task=" + task, "Accuracy/Maximum unknowns=20"}).why;
  };
  const auto of_state = why("state"), of_search = why("optimize");
  EXPECT_NE(of_state.find("increase 'Maximum unknowns', or set 'Verify' to false"),
            std::string::npos)
    << of_state;
  EXPECT_NE(of_search.find("increase 'Maximum unknowns', or relax 'Target'"), std::string::npos)
    << of_search;
}
