// Half of two cylinders of radius 10 mm, one upon the other: x = 0 is a plane of symmetry. Fine where they touch.
Point(1) = {0, 0, 0}; Point(2) = {0, 10, 0}; Point(3) = {10, 10, 0};
Circle(1) = {1, 2, 3}; Line(2) = {3, 2}; Line(3) = {2, 1};
Point(4) = {0, 0, 0}; Point(5) = {0, -10, 0}; Point(6) = {10, -10, 0};
Circle(4) = {4, 5, 6}; Line(5) = {6, 5}; Line(6) = {5, 4};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Curve Loop(2) = {-4, -6, -5}; Plane Surface(2) = {2};
Field[1] = Distance; Field[1].PointsList = {1};
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = 0.02; Field[2].SizeMax = 1;
Field[2].DistMin = 0.6; Field[2].DistMax = 8;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Physical Surface("upper") = {1}; Physical Surface("lower") = {2};
Physical Curve("upper_arc") = {1}; Physical Curve("lower_arc") = {4};
Physical Curve("top") = {2}; Physical Curve("bottom") = {5}; Physical Curve("axis") = {3, 6};
