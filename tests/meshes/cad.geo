// The CAD files of the tests: 'gmsh -0 cad.geo' writes them. The name of the face foot of
// pins.step was written with an editor.
SetFactory("OpenCASCADE");

// A pin with a fillet, and a prism.
Cylinder(1) = {0, 0, 0, 0, 0, 2, 0.5};
Fillet{1}{1}{0.2}
Box(2) = {2, 0, 0, 1, 1, 0.5};
Save "pins.step";
Save "pins.brep";

// A plane face below a line and above the parabola y = x^2, with a hole.
NewModel;
SetFactory("OpenCASCADE");
Point(1) = {-1, 1, 0};
Point(2) = {0, -1, 0};
Point(3) = {1, 1, 0};
Bezier(1) = {1, 2, 3};
Line(2) = {3, 1};
Circle(3) = {0, 0.6, 0, 0.15};
Curve Loop(1) = {1, 2};
Curve Loop(2) = {3};
Plane Surface(1) = {1, 2};
Save "parabola.step";

// The same face extruded.
Extrude {0, 0, 0.5} { Surface{1}; }
Recursive Delete { Surface{1}; }
Save "parabola-bar.step";

// A quarter of a ring between the radii 1 and 2.
NewModel;
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {2, 0, 0};
Point(4) = {0, 2, 0};
Point(5) = {0, 1, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Save "ring.step";
