// A quarter of the contact of a wheel: 20 mm of the half width x > 0, and 0.28 radian of the rim of
// radii 36 and 50 about the axis y = 0, z = -50. The tread, x < 14, touches the plane z = 0.
// 'gmsh -0 roller.geo' writes roller.step. Units: mm.
SetFactory("OpenCASCADE");
Point(1) = {0, 0, -14};
Point(2) = {20, 0, -14};
Point(3) = {20, 0, 0};
Point(4) = {14, 0, 0};
Point(5) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};
Extrude {{1, 0, 0}, {0, 0, -50}, -0.28} { Surface{1}; }
Recursive Delete { Surface{1}; }
Save "roller.step";
