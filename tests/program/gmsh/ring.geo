// A quarter of a thin ring, radii 19 and 21 mm, under a plate.
Mesh.MeshSizeMax = 0.25;
Point(1) = {0, 0, 0};
Point(2) = {19, 0, 0}; Point(3) = {0, 19, 0}; Point(4) = {21, 0, 0}; Point(5) = {0, 21, 0};
Circle(1) = {2, 1, 3}; Line(2) = {3, 5}; Circle(3) = {4, 1, 5}; Line(4) = {2, 4};
Curve Loop(1) = {4, 3, -2, -1}; Plane Surface(1) = {1};
Point(11) = {0, 21, 0}; Point(12) = {10, 21, 0}; Point(13) = {10, 24, 0}; Point(14) = {0, 24, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11, 12, 13, 14}; Plane Surface(2) = {2};
Physical Surface("ring") = {1}; Physical Surface("plate") = {2};
Physical Curve("outside") = {3}; Physical Curve("face") = {11}; Physical Curve("top") = {13};
Physical Curve("on_x") = {4}; Physical Curve("on_y") = {2, 14};
