#include <snug/base/section_check.h>
#include <snug/geometry/body_geometry.h>

namespace snug::geometry {
namespace {
void declare_box(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Box corner", mesh.corner, per_dimension(),
              "The corner with the smallest coordinates. Units: length. An empty list means the "
              "origin.");
  entries.add("Box size", mesh.size, per_dimension(positive()),
              "The edge lengths along x, y, z. Units: length. An empty list means 1.");
  entries.add("Box cells", mesh.cells, per_dimension(),
              "The numbers of cells along x, y, z before refinement.");
  entries.add(
    "Box grading", mesh.grading, per_dimension(positive()),
    "The ratios of the size of the last cell to the size of the first cell along x, y, z, "
    "with sizes in geometric progression. An empty list means equal cells.");
  entries.add(
    "Box fine length", mesh.fine_length, per_dimension(),
    "The lengths along x, y, z, from the lower end, that half of the cells fill with equal "
    "sizes. The sizes of the other cells grow from there. Units: length. A value of 0 or "
    "an empty list means no fine part.");
  entries.add(
    "Curved faces", access(mesh.curved_faces, ';'),
    with_meanings(
      allowed("a list 'boundary: surface; boundary: surface' of different boundaries, separated by "
              "semicolons"),
      {{"sphere R", "face of a box on a sphere of radius R [length], positive if convex: 'bottom: "
                    "sphere 4'"},
       {"cylinder AXIS R",
        "face of a box on a cylinder along x, y or z: 'bottom: cylinder x 4'. In "
        "2D the axis is z."},
       {"sphere R at X, Y",
        "the same with the point of contact of the sphere and the flat face at "
        "these coordinates [length] instead of the centre of the face: 'bottom: "
        "sphere 4 at 0, 0' for half of a symmetric body"},
       {"cylinder AXIS R at Y",
        "the same with the coordinate across the axis: 'bottom: cylinder y 4 "
        "at 0'"},
       {"FORMULA", "outward displacement of the face of a box [length] as a formula of x, y, z: "
                   "'bottom: -(x^2)/8'"}}),
    "The true surfaces of faces of a box that are not flat.");
}

void declare_round(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Radius", mesh.radius, "The outer radius of round bodies. Units: length.");
  entries.add("Inner radius", mesh.inner_radius,
              "The inner radius of rings and shells. Units: length.");
  entries.add("Length", mesh.length,
              "The length of cylinders and 3D rings along z. Units: length.");
  entries.add("Part", mesh.part,
              "The part of a round body that is meshed; mirror images make the rest. Only spheres "
              "and shells have eighths.");
  entries.add("Cells", mesh.round_cells,
              with_meanings({},
                            {{"ring", "around the meshed part, from the inner to the outer "
                                      "radius, and in 3D along the axis"},
                             {"disc, sphere", "along each edge of a block; a quarter of a disc "
                                              "and an eighth of a sphere consist of such blocks"},
                             {"cylinder", "along each edge of a block of the disc, and along the "
                                          "axis"},
                             {"shell", "around each block, and from the inner to the outer "
                                       "radius"}}),
              "The numbers of cells of round bodies before refinement. Their meaning depends on "
              "'Mesh'. An empty list means 4 cells each.");
}

void declare_file(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add(
    "File", mesh.file,
    with_meanings(allowed("the path of a file"),
                  {{"mesh files", "Gmsh .msh 2 or 4.1, or Abaqus .inp. Triangles, tetrahedra and "
                                  "prisms are split into quadrilaterals and hexahedra. 'meshio "
                                  "convert -o gmsh22 part.vtk part.msh' converts other formats."},
                   {"CAD files", "STEP (.step, .stp), IGES (.iges, .igs) and BREP (.brep). Lengths "
                                 "of STEP and IGES files are converted to mm."}}),
    "The mesh file or CAD file, relative to the parameter file.");
  entries.add("Mesh regions", mesh.regions,
              "The groups of cells of the mesh file that form the body. An empty list means all "
              "cells.");
  entries.add(
    "Boundary sets", mesh.boundary_sets,
    "The sets of the mesh file that are boundaries of the body: sets of faces, and node "
    "sets of Abaqus, which stand for the faces whose nodes are all in the set. Faces in "
    "the sets a and b are the boundary 'a and b'. An empty list means all sets of faces.");
  entries.add("Boundary names", mesh.boundary_numbers,
              allowed("a list 'group: name, ...' of different groups"),
              "The names of boundaries by the number or name of their group of faces in the mesh "
              "file: '1: bottom, 7: bore'. A group of Gmsh without a name, such as group 7, is "
              "called group-7 "
              "otherwise.");
  entries.add(
    "Surface", mesh.surfaces,
    with_meanings(
      allowed("a list 'boundary: facets, boundary: smooth' of different boundaries"),
      {{"facets", "plane facets between the nodes"},
       {"smooth", "one smooth surface through the nodes, without edges"},
       {"boundaries not listed",
        "the surface of quadratic elements, or a recognized sphere, cylinder, cone or torus, or "
        "a smooth surface with edges where facets meet at more than 30 degrees; facets that meet "
        "at 15 to 30 degrees are kept"}}),
    "The true surfaces of boundaries of a mesh file: 'nut: facets, bore: smooth'.");
}

void declare_cad(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Solid", mesh.solid,
              "The number of the solid of a CAD file that is the body, in 2D of the plane face. A "
              "value of 0 means the only solid or plane face.");
  entries.add(
    "CAD faces", access(mesh.cad_faces, ';'),
    with_meanings(
      allowed("a list 'boundary: faces; boundary: faces' of different boundaries, separated by "
              "semicolons, with faces separated by +"),
      {{"3", "face 3 of the CAD file, in 2D edge 3; '--validate' lists all faces"},
       {"seat", "all faces with this name in the CAD file"},
       {"chain 3, chain seat",
        "the same faces and all faces that continue them without an edge: adjacent faces whose "
        "normals differ by less than 0.5 degrees"}}),
    "The boundaries that consist of several faces of a CAD file: 'race: 3 + 4 + 7; bore: chain 5'. "
    "All other faces are boundaries with their name in the file, or face-3 for face 3 without a "
    "name, in 2D edge-3.");
  entries.add(
    "Element size", mesh.element_size,
    "The length of the edges of the elements of a CAD file, which must be given. Faces with a "
    "radius of curvature R have elements of the size R/2, but at least a tenth of this size. "
    "Units: length, "
    "before 'Scale'.");
  entries.add("Face sizes", mesh.face_sizes, allowed("a list 'boundary: size, boundary: size'"),
              "The size of the elements on boundaries of a CAD file: 'race: 0.1, bore: 0.5'. "
              "Units: length, before 'Scale'.");
  entries.add("Size growth", mesh.size_growth, above(0., 1.),
              "The growth of the element size of a CAD file per distance from faces with smaller "
              "elements.");
}

void declare_placement(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Warp", access(mesh.warp, ';'),
              allowed("a list 'FORMULA; FORMULA; FORMULA', one per dimension"),
              "The displacement of the mesh along x, y, z before scaling, as formulas of x, y, z: "
              "'0; 0; 0.1*x^2'. Units: length. An empty list means no displacement.");
  entries.add(
    "Scale", mesh.scale,
    "The factor of all positions about the origin: 0.001 for a file in mm in a model in m.");
  entries.add(
    "Rotate", mesh.rotate, allowed("a list 'axis: degrees, ...'"),
    "The rotations of the scaled mesh about axes through the origin, one after the other: "
    "'x: 90, z: 30'. In 2D the axis is z. Units: degrees.");
  entries.add(
    "Shift", mesh.shift,
    "The translation of the rotated mesh along x, y, z. Units: length. An empty list means "
    "no translation.");
}

void declare_regions(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Region formulas", access(mesh.region_formulas, ';'),
              allowed(
                "a list 'region: FORMULA; ...' of different regions, separated by semicolons"),
              "The regions for 'Materials' that are added to the regions of a mesh file. A cell of "
              "the mesh before refinement belongs to the first region whose formula of x, y, z is "
              "positive at its centre: 'core: 1 - x^2 - y^2; coat: z > 0.9'.");
  entries.add("Boundary formulas", access(mesh.boundary_formulas, ';'),
              allowed("a list 'name: boundary & FORMULA; ...' of different new names, separated by "
                      "semicolons"),
              "New boundaries, which are parts of boundaries of the mesh: the faces before "
              "refinement on which a formula of x, y, z is positive, the others keep their "
              "boundary. The edges of a part must follow edges of faces: 'seat: bottom & x < 0.5; "
              "pad: top & max(abs(x), abs(y)) < 0.2'.");
}

void declare_refinement(Entries &entries, BodyMeshParameters &mesh)
{
  entries.add("Refinements", mesh.refinements,
              "The number of uniform refinements. Each one splits a cell into 4 (2D) or 8 (3D).");
  entries.add("Refine where", mesh.refine_where, allowed("a formula of x, y, z"),
              "The formula of x, y, z that is positive at the centres of the cells to be refined "
              "locally.");
  entries.add("Local refinements", mesh.local_refinements, at_most(15.),
              "The number of local refinements by 'Refine where'. The levels of adjacent cells "
              "differ by at most one (hanging nodes).");
}
} // namespace

void BodyMeshParameters::declare(Entries &entries)
{
  entries.add("Mesh", source, "The source of the mesh.");
  declare_box(entries, *this);
  declare_round(entries, *this);
  declare_file(entries, *this);
  declare_cad(entries, *this);
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
