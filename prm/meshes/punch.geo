// A quarter of a punch: a nose of radius 10, a fillet of radius 0.5, a shank of radius 4 with a
// groove of radius 0.6. 'gmsh -0 punch.geo' writes punch.step. Units: mm.
SetFactory("OpenCASCADE");
nose = 10; shank = 4; fillet = 0.5; groove = 0.6; at = 6; height = 10;

// Centre of the fillet, and its end on the nose.
x = shank - fillet;
z = nose - Sqrt((nose - fillet)^2 - x^2);
Point(1) = {0, 0, 0};
Point(2) = {x * nose / (nose - fillet), 0, nose + (z - nose) * nose / (nose - fillet)};
Point(3) = {shank, 0, z};
Point(4) = {shank, 0, at - groove};
Point(5) = {shank - groove, 0, at};
Point(6) = {shank, 0, at + groove};
Point(7) = {shank, 0, height};
Point(8) = {0, 0, height};
Point(11) = {0, 0, nose};
Point(12) = {x, 0, z};
Point(13) = {shank, 0, at};
Circle(1) = {1, 11, 2};
Circle(2) = {2, 12, 3};
Line(3) = {3, 4};
Circle(4) = {4, 13, 5};
Circle(5) = {5, 13, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Curve Loop(1) = {1:8};
Plane Surface(1) = {1};
Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{1}; }
Recursive Delete { Surface{1}; }
Save "punch.step";
