#include <snug/base/section_check.h>
#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
namespace {
void declare_box(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Box corner", mesh.corner, per_dimension(),
              "Corner with the smallest coordinates [length]; empty: the origin.");
  entries.add("Box size", mesh.size, per_dimension(positive()),
              "Length of the edges along x, y, z [length]; empty: 1.");
  entries.add("Box cells", mesh.cells, per_dimension(),
              "Number of cells along x, y, z, before refinement.");
  entries.add("Box grading", mesh.grading, per_dimension(positive()),
              "Along x, y, z: size of the last cell over the size of the first, sizes growing "
              "geometrically; empty: 1, equal cells.");
  entries.add("Box fine length", mesh.fine_length, per_dimension(),
              "Along x, y, z: half of the cells are equal and fill this much from the lower end, "
              "sizes of the others grow from there [length]; 0 or empty: not.");
  entries.add(
    "Curved faces", access(mesh.curved_faces, ';'),
    allowed("a list 'boundary: sphere R; boundary: cylinder AXIS R; boundary: FORMULA' of "
            "different boundaries, separated by semicolons; 'at' and the coordinates of the apex "
            "may follow R"),
    "Faces of a box that are not flat, separated by semicolons (formulas may hold commas): "
    "'bottom: sphere "
    "4', 'bottom: cylinder x 4' (radius [length], positive if convex; the axis is the cylinder's, "
    "z in 2D) or a formula of x, y, z for the outward displacement of the face [length], 'bottom: "
    "-(x^2)/8'. The apex of a sphere or a cylinder, where it touches the flat face, is the centre "
    "of the face; 'bottom: sphere 4 at 0, 0' or 'bottom: cylinder y 4 at 0' give its coordinates "
    "across the normal and the axis [length], as for half of a body, whose apex lies on the plane "
    "of symmetry.");
}

void declare_round(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Radius", mesh.radius, "Outer radius of round bodies [length].");
  entries.add("Inner radius", mesh.inner_radius, "Inner radius of rings and shells [length].");
  entries.add("Length", mesh.length, "Length along z of cylinders and rings in 3D [length].");
  entries.add("Part", mesh.part,
              "How much of a round body there is; the others are its mirror images. Eighths are of "
              "spheres and shells.");
  entries.add(
    "Cells", mesh.round_cells,
    "Number of cells of round bodies, before refinement. Of a ring: around all of its part, from "
    "the inner to the outer radius, in 3D along; of the others in each block of a quarter or an "
    "eighth: across, of a cylinder along too, of a shell around, across. Empty: 4 each.");
}

void declare_file(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add(
    "Mesh file", mesh.file, allowed("the path of a file"),
    "Gmsh .msh 2 or 4.1, or Abaqus .inp; relative to the parameter file. 'meshio convert -o "
    "gmsh22 part.vtk part.msh' converts other formats. Triangles, tetrahedra and prisms are split "
    "into quadrilaterals and "
    "hexahedra. Boundaries are curved as their quadratic elements are, or lie on smooth "
    "surfaces through their nodes; those on spheres, cylinders, cones and tori are "
    "recognized.");
  entries.add("Mesh regions", mesh.regions,
              "Groups of cells of the file that make the body; empty: all cells.");
  entries.add(
    "Boundary names", mesh.boundary_numbers,
    allowed("a list 'number: name, ...' of different numbers"),
    "Names for the groups of faces to which the file gives only numbers, such as physical "
    "groups of Gmsh without a name: '1: bottom, 7: bore'.");
  entries.add(
    "Surface", mesh.surfaces,
    allowed("a list 'boundary: facets, boundary: smooth' of different boundaries"),
    "The geometry of boundaries of a mesh file that is not to be determined from the nodes "
    "and elements: 'nut: facets, bore: smooth'. Facets are plane between the nodes. A "
    "smooth surface passes through the nodes and has no edges. Of other boundaries, facets "
    "that meet at more than 30 degrees meet in an edge, and facets that meet at 15 to 30 "
    "degrees are kept. Spheres, cylinders, cones and tori are recognized, also where "
    "'smooth' is given.");
}

void declare_placement(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Warp", access(mesh.warp, ';'),
              allowed("a list 'FORMULA; FORMULA; FORMULA', one per dimension"),
              "Displacement x, y, z of the mesh by formulas of x, y, z [length], before it is "
              "scaled: '0; 0; 0.1*x^2'. Empty: none.");
  entries.add("Scale", mesh.scale,
              "Factor of all positions, about the origin: 0.001 for a file in mm in a scene in m.");
  entries.add("Rotate", mesh.rotate, allowed("a list 'axis: degrees, ...'"),
              "Rotations of the scaled mesh about axes through the origin, one after the other: "
              "'x: 90, z: 30'. In 2D the axis is z.");
  entries.add("Shift", mesh.shift,
              "Shift of the rotated mesh along x, y, z [length]; empty: none.");
}

void declare_regions(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Region formulas", access(mesh.region_formulas, ';'),
              allowed(
                "a list 'region: FORMULA; ...' of different regions, separated by semicolons"),
              "Regions for 'Materials' besides those of a mesh file: a cell, before refinement, "
              "belongs to the first whose formula of x, y, z is positive at its centre: 'core: 1 - "
              "x^2 - y^2; coat: z > 0.9'.");
}

void declare_refinement(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Refinements", mesh.refinements,
              "How often every cell is split into 4 (2D) or 8 (3D).");
  entries.add("Refine where", mesh.refine_where, allowed("a formula of x, y, z"),
              "Cells are refined where this formula of x, y, z is positive at their centre, 'Local "
              "refinements' times.");
  entries.add("Local refinements", mesh.local_refinements, at_most(15.),
              "How often cells are split where 'Refine where' says so; adjacent cells differ by "
              "one level (hanging nodes).");
}
} // namespace

void BodyMeshParameters::declare(Entries &entries)
{
  entries.add("Mesh", source, "Source of the mesh.");
  declare_box(entries, *this);
  declare_round(entries, *this);
  declare_file(entries, *this);
  declare_placement(entries, *this);
  declare_regions(entries, *this);
  declare_refinement(entries, *this);
}

void BodyMeshParameters::complete(const unsigned int dimension)
{
  const auto fill = [dimension](std::vector<double> &values, const double value) {
    if (values.empty())
      values.assign(dimension, value);
  };
  fill(corner, 0.);
  fill(size, 1.);
  fill(grading, 1.);
  fill(fine_length, 0.);
}
} // namespace snug::geometry
