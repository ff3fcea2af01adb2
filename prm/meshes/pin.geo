// A quarter of a pin: shank of radius 1 from z = 0.268 to 1.2, its end a sphere of
// radius 2 that touches z = 0. Lengths in mm.
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 2, 2};
Cylinder(2) = {0, 0, -1, 0, 0, 2.2, 1};
Box(3) = {0, 0, -1, 2, 2, 4};
BooleanIntersection(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanIntersection(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
e = 1e-4;
left() = Surface In BoundingBox{-e, -e, -e, e, 2, 3};
front() = Surface In BoundingBox{-e, -e, -e, 2, e, 3};
top() = Surface In BoundingBox{-e, -e, 1.2 - e, 2, 2, 1.2 + e};
all() = Surface{:};
round() = all();
round() -= left();
round() -= front();
round() -= top();
For i In {0 : #round() - 1}
  box() = BoundingBox Surface{round(i)};
  If (box(2) < e)
    ball = round(i);
  Else
    shank = round(i);
  EndIf
EndFor
Physical Volume("pin") = {Volume{:}};
Physical Surface("left") = left();
Physical Surface("front") = front();
Physical Surface("top") = top();
Physical Surface("ball") = ball;
Physical Surface("shank") = shank;
Field[1] = Ball;
Field[1].Radius = 0.35;
Field[1].Thickness = 0.6;
Field[1].VIn = 0.06;
Field[1].VOut = 0.25;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
