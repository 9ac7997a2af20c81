// A block on a slope of 20 degrees.
Mesh.MeshSizeMax = 4;
t = Tan(20 * Pi / 180);
Point(1) = {0, 0, 0}; Point(2) = {100, 0, 0}; Point(3) = {100, 10 + 100 * t, 0}; Point(4) = {0, 10, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(11) = {30, 10 + 30 * t, 0}; Point(12) = {70, 10 + 70 * t, 0}; Point(13) = {70, 65, 0}; Point(14) = {30, 65, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11, 12, 13, 14}; Plane Surface(2) = {2};
Physical Surface("ground") = {1}; Physical Surface("block") = {2};
Physical Curve("face") = {11}; Physical Curve("slope") = {3}; Physical Curve("top") = {13}; Physical Curve("bottom") = {1};
