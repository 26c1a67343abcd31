// SPDX-License-Identifier: BSD-3-Clause
// A square block of N x N equal quadrilaterals, its foot on y = 0, centred over x = 0.
//   gmsh -2 block.geo                        L = 0.1 m, N = 10
//   gmsh -2 block.geo -setnumber N 40 -o fine.msh
DefineConstant[ L = {0.1, Name "side"}, N = {10, Name "elements along a side"} ];
Point(1) = {-L/2, 0, 0};
Point(2) = { L/2, 0, 0};
Point(3) = { L/2, L, 0};
Point(4) = {-L/2, L, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = N + 1;
Transfinite Surface{1};
Recombine Surface{1};
Physical Curve("foot", 1) = {1};
Physical Curve("top", 2) = {3};
Physical Curve("sides", 3) = {2, 4};
Physical Surface("block", 4) = {1};
Mesh.MshFileVersion = 4.1;
