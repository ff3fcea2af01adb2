// Two gears that touch at the pitch point (r1, 0), one tooth of each on a full rim.
// Flanks are involutes without backlash; the tooth of the pinion points along x, that of
// the wheel against it. Lengths in mm.
//   gmsh -2 -order 2 -format msh41 -bin gear.geo -o gear.msh
// -setnumber z1 17 and so on make other gears, -setnumber quads 1 quadrilaterals.
DefineConstant[
  module = 4, z1 = 20, z2 = 30, // numbers of teeth
  angle = 20,                   // of pressure [degrees]
  fine = 0.06,                  // size of cells at the pitch point
  quads = 0
];
alpha = angle * Pi / 180;
n = 24; // points along a flank

Macro Gear
  // of z teeth about (cx, 0), the pitch point of its left flank at the angle turn
  r = module * z / 2;
  rb = r * Cos(alpha);
  ra = r + module;
  rf = r - 1.25 * module;
  If (rf < rb + 0.0125 * module)
    rf = rb + 0.0125 * module;
  EndIf
  half = Pi / (2 * z) + Tan(alpha) - alpha;
  centre = newp; Point(centre) = {cx, 0, 0};
  left() = {}; right() = {};
  For i In {0 : n}
    rho = rf + (ra - rf) * i / n;
    phi = Acos(rb / rho);
    theta = half - Tan(phi) + phi;
    p = newp; Point(p) = {cx + rho * Cos(turn + theta), rho * Sin(turn + theta), 0};
    left() += {p};
    p = newp; Point(p) = {cx + rho * Cos(turn - theta), rho * Sin(turn - theta), 0};
    right() += {p};
  EndFor
  For i In {0 : 3}
    t = turn + i * Pi / 2;
    root~{i} = newp; Point(root~{i}) = {cx + rf * Cos(t), rf * Sin(t), 0};
    bore~{i} = newp; Point(bore~{i}) = {cx + 0.45 * rf * Cos(t), 0.45 * rf * Sin(t), 0};
  EndFor
  flankL = newl; Spline(flankL) = left();
  flankR = newl; Spline(flankR) = right();
  tip = newl; Circle(tip) = {right(n), centre, left(n)};
  c = newl; Circle(c) = {left(0), centre, root_1}; rootLines() = {c};
  c = newl; Circle(c) = {root_1, centre, root_2}; rootLines() += {c};
  c = newl; Circle(c) = {root_2, centre, root_3}; rootLines() += {c};
  c = newl; Circle(c) = {root_3, centre, right(0)}; rootLines() += {c};
  boreLines() = {};
  For i In {0 : 3}
    j = (i + 1) % 4;
    c = newl; Circle(c) = {bore~{i}, centre, bore~{j}}; boreLines() += {c};
  EndFor
  outline = newll; Line Loop(outline) = {flankR, tip, -flankL, rootLines()};
  hole = newll; Line Loop(hole) = {boreLines()};
  surface = news; Plane Surface(surface) = {outline, hole};
Return

cx = 0; z = z1; turn = -Pi / (2 * z1);
Call Gear;
Physical Surface("pinion") = {surface};
Physical Line("pinion_flank") = {flankL};
Physical Line("pinion_bore") = {boreLines()};
cx = module * (z1 + z2) / 2; z = z2; turn = Pi - Pi / (2 * z2);
Call Gear;
Physical Surface("wheel") = {surface};
Physical Line("wheel_flank") = {flankL};
Physical Line("wheel_bore") = {boreLines()};

pitch = newp; Point(pitch) = {module * z1 / 2, 0, 0};
Field[1] = Distance;
Field[1].PointsList = {pitch};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = fine;
Field[2].SizeMax = module;
Field[2].DistMin = 10 * fine;
Field[2].DistMax = 14 / 4 * module;
Background Field = 2;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.RecombineAll = quads;
