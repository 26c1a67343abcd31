// SPDX-License-Identifier: BSD-3-Clause
// The bar of bar.geo with a fine tip added at its foot: N square elements over L, and below them NT
// elements of the height H each. The foot is on y = 0.
//   gmsh -2 bar-fine-tip.geo                 H = 0.01 m, a tenth of the others
//   gmsh -2 bar-fine-tip.geo -setnumber H 0.002 -o bar-finer-tip.msh
DefineConstant[ L = {10, Name "length above the tip"}, N = {100, Name "elements over it"},
                H = {L/N/10, Name "height of an element of the tip"},
                NT = {5, Name "elements of the tip"}, W = {L/N, Name "width"} ];
Point(1) = {-W/2, 0, 0};
Point(2) = { W/2, 0, 0};
Point(3) = { W/2, NT*H, 0};
Point(4) = {-W/2, NT*H, 0};
Point(5) = { W/2, NT*H + L, 0};
Point(6) = {-W/2, NT*H + L, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 3, 6} = 2;
Transfinite Curve{2, 4} = NT + 1;
Transfinite Curve{5, 7} = N + 1;
Transfinite Surface{1};
Transfinite Surface{2};
Recombine Surface{1};
Recombine Surface{2};
Physical Curve("foot", 1) = {1};
Physical Curve("top", 2) = {6};
Physical Curve("sides", 3) = {2, 4, 5, 7};
Physical Surface("tip", 4) = {1};
Physical Surface("bar", 5) = {2};
Mesh.MshFileVersion = 4.1;
