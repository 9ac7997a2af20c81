// The paper's example: a strand of steel (the stamp) bears on the lower half of the wall of a circular duct in a
// concrete block. Plane problem, lengths in mm, the origin at the duct's centre.
//
//             top
//      +---------------+       block   50 x 50, with the duct of radius 7.7
//      |     .---.     |       stamp   the lower half of a disc of radius 7.6, let down by 0.1 so that it touches
// left |    (     )    | right         the duct's lowest point; the bodies have no node in common
//      |    (=====)    |
//      |     '---'     |       The mesh is mirror-symmetric about x = 0: the right half is meshed, the left half is
//      +---------------+       its copy. The duct's wall runs counter-clockwise, its lower half towards +x.
//            bottom
//
// From the paper: the block of 50 x 50 mm, and with it what is no part of the mesh (the moduli and Poisson's ratios,
// the pressure of 6.3 MPa, the symmetric sides). OUR assumption: the two radii (a strand 15K7 is 15.2 mm thick) and
// the mesh, whose 1,100 nodes or so and edges of equal length on both surfaces follow the paper's words.
//
// To make strand.msh (with Gmsh 4.15.2):  gmsh -2 strand.geo

side = 25;                     // half the block's side
duct = 7.7;                    // the duct's radius
disc = 7.6;                    // the stamp's radius
flat = -0.1;                   // the height of the stamp's flat top

n = 27;                        // edges on a quarter of the lower wall, and on a quarter of the stamp's arc
fine = duct * Pi / 2 / n;      // their length, 0.45
m = 12;                        // edges on a quarter of the upper wall, longer and longer towards the duct's top
core = 1.2;                    // edge lengths at the middle of the stamp's flat top,
roof = 1.5;                    // at the duct's highest point
far = 4;                       // and at the block's corners

// The duct's wall: points 100 to 99 + 2 n + 2 m and a straight line from each to the next, so that a node stands
// exactly at each point. Leftmost, lowest, rightmost, highest point: 100, 100 + n, 100 + 2 n, 100 + 2 n + m.
Point(100) = {-duct, 0, 0, fine};
For i In {1 - n : n - 1}
  t = i / n * Pi / 2;
  Point(100 + n + i) = {duct * Sin(t), -duct * Cos(t), 0, fine};
EndFor
Point(100 + 2 * n) = {duct, 0, 0, fine};
For i In {1 - m : m - 1}
  t = i / m * (1.5 - 0.5 * Fabs(i) / m) * Pi / 2;
  Point(100 + 2 * n + m + i) = {-duct * Sin(t), duct * Cos(t), 0, roof};
EndFor
For i In {100 : 98 + 2 * n + 2 * m}
  Line(i) = {i, i + 1};
EndFor
Line(99 + 2 * n + 2 * m) = {99 + 2 * n + 2 * m, 100};

// The block's outer sides, from the middle of the bottom round to it, and the axis below and above the duct.
Point(1) = {0, -side, 0, far};
Point(2) = {side, -side, 0, far};
Point(3) = {side, side, 0, far};
Point(4) = {0, side, 0, far};
Point(5) = {-side, side, 0, far};
Point(6) = {-side, -side, 0, far};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {1, 100 + n};
Line(8) = {100 + 2 * n + m, 4};
Curve Loop(1) = {1 : 3, -8, -(99 + 2 * n + m) : -(100 + n), -7};
Plane Surface(1) = {1};
Curve Loop(2) = {4 : 6, 7, -(99 + n) : -100, -(99 + 2 * n + 2 * m) : -(100 + 2 * n + m), 8};
Plane Surface(2) = {2};

// The stamp: its arc is made as the duct's wall, leftmost, lowest and rightmost point 300, 300 + n, 300 + 2 n.
Point(300) = {-disc, flat, 0, fine};
For i In {1 - n : n - 1}
  t = i / n * Pi / 2;
  Point(300 + n + i) = {disc * Sin(t), -duct + disc * (1 - Cos(t)), 0, fine};
EndFor
Point(300 + 2 * n) = {disc, flat, 0, fine};
For i In {300 : 299 + 2 * n}
  Line(i) = {i, i + 1};
EndFor
Point(11) = {0, flat, 0, core};
Line(11) = {300 + 2 * n, 11};
Line(12) = {11, 300};
Line(13) = {300 + n, 11};
Curve Loop(11) = {300 + n : 299 + 2 * n, 11, -13};
Plane Surface(11) = {11};
Curve Loop(12) = {300 : 299 + n, 13, 12};
Plane Surface(12) = {12};

Transfinite Curve {100 : 99 + 2 * n + 2 * m, 300 : 299 + 2 * n} = 2;
Periodic Surface {2} = {1} Affine {-1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1};
Periodic Surface {12} = {11} Affine {-1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1};
ReverseMesh Surface {2, 12};   // the triangles of a mirror image run clockwise

Physical Surface("block") = {1, 2};
Physical Surface("stamp") = {11, 12};
Physical Curve("bottom") = {6, 1};
Physical Curve("right") = {2};
Physical Curve("top") = {3, 4};
Physical Curve("left") = {5};
Physical Curve("duct_wall") = {100 : 99 + 2 * n + 2 * m};
Physical Curve("stamp_arc") = {300 : 299 + 2 * n};
Physical Curve("stamp_top") = {11, 12};
Physical Curve("stamp_axis") = {13};

Mesh.MshFileVersion = 2.2;
Mesh.Binary = 0;
