SetFactory("OpenCASCADE");
Merge "rim.brep";
Merge "rim.pos";
Background Mesh View[0];
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
General.NumThreads = 1;
Mesh.MaxNumThreads1D = 1;
Mesh.MaxNumThreads2D = 1;
Mesh.MaxNumThreads3D = 1;
Mesh.RandomSeed = 1;
Mesh.ElementOrder = 2;
Mesh.MshFileVersion = 4.1;
f() = Surface{:};
For k In {0 : #f() - 1}
  Physical Surface(f(k)) = {f(k)};
EndFor
b() = Volume{:};
Physical Volume(1) = {b()};
