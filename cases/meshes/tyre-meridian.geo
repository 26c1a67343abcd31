// SPDX-License-Identifier: BSD-3-Clause
// Meridian section of a tyre-like wheel, x = r and y = z, in metres: two sidewalls that stand on the
// "rim", a carcass and a belt across, and four ribs of tread between three grooves around the wheel.
// "liner" is the inside of the cavity, open at the rim; "tread" the tops of the ribs. Quadrilaterals
// alone: rondo revolves them into hexahedra ([section] of a case).
//   gmsh -2 tyre-meridian.geo
// z of the lines across, elements between them; a rib is at every odd interval.
z() = {-0.080, -0.066, -0.036, -0.028, -0.004, 0.004, 0.028, 0.036, 0.066, 0.080};
nz() = {2, 3, 1, 3, 1, 3, 1, 3, 2};
// r of the lines around: rim, inside, carcass, belt, bottom of the grooves, tops; elements between.
r() = {0.190, 0.254, 0.260, 0.266, 0.274, 0.284};
nr() = {7, 1, 1, 1, 1};

For j In {0:5}
  For i In {0:9}
    Point(1 + 10*j + i) = {r(j), z(i), 0};
  EndFor
EndFor
For j In {0:5}
  For i In {0:8}
    Line(100 + 10*j + i) = {1 + 10*j + i, 2 + 10*j + i};
    Transfinite Curve{100 + 10*j + i} = nz(i) + 1;
  EndFor
EndFor
For j In {0:4}
  For i In {0:9}
    Line(200 + 10*j + i) = {1 + 10*j + i, 1 + 10*(j + 1) + i};
    Transfinite Curve{200 + 10*j + i} = nr(j) + 1;
  EndFor
EndFor
For j In {0:4}
  For i In {0:8}
    is_there = (j == 0) ? (i == 0 || i == 8) : (j == 4) ? !(i == 2 || i == 4 || i == 6) : 1;
    If(is_there)
      s = 300 + 10*j + i;
      Curve Loop(s) = {200 + 10*j + i, 100 + 10*(j + 1) + i, -(200 + 10*j + i + 1), -(100 + 10*j + i)};
      Plane Surface(s) = {s};
      Transfinite Surface{s};
      Recombine Surface{s};
      If(j == 0)
        sidewall() += {s};
      EndIf
      If(j == 1)
        carcass() += {s};
      EndIf
      If(j == 2)
        belt() += {s};
      EndIf
      If(j >= 3)
        rubber() += {s};
      EndIf
      If(j == 4)
        tread() += {100 + 10*(j + 1) + i};
      EndIf
    EndIf
  EndFor
EndFor
Physical Curve("rim", 1) = {100, 108};
Physical Curve("liner", 2) = {201, 208, 111:117};
Physical Curve("tread", 3) = {tread()};
Physical Surface("sidewall", 4) = {sidewall()};
Physical Surface("carcass", 5) = {carcass()};
Physical Surface("belt", 6) = {belt()};
Physical Surface("tread-rubber", 7) = {rubber()};
Mesh.MshFileVersion = 4.1;
