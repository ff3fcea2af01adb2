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
  entries.add("Verbosity", verbosity, "The amount of text in the log.");
  entries.add(
    "Fields", fields,
    "The fields of the bodies in solution.pvd, in addition to displacement and body. Fields "
    "that are not listed are neither computed nor written.");
  entries.add(
    "Compression", compression, between(0., 9.),
    "The compression level of .vtu files. A value of 0 means no compression, 1 the fastest, "
    "9 the smallest files.");
  entries.add("Ranks per file", count_or_auto(ranks_per_file),
              with_meanings(allowed("auto or a whole number of at least 1"),
                            {{"auto",
                              "16 up to 256 ranks, then as many as make at most 16 files"}}),
              "The number of consecutive ranks whose cells share a file of each body and boundary. "
              "The first of these ranks writes these files.");
  entries.add(
    "Meshes", meshes,
    with_meanings(
      {}, {{"msh", "bodies.msh: mesh of Gmsh 2.2, with boundaries and regions as physical groups"},
           {"inp", "bodies.inp: deck of CalculiX and Abaqus with the mesh, sets, materials, "
                   "contact pairs, supports and loads of the first load case"}}),
    "The formats in which the bodies of the last design are written, with the positions of the "
    "nodes without a load. An empty list means that no mesh is written.");
  entries.add("Profile deviation", profile_deviation, at_least(0.),
              "The maximum distance of the B-splines in profile.step and BODY.step from the shaped "
              "faces, relative to the "
              "size of each face, the diagonal of its box. A value of 0 means that the files are "
              "not written.");
  entries.add(
    "Export QP", export_qp,
    "Whether to write the quadratic program of the first state and its solution into qp/, "
    "for other solvers, as binary files of PETSc and in Matrix Market format. See "
    "doc/export-qp.md.");
}

void OutputParameters::check(const SectionCheck &section) const
{
  const OutputParameters all;
  for (const auto &field : fields)
    section.require(all.has(field), "Fields", to_text(fields),
                    "must name fields among " + to_text(all.fields));
  for (const auto &format : meshes)
    section.require(format == "msh" || format == "inp", "Meshes", to_text(meshes),
                    "must name formats among msh, inp");
}
} // namespace snug::scene
