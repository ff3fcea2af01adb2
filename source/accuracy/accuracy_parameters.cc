#include <snug/accuracy/accuracy_parameters.h>
#include <snug/accuracy/adaptation.h>
#include <snug/base/section_check.h>

namespace snug::accuracy {
void AccuracyParameters::declare(Entries &entries)
{
  entries.add("Estimate", estimate,
              "What is estimated of the mesh's error, once per state and of the final design.");
  entries.add(
    "Target", targets, allowed("a list 'response: error, response: error, ...'"),
    "The mesh is refined until the estimated errors of these responses, names in 'Responses' or "
    "quantities, are smaller in all load cases: 'peak pressure: 1 %' of its value, or 'tip: 0.02' "
    "in its units; at least 1e-8 % of its value in both cases. Faces that meet in contact get one "
    "size. Designs are sought on meshes for 8, "
    "3 and 1 times the targets, of which the objective must be one, and verified. Empty: the mesh "
    "as given.");
  entries.add("Maximum levels", maximum_levels, between(1., 20.),
              "Cells are refined up to this level above the coarse cells, with 'Refinements'.");
  entries.add("Maximum unknowns", maximum_unknowns, positive(), "Finer meshes are not solved.");
  entries.add(
    "Marking share", marking_share, between(0.05, 0.95),
    "Cells with this part of the error are refined at once, or fewer where that is enough.");
  entries.add(
    "Contact faces", contact_faces, between(2., 100.),
    "A contact of fewer faces across is refined, whatever its estimated error, for targets "
    "that read pressures: measures of them and von Mises norms.");
  entries.add("Verify", verify, allowed("auto, true or false"),
              "Whether a state with targets is also solved on the mesh with all cells refined, and "
              "compared. If a target is missed there, that mesh is the next one. auto: where the "
              "finer mesh has at most 10,000 unknowns.");
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
