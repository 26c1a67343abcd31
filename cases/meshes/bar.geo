// SPDX-License-Identifier: BSD-3-Clause
// An upright bar, one element wide and N along, its foot on y = 0, centred over x = 0.
//   gmsh -2 bar.geo                          L = 10 m, N = 100, square elements
//   gmsh -2 bar.geo -setnumber N 400 -o bar-400.msh
DefineConstant[ L = {10, Name "length"}, N = {100, Name "elements along the bar"},
                W = {L/N, Name "width"} ];
Point(1) = {-W/2, 0, 0};
Point(2) = { W/2, 0, 0};
Point(3) = { W/2, L, 0};
Point(4) = {-W/2, L, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 2;
Transfinite Curve{2, 4} = N + 1;
Transfinite Surface{1};
Recombine Surface{1};
Physical Curve("foot", 1) = {1};
Physical Curve("top", 2) = {3};
Physical Curve("sides", 3) = {2, 4};
Physical Curve("boundary", 5) = {1, 2, 3, 4};
Physical Surface("bar", 4) = {1};
Mesh.MshFileVersion = 4.1;
