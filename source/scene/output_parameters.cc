#include <snug/base/entries.h>
#include <snug/base/section_check.h>
#include <snug/scene/output_parameters.h>

#include <algorithm>

namespace snug::scene {
bool OutputParameters::has(const std::string &field) const
{
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

void OutputParameters::declare(Entries &entries)
{
  entries.add("Fields", fields,
              "What solution.pvd shows of the bodies besides displacement and body: any of these. "
              "Those that are left out take neither time nor room.");
  entries.add("Compression", compression, between(0., 9.),
              "Of *.vtu: 0: none; 1: fast; 9: smallest.");
  entries.add("Ranks per file", ranks_per_file, at_least(1),
              "Ranks whose cells share one file of a state, solution-STATE.GROUP.vtu: the first of "
              "them writes it, and needs memory for all of it.");
  entries.add("Export QP", export_qp,
              "Also write the quadratic program of the first state and its solution into qp/, for "
              "other solvers, as PETSc's binary files and in Matrix Market format: see "
              "doc/export-qp.md.");
}

void OutputParameters::check(const SectionCheck &section) const
{
  const OutputParameters all;
  for (const auto &field : fields)
    section.require(all.has(field), "Fields", to_text(fields),
                    "must name fields among " + to_text(all.fields));
}
} // namespace snug::scene
