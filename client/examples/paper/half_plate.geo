// A half-circular plate, R x T, its straight edge on y = 0 and struck there in the middle, at the origin
// (mm): elements of H, and of a quarter of the thickness where it is struck. As heavy as the paper's rod of
// 1 m x 10 mm: R 100, T 20; R 141.421, T 10; R 200, T 5.
// bodies.sh meshes and reduces it.
SetFactory("OpenCASCADE");
DefineConstant[R = 100, T = 20, H = 10];
Cylinder(1) = {0, 0, -T/2, 0, 0, T, R, Pi};
Physical Volume("plate") = {1};

Field[1] = Ball;
Field[1].Radius = T;
Field[1].Thickness = 3 * T;
Field[1].VIn = T / 4;
Field[1].VOut = H;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;
