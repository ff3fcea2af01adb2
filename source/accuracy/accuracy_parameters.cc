#include <snug/accuracy/accuracy_parameters.h>
#include <snug/accuracy/targets.h>
#include <snug/base/section_check.h>

namespace snug::accuracy {
void AccuracyParameters::declare(Entries &entries)
{
  entries.add(
    "Estimate", estimate,
    "The discretization errors that are estimated, for a state and for the final design of "
    "an optimization.");
  entries.add(
    "Target", targets,
    with_meanings(allowed("a list 'response: error, response: error, ...'"),
                  {{"peak pressure: 1 %", "relative error, at least 1e-8 %"},
                   {"tip: 0.02",
                    "absolute error in the units of the response, at least 1e-8 % of its "
                    "value"}}),
    "The maximum estimated errors of 'Responses' or quantities in all load cases. An empty list "
    "means the mesh as given. An optimization needs a target for its objective. It uses first "
    "meshes for 8, 3 and 1 times the targets, then further ones until mesh and design agree (at "
    "most 8 searches).");
  entries.add("Maximum levels", maximum_levels, between(1., 20.),
              "The maximum refinement level of a cell above the coarse cells, including "
              "'Refinements'. Of a body of a CAD file, the maximum number of meshes with smaller "
              "elements.");
  entries.add("Maximum unknowns", maximum_unknowns, positive(),
              "The maximum number of unknowns of a mesh that is solved.");
  entries.add("Marking share", marking_share, between(0.05, 0.95),
              "The part of the estimated error that the cells refined in one step contain (Dörfler "
              "marking). Fewer cells are refined if that suffices.");
  entries.add(
    "Contact faces", contact_faces, between(2., 100.),
    "The minimum number of faces across a contact. For targets of pressures and von Mises norms a "
    "contact with fewer faces is refined independently of its estimated error.");
  entries.add(
    "Verify", verify,
    with_meanings(allowed("auto, true or false"),
                  {{"auto", "true if the finer mesh has at most 10,000 unknowns, or no more than "
                            "one of the meshes before. If the analysis on it fails, the estimates "
                            "decide"},
                   {"true", "an analysis that fails on the finer mesh is an error"}}),
    "Whether to check the targets on the mesh with all cells refined once, and the elements of "
    "CAD files halved. If a target is missed, that mesh is refined further. An optimization "
    "always verifies its last mesh.");
}

void AccuracyParameters::check(const SectionCheck &section) const
{
  const auto require = [&](const bool good, const std::string &allowed) {
    section.require(good, "Target", to_text(targets), allowed);
  };
  require(targets.empty() || estimate != Estimate::none, "must be empty for 'Estimate' none");
  section.require(!targets.empty() || !verify.value_or(false), "Verify", to_text(verify),
                  "must be left out without 'Target'");
  for (const auto &[name, text] : targets)
    try
      {
        read_target(text);
      }
    catch (const std::exception &)
      {
        require(false, "the target of '" + name +
                         "' must be like '1 %', at least 1e-8 %, or "
                         "'0.02', above 0");
      }
}
} // namespace snug::accuracy
