// SPDX-License-Identifier: BSD-3-Clause
// Two squares beside each other with one edge in common, quadrilaterals in the left and triangles in
// the right. Made by make.sh in all four forms of a Gmsh file. "skin" holds parts of other curves.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Point(5) = {2, 0, 0};
Point(6) = {2, 1, 0};
Point(9) = {0.5, 5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {2, 5};
Line(6) = {5, 6};
Line(7) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2};
Plane Surface(2) = {2};
Transfinite Curve{1:7} = 4;
Transfinite Surface{1};
Recombine Surface{1};
Transfinite Surface{2};
Physical Point("beacon", 1) = {9};
Physical Curve("foot", 2) = {1, 5};
Physical Curve("top", 3) = {3, 7};
Physical Curve("seam", 4) = {2};
Physical Curve("skin", 5) = {1, 5, 6};
Physical Curve(6) = {4};
Physical Surface("left", 7) = {1};
Physical Surface("right", 8) = {2};
