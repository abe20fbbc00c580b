// Copyright 2026 The percuss authors
// SPDX-License-Identifier: Apache-2.0
//
// An angle bracket of 5 mm sheet, 60 x 40 mm with a wall of 50 mm, an inner fillet of 4 mm and two
// holes of 8 mm in the foot; lengths in mm. See docs/mesh.md.
//   gmsh -3 -order 2 bracket.geo -o bracket.msh
SetFactory("OpenCASCADE");
sheet = 5;
Box(1) = {0, 0, 0, 60, 40, sheet};
Box(2) = {0, 0, 0, sheet, 40, 50};
// what fills the corner, and the cylinder that hollows it out
Box(3) = {sheet, 0, sheet, 4, 40, 4};
Cylinder(4) = {sheet + 4, 0, sheet + 4, 0, 40, 0, 4};
BooleanDifference(5) = {Volume{3}; Delete;}{Volume{4}; Delete;};
BooleanUnion(6) = {Volume{1}; Delete;}{Volume{2, 5}; Delete;};
Cylinder(7) = {45, 10, -1, 0, 0, sheet + 2, 4};
Cylinder(8) = {45, 30, -1, 0, 0, sheet + 2, 4};
BooleanDifference(9) = {Volume{6}; Delete;}{Volume{7, 8}; Delete;};

// names: the part, and the underside to hold it by (percuss-reduce --fixed foot)
Physical Volume("bracket") = {9};
foot() = Surface In BoundingBox {-0.01, -0.01, -0.01, 60.01, 40.01, 0.01};
Physical Surface("foot") = {foot()};

Mesh.MeshSizeMax = 4;
Mesh.MeshSizeFromCurvature = 10;
Mesh.HighOrderOptimize = 2;
