// Half of a stiff punch with square edges, 5 mm wide on its side of x = 0, on a block of 100 x 100 mm.
Point(1) = {0, 0, 0}; Point(2) = {0, -100, 0}; Point(3) = {100, -100, 0}; Point(4) = {100, 0, 0}; Point(5) = {5, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0}; Point(12) = {5, 0, 0}; Point(13) = {5, 5, 0}; Point(14) = {0, 5, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11, 12, 13, 14}; Plane Surface(2) = {2};
MeshSize {5, 12} = 0.1; MeshSize {1, 11, 13, 14} = 0.5; MeshSize {2, 3, 4} = 10;
Physical Surface("block") = {1}; Physical Surface("punch") = {2};
Physical Curve("face") = {11}; Physical Curve("ground") = {4, 5};
Physical Curve("top") = {13}; Physical Curve("bottom") = {2}; Physical Curve("axis") = {1, 14};
