// SPDX-License-Identifier: BSD-3-Clause
// A tyre-like ring in the plane of the wheel, centred at the origin. From outside to inside: tread
// blocks between grooves and the rubber below them ("tread-rubber"), a stiff "belt", the "carcass",
// and spokes in place of the sidewalls ("sidewall") that end on the "rim". Between the spokes lie
// cavities: pressure in them acts on "liner". "tread" is the tops of the blocks and the walls of the
// grooves, "grooves" their bottoms. The first block is straight below the centre.
//   gmsh -2 tyre-section.geo                 40 pitches of block and groove, a spoke every second
DefineConstant[ PITCHES = {40, Name "pitches, an even number"},
                LAND = {0.7, Name "part of a pitch that is block"},
                NL = {4, Name "elements along a block"}, NG = {2, Name "elements along a groove"} ];
// Radii of the rim, carcass, belt, tread rubber, bottom of the grooves, tops of the blocks [m], and
// layers of elements between one and the next.
r() = {0.190, 0.255, 0.270, 0.276, 0.284, 0.300};
n() = {6, 2, 1, 1, 2};
RAYS = 2*PITCHES;     // one where a block begins, one where it ends
OFF = 10*(RAYS + 1);  // arcs and surfaces: OFF + 10 ray + radius; points and lines: 10 ray + radius
Point(1) = {0, 0, 0};

For i In {1:RAYS}
  is_end = (i%2 == 0);
  pitch = Floor((i - 1)/2);
  angle = -Pi/2 + (pitch + (is_end ? LAND/2 : -LAND/2))*2*Pi/PITCHES;
  has_spoke = (i%4 == 2 || i%4 == 3);  // the spokes are below every second groove
  For j In {(has_spoke ? 0 : 1):5}
    Point(10*i + j) = {r(j)*Cos(angle), r(j)*Sin(angle), 0};
  EndFor
  For j In {(has_spoke ? 0 : 1):4}
    Line(10*i + j) = {10*i + j, 10*i + j + 1};
    Transfinite Curve{10*i + j} = n(j) + 1;
  EndFor
EndFor

For i In {1:RAYS}
  next = i%RAYS + 1;
  is_land = (i%2 == 1);
  is_spoke = (i%4 == 2);
  inner = is_spoke ? 0 : 1;
  outer = is_land ? 5 : 4;
  For j In {inner:outer}
    Circle(OFF + 10*i + j) = {10*i + j, 1, 10*next + j};
    Transfinite Curve{OFF + 10*i + j} = (is_land ? NL : NG) + 1;
  EndFor
  For j In {inner:outer-1}
    c = OFF + 10*i + j;
    Curve Loop(c) = {10*i + j, c + 1, -(10*next + j), -c};
    Plane Surface(c) = {c};
    Transfinite Surface{c};
    Recombine Surface{c};
  EndFor
  carcass() += {OFF + 10*i + 1};
  belt() += {OFF + 10*i + 2};
  rubber() += {OFF + 10*i + 3};
  If(is_land)
    rubber() += {OFF + 10*i + 4};
    tread() += {10*i + 4, OFF + 10*i + 5, 10*next + 4};
  Else
    grooves() += {OFF + 10*i + 4};
  EndIf
  If(is_spoke)
    sidewall() += {OFF + 10*i};
    rim() += {OFF + 10*i};
    liner() += {10*i, 10*next};
  Else
    liner() += {OFF + 10*i + 1};
  EndIf
EndFor
Physical Curve("rim", 1) = {rim()};
Physical Curve("liner", 2) = {liner()};
Physical Curve("tread", 3) = {tread()};
Physical Curve("grooves", 4) = {grooves()};
Physical Surface("sidewall", 5) = {sidewall()};
Physical Surface("carcass", 6) = {carcass()};
Physical Surface("belt", 7) = {belt()};
Physical Surface("tread-rubber", 8) = {rubber()};
Mesh.MshFileVersion = 4.1;
