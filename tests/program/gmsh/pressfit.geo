// A quarter of a ring pressed into a hub: radii 10 and 20.01, 20 and 40 mm.
Mesh.MeshSizeMax = 1.5;
Point(1) = {0, 0, 0};
Point(2) = {10, 0, 0};    Point(3) = {0, 10, 0};
Point(4) = {20.01, 0, 0}; Point(5) = {0, 20.01, 0};
Point(6) = {20, 0, 0};    Point(7) = {0, 20, 0};
Point(8) = {40, 0, 0};    Point(9) = {0, 40, 0};
Circle(1) = {2, 1, 3}; Line(2) = {3, 5}; Circle(3) = {4, 1, 5}; Line(4) = {2, 4};
Circle(5) = {6, 1, 7}; Line(6) = {7, 9}; Circle(7) = {8, 1, 9}; Line(8) = {6, 8};
Curve Loop(1) = {4, 3, -2, -1}; Plane Surface(1) = {1};
Curve Loop(2) = {8, 7, -6, -5}; Plane Surface(2) = {2};
Transfinite Curve {3, 5} = 40;
Physical Surface("ring") = {1};
Physical Surface("hub") = {2};
Physical Curve("shaft") = {3};
Physical Curve("bore") = {5};
Physical Curve("on_x") = {4, 8};
Physical Curve("on_y") = {2, 6};
