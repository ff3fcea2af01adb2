#include "error_checks.h"

TEST(BorderErrors, DecimalCommas)
{
  const std::string hint = "; write 0.15 instead of 0,15";
  for (const std::string entry :
       {"Body punch/Poisson's ratio", "Contact/Search distance", "Contact/Gap", "Body punch/Force",
        "Body punch/Pressure", "Body punch/Traction", "Body punch/Displacement",
        "Body punch/Temperature", "Body punch/Springs", "Body punch/Refine where",
        "Optimization/Constraints", "Accuracy/Target"})
    for (const std::string value : {"0,15", "top: 0,15", "top: 0 0 0,15", "top: z = 0,15",
                                    "0, 0, 0,15", "volume: <= 0,15", "volume: 0,15 %"})
      {
        const auto message = error_of({entry + "=" + value});
        EXPECT_TRUE(has(message, "entry '" + entry + "' = '" + value + "': ")) << message;
        EXPECT_TRUE(has(message, hint)) << message;
      }
  expect_error({"Body punch/Shift", "0, 0,15", hint});
  expect_error({"Body punch/Body force", "0, 0,15*x", hint});
  expect_error({"Body punch/Shift", "-0,15", "; write 0.15 instead of 0,15"});
  EXPECT_TRUE(has(error_of({"Body punch/Warp=0; 0; 0,15*x"}), hint + ")"));
  expect_error({"Contact/Gap", "(0,15)", "a comma may only separate the arguments of a function"});
  expect_error({"Contact/Gap", "min(x, (0,15))", "a comma may only"});
  expect_error({"Contact/Gap", "2,x", "a comma may only"});
  for (const std::string formula :
       {"min(0,5)", "max (x, min(y,2))", "pow(x,2)", "if(x>0, 1, -y)", "atan2(y,x)"})
    EXPECT_EQ(error_of({"Contact/Gap=" + formula}), "") << formula;
}

TEST(BorderErrors, RenamedEntries)
{
  EXPECT_TRUE(has(error_of({"Body punch/Mesh file=a.msh"}),
                  "unknown entry 'Body punch/Mesh file' = 'a.msh'; it was renamed to 'File'"));
  // The section has no entry of the new name.
  EXPECT_FALSE(has(error_of({"Contact/Mesh file=a.msh"}), "renamed"));
}

TEST(BorderErrors, FrictionNeedsItsLimit)
{
  const std::string pair = "Pair punch.bottom: foundation.top/";
  for (const std::string law : {"Coulomb", "Tresca"})
    {
      const std::string limit = law == "Coulomb" ? "Friction coefficient" : "Friction bound";
      expect_error({"Contact/Friction", law, "needs a '" + limit + "' for 'punch.bottom: foundat"});
      expect_error({pair + "Friction", law, "needs a '" + limit + "'"});
      EXPECT_EQ(error_of({"Contact/Friction=" + law, "Contact/" + limit + "=0.3"}), "");
      // The pair has the limit that the default lacks, and no friction.
      EXPECT_EQ(error_of({"Contact/Friction=" + law, pair + limit + "=0"}), "");
      EXPECT_EQ(error_of({"Contact/Friction=" + law, pair + "Friction=none"}), "");
    }
  // Earlier versions printed 0 for a limit that is not given.
  EXPECT_EQ(error_of({"Contact/Friction coefficient=0", "Contact/Friction bound=0"}), "");
  expect_error({"Contact/Friction coefficient", "0.1", "left out unless Friction = Coulomb"});
}

TEST(BorderErrors, ShapesWithoutFreedom)
{
  const std::string remove = "Shape/Only remove";
  for (const std::string limit : {"initial", "= initial", ">= initial", ">= 1.2 initial"})
    expect_error({remove, "true", "'volume: " + limit + "', which only the first design"},
                 {"Optimization/Constraints=volume: " + limit});
  for (const std::string limit : {"<= initial", ">= 0.9 initial", "= 0.9 initial", ">= 2"})
    EXPECT_EQ(error_of({remove + "=true", "Optimization/Constraints=volume: " + limit}), "");
  EXPECT_EQ(error_of({remove + "=true", "Shape/Initial=-0.1"}), "");
  // the volume of a body without a shape
  EXPECT_EQ(error_of({remove + "=true", "Responses=v", "Response v/Quantity=volume",
                      "Response v/Body=punch", "Optimization/Constraints=v: initial"}),
            "");
}
