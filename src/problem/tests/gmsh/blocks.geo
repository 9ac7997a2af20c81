// Two blocks that touch without sharing a node; a name with a space; a physical group ("both") shared by the blocks.
// How the .msh files are made (with Gmsh 4.15.2):
//   gmsh -2 blocks.geo      -format msh22 -o blocks-2.2-ascii.msh
//   gmsh -2 blocks.geo -bin -format msh22 -o blocks-2.2-binary.msh
//   gmsh -2 blocks.geo      -format msh41 -o blocks-4.1-ascii.msh
//   gmsh -2 blocks.geo -bin -format msh41 -o blocks-4.1-binary.msh

// The lower block, 2 by 1.
Point(1) = {0, 0, 0, 1};
Point(2) = {2, 0, 0, 1};
Point(3) = {2, 1, 0, 1};
Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// The upper block, 1 by 0.5.
Point(11) = {0.5, 1, 0, 0.4};
Point(12) = {1.5, 1, 0, 0.4};
Point(13) = {1.5, 1.5, 0, 0.4};
Point(14) = {0.5, 1.5, 0, 0.4};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(11) = {11, 12, 13, 14};
Plane Surface(11) = {11};

Physical Surface("lower block", 1) = {1};
Physical Surface("upper", 2) = {11};
Physical Surface("both", 3) = {1, 11};
Physical Curve("bottom", 1) = {1};
Physical Curve("top", 2) = {13};
Physical Curve("contact", 5) = {3, 11};
Physical Point("corner", 7) = {1};
