"""Reads out/fields.vtu by meshio, and by pyvista (which is VTK) where it is installed, and compares what each
finds with out/result.json.
"""
import importlib.util
import json

import meshio
import numpy as np

FILE = "out/fields.vtu"
result = json.load(open("out/result.json", encoding="utf-8"))
nodes = np.array(result["nodes"])
expected = {
    "points": nodes,
    "corners": np.array([row["nodes"] for row in result["elements"]]) - 1,
    "displacement": np.array(result["u"]),
    "reaction": np.array(result["reaction"]),
    "von_mises_stress": np.array([row["von_mises_stress"] for row in result["elements"]]),
}


def check(reader, found):
    for name, values in found.items():
        values, wanted = np.asarray(values), expected[name]
        if name in ("points", "displacement", "reaction"):
            assert not values[:, 2].any(), (reader, name)
            values = values[:, :2]
        assert np.array_equal(values.reshape(wanted.shape), wanted), (reader, name)


mesh = meshio.read(FILE)
check("meshio", {
    "points": mesh.points,
    "corners": mesh.cells_dict["triangle"],
    "displacement": mesh.point_data["displacement"],
    "reaction": mesh.point_data["reaction"],
    "von_mises_stress": mesh.cell_data["von_mises_stress"][0],
})
assert bytes(mesh.field_data["scene"].astype("uint8")).decode() == result["scene"]

if importlib.util.find_spec("pyvista"):
    import pyvista

    mesh = pyvista.read(FILE)
    check("pyvista", {
        "points": mesh.points,
        "corners": mesh.cells.reshape(-1, 4)[:, 1:],
        "displacement": mesh.point_data["displacement"],
        "von_mises_stress": mesh.cell_data["von_mises_stress"],
    })
    assert bytes(mesh.field_data["scene"]).decode() == result["scene"]
