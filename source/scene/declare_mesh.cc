#include <snug/scene/check.h>
#include <snug/scene/entries.h>

#include <deal.II/base/utilities.h>

namespace snug::scene {
namespace {
void declare_box(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  entries.add("Box corner", mesh.corner,
              "Corner with the smallest coordinates [length]; empty: "
              "the origin.");
  entries.add("Box size", mesh.size, "Length of the edges along x, y, z [length]; empty: 1.");
  entries.add("Box cells", mesh.cells, "Number of cells along x, y, z, before refinement.");
  entries.add("Box grading", mesh.grading,
              "Along x, y, z: size of the last cell over the size of the "
              "first, sizes growing geometrically; empty: 1, equal "
              "cells.");
  entries.add("Box fine length", mesh.fine_length,
              "Along x, y, z: half of the cells are equal and fill this "
              "much from the lower end, sizes of the others grow from "
              "there [length]; 0 or empty: not.");
  entries.add("Curved faces",
              {[&mesh]() { return to_text(mesh.curved_faces, ';'); },
               [&mesh](const std::string &text) { from_text(text, mesh.curved_faces, ';'); }},
              pairs("a list 'boundary: sphere R; boundary: cylinder AXIS R; "
                    "boundary: FORMULA' of different boundaries, separated by "
                    "semicolons",
                    ';'),
              "Faces that are not flat, separated by semicolons (formulas may "
              "hold commas): 'bottom: sphere 4', 'bottom: cylinder x 4' (radius "
              "[length], positive if convex; the axis is the cylinder's, z in 2D) "
              "or a "
              "formula of x, y, z for the outward displacement of the face "
              "[length], 'bottom: -(x^2)/8'. Of a mesh file: boundaries that lie "
              "on "
              "a sphere or a cylinder, 'ball: sphere; bore: cylinder z', whose "
              "centre and radius are found.");
}

void declare_round(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  entries.add("Radius", mesh.radius, "Outer radius of round bodies [length].");
  entries.add("Inner radius", mesh.inner_radius, "Inner radius of rings and shells [length].");
  entries.add("Length", mesh.length, "Length along z of cylinders and rings in 3D [length].");
  entries.add("Part", mesh.part, choice("full|half|quarter|eighth"),
              "How much of a round body there is; the others are its "
              "mirror images. Eighths are of spheres and shells.");
  entries.add("Cells", mesh.round_cells,
              "Number of cells of round bodies, before refinement. Of a "
              "ring: around all of its part, from the inner to the outer "
              "radius, in 3D along; of the others in each block of a "
              "quarter or an eighth: across, of a cylinder along too, of "
              "a shell around, across. Empty: 4 each.");
}

void declare_file(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  entries.add("Mesh file", mesh.file, anything("the path of a file"),
              "Gmsh .msh 2 or 4.1, Abaqus .inp, VTK legacy, or UCD in "
              "ASCII; relative to the parameter file. Triangles, "
              "tetrahedra and prisms are split into quadrilaterals and "
              "hexahedra; of quadratic elements the corners count.");
  entries.add("Mesh regions",
              {[&mesh]() { return listed(mesh.regions); },
               [&mesh](const std::string &text) {
                 mesh.regions = dealii::Utilities::split_string_list(text);
               }},
              pairs("names separated by commas"),
              "Groups of cells of the file that make the body; empty: "
              "all cells.");
  entries.add("Boundary names",
              {[&mesh]() { return to_text(mesh.boundary_numbers); },
               [&mesh](const std::string &text) { from_text(text, mesh.boundary_numbers); }},
              pairs("a list 'number: name, ...' of different numbers"),
              "Names for the groups of faces to which the file gives "
              "only numbers, as VTK and UCD do: '1: bottom, 7: bore'.");
}

void declare_regions(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  entries.add("Region formulas",
              {[&mesh]() { return to_text(mesh.region_formulas, ';'); },
               [&mesh](const std::string &text) { from_text(text, mesh.region_formulas, ';'); }},
              pairs("a list 'region: FORMULA; ...' of different regions, "
                    "separated by semicolons",
                    ';'),
              "Regions for 'Materials' besides those of a mesh file: a "
              "cell, before refinement, belongs to the first whose "
              "formula of x, y, z is positive at its centre: 'core: 1 - "
              "x^2 - y^2; coat: z > 0.9'.");
}

void declare_placement(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  entries.add("Warp",
              {[&mesh]() {
                 std::string text;
                 for (const auto &formula : mesh.warp)
                   text += (text.empty() ? "" : "; ") + formula;
                 return text;
               },
               [&mesh](const std::string &text) {
                 mesh.warp = dealii::Utilities::split_string_list(text, ';');
               }},
              pairs("a list 'FORMULA; FORMULA; FORMULA', one per "
                    "dimension",
                    ';'),
              "Displacement x, y, z of the mesh by formulas of x, y, z "
              "[length], before it is scaled: '0; 0; 0.1*x^2'. Empty: "
              "none.");
  entries.add("Scale", mesh.scale,
              "Factor of all positions, about the origin: 0.001 for a "
              "file in mm in a scene in m.");
  entries.add("Rotate",
              {[&mesh]() { return to_text(mesh.rotate); },
               [&mesh](const std::string &text) { from_text(text, mesh.rotate); }},
              pairs("a list 'axis: degrees, ...'"),
              "Rotations of the scaled mesh about axes through the "
              "origin, one after the other: 'x: 90, z: 30'. In 2D the "
              "axis is z.");
  entries.add("Shift", mesh.shift,
              "Shift of the rotated mesh along x, y, z [length]; empty: "
              "none.");
}

void declare_refinement(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  entries.add("Refinements", mesh.refinements,
              "How often every cell is split into 4 (2D) or 8 (3D).");
  entries.add("Refine where", mesh.refine_where, anything("a formula of x, y, z"),
              "Cells are refined where this formula of x, y, z is "
              "positive at their centre, 'Local refinements' times.");
  entries.add("Local refinements", mesh.local_refinements,
              "How often cells are split where 'Refine where' says so; "
              "adjacent cells differ by one level (hanging nodes).");
}
} // namespace

void declare_mesh(Entries &entries, geometry::BodyMeshParameters &mesh)
{
  add_choice(entries, "Mesh", mesh.source, geometry::body_geometry_table<3>(),
             "Source of the mesh.");
  declare_box(entries, mesh);
  declare_round(entries, mesh);
  declare_file(entries, mesh);
  declare_placement(entries, mesh);
  declare_regions(entries, mesh);
  declare_refinement(entries, mesh);
}
} // namespace snug::scene
