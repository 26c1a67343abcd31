// SPDX-License-Identifier: BSD-3-Clause
// A disk without a hole, centred at the origin: quadrilaterals, and triangles where they are better.
//   gmsh -2 disk-solid.geo                   R = 0.3 m, 60 elements along the rim
//   gmsh -2 disk-solid.geo -setnumber N 120 -o fine.msh
DefineConstant[ R = {0.3, Name "radius"}, N = {60, Name "elements along the rim"} ];
Point(1) = {0, 0, 0};
Point(2) = {R, 0, 0};
Point(3) = {0, R, 0};
Point(4) = {-R, 0, 0};
Point(5) = {0, -R, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = Round(N/4) + 1;
Recombine Surface{1};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 0;
Mesh.MeshSizeMax = 2*Pi*R/N;
Physical Curve("tread", 1) = {1:4};
Physical Surface("disk", 2) = {1};
Mesh.MshFileVersion = 4.1;
