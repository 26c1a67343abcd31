// SPDX-License-Identifier: BSD-3-Clause
// Two disks of triangles beside each other, GAP between them, the middle of the gap at the origin.
// "tread" is both rims: a curve may be in several physical groups.
//   gmsh -2 two-disks.geo                    R = 0.1 m, gap 1 mm, 40 elements along each rim
DefineConstant[ R = {0.1, Name "radius"}, GAP = {0.001, Name "gap"},
                N = {40, Name "elements along each rim"} ];
Mesh.MeshSizeMax = 2*Pi*R/N;
For side In {0:1}
  x = (2*side - 1)*(R + GAP/2);
  p = 10*side;
  Point(p+1) = {x, 0, 0};
  Point(p+2) = {x + R, 0, 0};
  Point(p+3) = {x, R, 0};
  Point(p+4) = {x - R, 0, 0};
  Point(p+5) = {x, -R, 0};
  For k In {1:4}
    Circle(p+k) = {p+1+k, p+1, p+2+(k%4)};
  EndFor
  Curve Loop(p+1) = {p+1:p+4};
  Plane Surface(p+1) = {p+1};
  Transfinite Curve{p+1:p+4} = Round(N/4) + 1;
EndFor
Mesh.Algorithm = 6;
Physical Curve("left-tread", 1) = {1:4};
Physical Curve("right-tread", 2) = {11:14};
Physical Curve("tread", 3) = {1:4, 11:14};
Physical Surface("left", 4) = {1};
Physical Surface("right", 5) = {11};
Mesh.MshFileVersion = 4.1;
