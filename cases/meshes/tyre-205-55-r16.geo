// SPDX-License-Identifier: BSD-3-Clause
// Section of a passenger-car tyre of size 205/55 R16 as it leaves the mould, x = r and y = z, in metres; it
// is its own mirror about z = 0. The carcass ply goes from bead to bead, around each bead core and up again
// outside the bead filler, the "apex"; two belts and a cap lie below a smooth tread. rondo revolves the
// section into hexahedra ([section] of a case) and lays cords ([[cords]]) along the curves "carcass",
// "turn-up", "belt-1", "belt-2", "cap" and "bead-wire", which are edges of elements. "liner" is the wall of
// the cavity, from toe to toe of the beads; "tread" is what may touch the ground; "rim-left" (z < 0) and
// "rim-right" sit on seat and flange of the rim. The beads fit a rim 6.8 inches wide: for one of 6.5 inches
// each moves inwards by 4 mm ([[inflation.mounting]]).
//   gmsh -2 tyre-205-55-r16.geo
//   gmsh -2 tyre-205-55-r16.geo -setnumber N 14 -setnumber NS 2 -setnumber NT 3 -o fine.msh
DefineConstant[ N = {7, Name "elements from the middle to where the ply leaves the belts"},
                NS = {1, Name "factor of the elements from there to the beads"},
                NT = {2, Name "layers of elements of the tread"} ];

// Radius of the tread in its middle; radii of its curve across, on the crown and on the shoulders; half width.
R = 0.3152;
CROWN = 0.700;
SHOULDER = 0.120;
HALF = 0.0880;
// Layers below the middle of the tread: within the ply, from there to belt 1, to belt 2, to the cap, to the
// bottom of the tread, and the tread.
t() = {0.0020, 0.0012, 0.0013, 0.0012, 0.0020, 0.0080};
// Half widths of the belts.
BELT_1 = 0.078;
BELT_2 = 0.073;
// The ply where it is widest; rubber from ply to turn-up and to the outside there.
R_WIDEST = 0.2555;
Z_WIDEST = 0.1010;
PLIES = 0.0013;
WALL = 0.0038;
// The same at the buttress, where base and tread end.
PLIES_BUTTRESS = 0.0025;
WALL_BUTTRESS = 0.0098;
// Angles of the ply's normal to the axle: at the buttress, the end of the turn-up and the tip of the apex.
A_BUTTRESS = 43*Pi/180;
A_TURN_UP = -12*Pi/180;
A_TIP = -36*Pi/180;
// r and z of the bead, each from the cavity through ply and turn-up to the outside: where it leaves the
// flange, at the top, middle and bottom of its core. The last four begin at the toe and end at the heel.
rb() = {0.2201, 0.2189, 0.2178, 0.2172,  0.2141, 0.2130, 0.2126, 0.2120,
        0.2085, 0.2098, 0.2095, 0.2078,  0.2020, 0.2066, 0.2064, 0.2032};
zb() = {0.0791, 0.0808, 0.0859, 0.0890,  0.0745, 0.0765, 0.0830, 0.0868,
        0.0733, 0.0763, 0.0830, 0.0865,  0.0722, 0.0762, 0.0829, 0.0862};

// The ply is an arc about the center (RC, 0) of the crown, one about (R_WIDEST, ZC) that continues it to the
// widest point, one about (R_WIDEST, ZL) to the tip of the apex, and a line to the top of the core.
RC = R - CROWN;
RP = CROWN - t(1) - t(2) - t(3) - t(4) - t(5);
H = R_WIDEST - RC;
RS = (RP*RP - H*H - Z_WIDEST*Z_WIDEST)/(2*(RP - Z_WIDEST));
ZC = Z_WIDEST - RS;
RL = ((rb(5) - R_WIDEST)*Sin(A_TIP) - (Z_WIDEST - zb(5))*Cos(A_TIP))/(1 - Cos(A_TIP));
ZL = Z_WIDEST - RL;
// Belts, cap and tread go on beyond the crown as arcs about (RH, ZH).
RH = RC + (CROWN - SHOULDER)*H/(RP - RS);
ZH = (CROWN - SHOULDER)*ZC/(RP - RS);
PH = RP - CROWN + SHOULDER;

// Columns k across the wall: 0 in the middle, 1 where the crown ends and the ply leaves the belts, 2 and 3
// at the edges of belts 2 and 1, 4 at the buttress, 5 at the widest point, 6 at the end of the turn-up, 7 at
// the tip of the apex, 8 to 11 as rb and zb. Lines j along it: 0 liner, 1 ply, 2 belt 1 and turn-up, 3 belt 2
// and outside of the sidewall, 4 cap, 5 bottom and 6 top of the tread.
n() = {N, 2*NS, NS, 2*NS, 4*NS, NS, 2*NS, 2*NS, NS, NS, NS};  // elements from a column to the next
x() = {};  // r and z of line j at column k at 10 k + j
y() = {};
For i In {0:119}
  x() += {0};
  y() += {0};
EndFor
For k In {0:3}
  edge = (k == 2) ? (BELT_2 - ZH)/(PH + t(1) + t(2)) : (BELT_1 - ZH)/(PH + t(1));
  phi = (k == 0) ? 0 : (k == 1) ? Atan2(ZC, H) : Asin(edge);
  out = -t(0);
  For j In {0:6}
    x(10*k + j) = (k <= 1) ? RC + (RP + out)*Cos(phi) : RH + (PH + out)*Cos(phi);
    y(10*k + j) = (k <= 1) ? (RP + out)*Sin(phi) : ZH + (PH + out)*Sin(phi);
    If(j < 6)
      out += t(j);
    EndIf
  EndFor
  If(k >= 2)
    a = Atan2(x(10*k + 2) - R_WIDEST, y(10*k + 2) - ZC);
    For j In {0:1}
      x(10*k + j) = R_WIDEST + (RS - (1 - j)*t(0))*Sin(a);
      y(10*k + j) = ZC + (RS - (1 - j)*t(0))*Cos(a);
    EndFor
  EndIf
EndFor
For k In {4:7}
  a = (k == 4) ? A_BUTTRESS : (k == 5) ? 0 : (k == 6) ? A_TURN_UP : A_TIP;
  beyond() = {-t(0), 0, (k == 4 ? PLIES_BUTTRESS : PLIES), (k == 4 ? WALL_BUTTRESS : WALL)};
  For j In {0:3}
    x(10*k + j) = R_WIDEST + ((k <= 5 ? RS : RL) + beyond(j))*Sin(a);
    y(10*k + j) = (k <= 5 ? ZC : ZL) + ((k <= 5 ? RS : RL) + beyond(j))*Cos(a);
  EndFor
EndFor
EDGE = RH + Sqrt(SHOULDER*SHOULDER - (HALF - ZH)*(HALF - ZH)) - 0.001;  // of the tread, a little rounded
share() = {0.23, 0.45, 1};  // of the buttress, from the sidewall to there
For j In {4:6}
  x(40 + j) = x(43) + share(j - 4)*(EDGE - x(43));
  y(40 + j) = y(43) + share(j - 4)*(HALF - y(43));
EndFor
For k In {8:11}
  For j In {0:3}
    x(10*k + j) = rb(4*(k - 8) + j);
    y(10*k + j) = zb(4*(k - 8) + j);
  EndFor
EndFor

// Numbers: 10 k + j + 1 and 200 more at z < 0, curves across the wall 1000 more. Centers: 401 to 407.
Point(401) = {RC, 0, 0};
free = 500;  // of the points in the middle of splines
For s In {0:1}
  sign = 1 - 2*s;
  Point(402 + s) = {R_WIDEST, sign*ZC, 0};
  Point(404 + s) = {R_WIDEST, sign*ZL, 0};
  Point(406 + s) = {RH, sign*ZH, 0};
  For k In {s:11}
    For j In {0:(k <= 4 ? 6 : 3)}
      Point(200*s + 10*k + j + 1) = {x(10*k + j), sign*y(10*k + j), 0};
    EndFor
  EndFor
  For k In {0:10}
    For j In {0:(k <= 3 ? 6 : 3)}
      i = 10*k + j;
      c = 200*s + i + 1;
      a = (k == 0) ? i + 1 : c;
      b = c + 10;
      If(k == 0)
        Circle(c) = {a, 401, b};
      ElseIf(k <= 2 && j >= 2)
        Circle(c) = {a, 406 + s, b};
      ElseIf(k <= 4 && j <= 1)
        Circle(c) = {a, 402 + s, b};
      ElseIf(k == 5 || k == 6)
        Circle(c) = {a, 404 + s, b};
      ElseIf((k == 3 && j == 2) || k == 4)  // thickness changes evenly over the ply's arc
        a0 = Atan2(x(i) - R_WIDEST, y(i) - ZC);
        a1 = Atan2(x(i + 10) - R_WIDEST, y(i + 10) - ZC);
        d0 = Hypot(x(i) - R_WIDEST, y(i) - ZC);
        d1 = Hypot(x(i + 10) - R_WIDEST, y(i + 10) - ZC);
        For m In {1:3}
          angle = a0 + m/4*(a1 - a0);
          d = d0 + m/4*(d1 - d0);
          Point(free + m) = {R_WIDEST + d*Sin(angle), sign*(ZC + d*Cos(angle)), 0};
        EndFor
        Spline(c) = {a, free + 1:free + 3, b};
        free += 3;
      Else
        Line(c) = {a, b};
      EndIf
      Transfinite Curve{c} = n(k) + 1;
    EndFor
  EndFor
  For k In {s:11}
    For j In {0:(k <= 4 ? 5 : 2)}
      c = 200*s + 10*k + j + 1;
      Line(1000 + c) = {c, c + 1};
      Transfinite Curve{1000 + c} = (j == 5 ? NT : 1) + 1;
    EndFor
  EndFor
  Line(1330 + s) = {200*s + 111, 200*s + 114};  // the seat, from toe to heel
  Transfinite Curve{1330 + s} = 2;

  For k In {0:11}
    For j In {0:(k <= 3 ? 5 : (k == 11) ? 0 : 2)}
      c = 200*s + 10*k + j + 1;
      a = (k == 0) ? 1001 + j : 1000 + c;
      If(k == 11)  // below the core
        Curve Loop(c) = {a, a + 1, a + 2, -(1330 + s)};
      Else
        Curve Loop(c) = {a, c + 1, -(1000 + c + 10), -c};
      EndIf
      Plane Surface(c) = {c};
      Transfinite Surface{c};
      Recombine Surface{c};
      If(s == 1)
        ReverseMesh Surface{c};
      EndIf
    EndFor
  EndFor
EndFor

For s In {0:1}
  o = 200*s + 1;
  For k In {0:10}
    liner() += {o + 10*k};
    carcass() += {o + 10*k + 1};
    If(k >= 6)
      turn_up() += {o + 10*k + 2};
    EndIf
    If(k <= 2)
      belt_1() += {o + 10*k + 2};
      cap() += {o + 10*k + 4};
    EndIf
    If(k <= 1)
      belt_2() += {o + 10*k + 3};
    EndIf
    If(k <= 3)
      tread() += {o + 10*k + 6};
      below_tread() += {o + 10*k + 4};
      tread_rubber() += {o + 10*k + 5};
    EndIf
    If(k <= 2)
      skim() += {o + 10*k + 2, o + 10*k + 3};
    ElseIf(k == 3)
      below_tread() += {o + 10*k + 2, o + 10*k + 3};
    ElseIf(k <= 7)
      sidewall() += {o + 10*k + 2};
    Else
      chafer() += {o + 10*k + 2};
    EndIf
    If(k <= 8)
      inside() += {o + 10*k};
    Else
      chafer() += {o + 10*k};
    EndIf
    If(k <= 6)
      insulation() += {o + 10*k + 1};
    ElseIf(k <= 8)
      apex() += {o + 10*k + 1};
    Else
      core() += {o + 10*k + 1};
    EndIf
  EndFor
  turn_up() += {1000 + o + 111};
  wires() += {1000 + o + 91, 1000 + o + 101, 1000 + o + 111};
  chafer() += {o + 110};
EndFor
Physical Curve("rim-left", 1) = {1331, 284, 294, 304};
Physical Curve("rim-right", 2) = {1330, 84, 94, 104};
Physical Curve("liner", 3) = {liner()};
Physical Curve("tread", 4) = {tread()};
Physical Curve("carcass", 5) = {carcass()};
Physical Curve("turn-up", 6) = {turn_up()};
Physical Curve("belt-1", 7) = {belt_1()};
Physical Curve("belt-2", 8) = {belt_2()};
Physical Curve("cap", 9) = {cap()};
Physical Curve("bead-wire", 10) = {wires()};
Physical Surface("liner", 11) = {inside()};
Physical Surface("carcass", 12) = {insulation()};
Physical Surface("skim", 13) = {skim()};
Physical Surface("base", 14) = {below_tread()};
Physical Surface("tread", 15) = {tread_rubber()};
Physical Surface("sidewall", 16) = {sidewall()};
Physical Surface("apex", 17) = {apex()};
Physical Surface("bead", 18) = {core()};
Physical Surface("chafer", 19) = {chafer()};
Mesh.MshFileVersion = 4.1;
