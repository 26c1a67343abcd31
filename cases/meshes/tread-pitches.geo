// SPDX-License-Identifier: BSD-3-Clause
// A solid ring in the plane of the wheel, centred at the origin, with tread of pitches of three
// lengths in an order that does not repeat, as tyres have it against a tone. "rim" is the inner
// boundary, "tread" the tops of the lands. The first land begins straight below the centre.
//   gmsh -2 tread-pitches.geo
DefineConstant[ LAND = {0.75, Name "part of a pitch that is land"},
                NL = {3, Name "elements along a land"}, NG = {1, Name "elements along a groove"} ];
// Lengths of the pitches: 1 short, 2 middle, 3 long.
order() = {2, 1, 1, 3, 2, 3, 3, 1, 2, 2, 3, 1, 1, 2, 3, 3, 2, 1, 2, 3, 1, 1, 2, 2, 3, 3, 3, 2, 1, 1,
           3, 2, 2, 1, 3, 3, 1, 1, 2, 3, 2, 1, 3, 3, 2, 2, 1, 3, 1, 2, 3, 2, 1, 1, 3, 2, 3, 1, 2, 2};
length() = {0, 0.82, 1.0, 1.2};
PITCHES = #order();
// Radii of the rim, the bottoms of the grooves, the tops of the lands [m], and layers of elements.
r() = {0.150, 0.280, 0.300};
n() = {9, 2};

all = 0;
For p In {0:PITCHES-1}
  all += length(order(p));
EndFor
// Rays: one where a land begins, one where it ends. Points and lines: 10 ray + radius; arcs and
// surfaces: OFF + 10 ray + radius.
RAYS = 2*PITCHES;
OFF = 10*(RAYS + 1);
Point(1) = {0, 0, 0};
so_far = 0;
For p In {0:PITCHES-1}
  For end In {0:1}
    i = 2*p + 1 + end;
    angle = -Pi/2 + (so_far + end*LAND*length(order(p)))/all*2*Pi;
    For j In {0:2}
      Point(10*i + j) = {r(j)*Cos(angle), r(j)*Sin(angle), 0};
    EndFor
    For j In {0:1}
      Line(10*i + j) = {10*i + j, 10*i + j + 1};
      Transfinite Curve{10*i + j} = n(j) + 1;
    EndFor
  EndFor
  so_far += length(order(p));
EndFor
For i In {1:RAYS}
  next = i%RAYS + 1;
  is_land = (i%2 == 1);
  outer = is_land ? 2 : 1;
  For j In {0:outer}
    Circle(OFF + 10*i + j) = {10*i + j, 1, 10*next + j};
    Transfinite Curve{OFF + 10*i + j} = (is_land ? NL : NG) + 1;
  EndFor
  For j In {0:outer-1}
    c = OFF + 10*i + j;
    Curve Loop(c) = {10*i + j, c + 1, -(10*next + j), -c};
    Plane Surface(c) = {c};
    Transfinite Surface{c};
    Recombine Surface{c};
    body() += {c};
  EndFor
  rim() += {OFF + 10*i};
  If(is_land)
    tread() += {OFF + 10*i + 2};
  EndIf
EndFor
Physical Curve("rim", 1) = {rim()};
Physical Curve("tread", 2) = {tread()};
Physical Surface("disk", 3) = {body()};
Mesh.MshFileVersion = 4.1;
