"""The package beside scikit-fem, an independent code, and what it does with scenes and errors."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import meshio
import numpy as np
import pytest
import scipy.sparse as sparse
import skfem
from scipy.sparse.linalg import spsolve
from skfem.models.elasticity import lame_parameters, linear_elasticity

import plane_contact

ROOT = Path(__file__).parents[3]
LOWER, UPPER = (100.0, 0.25), (200.0, 0.3)
PRESSURE = 1.5


def block(bottom: float) -> skfem.MeshTri:
    return skfem.MeshTri.init_tensor(np.linspace(0, 4, 17), np.linspace(bottom, bottom + 1, 5))


def scene(mesh: skfem.MeshTri, bodies: dict, top: float, contact: bool) -> dict:
    """A scene whose mesh is one of meshio: pressed on its top between x = 1 and 3, held below."""
    middle = mesh.p[:, mesh.facets].mean(axis=1)
    lines = {
        "bottom": np.isclose(middle[1], -1),
        "pressed": np.isclose(middle[1], top) & (abs(middle[0] - 2) < 1),
    }
    centre = mesh.p[:, mesh.t].mean(axis=1)
    if contact:
        on = np.isclose(middle[1], 0) & np.isin(np.arange(mesh.nfacets), mesh.boundary_facets())
        of = np.isin(mesh.facets[0], mesh.t[:, centre[1] > 0])
        lines |= {"face": on & of, "target": on & ~of}
    sets = {name: [np.flatnonzero(is_in), None] for name, is_in in lines.items()}
    for name, (low, high) in bodies.items():
        sets[name] = [None, np.flatnonzero((centre[1] > low) & (centre[1] < high))]
    # scikit-fem sorts the nodes of a triangle; here they run counter-clockwise.
    (x1, x2, x3), (y1, y2, y3) = mesh.p[:, mesh.t]
    turned = (x2 - x1) * (y3 - y1) < (x3 - x1) * (y2 - y1)
    triangles = np.where(turned, mesh.t[[0, 2, 1]], mesh.t)
    cells = [("line", mesh.facets.T), ("triangle", triangles.T)]
    description = {
        "mesh": meshio.Mesh(mesh.p.T, cells, cell_sets=sets),
        "plane": "strain",
        "materials": {
            name: dict(zip(("E", "nu"), UPPER if name == "upper" else LOWER)) for name in bodies
        },
        "restraints": [{"on": "bottom", "fix": ["x", "y"]}],
        "loads": [{"on": "pressed", "pressure": PRESSURE}],
    }
    if contact:
        description["contact"] = {"cnt": "face", "trg": "target", "c_tll": 1e-6, "friction": 0}
        description["restraints"].append({"at": [2.0, top], "fix": ["x"]})
    return description


def system(mesh: skfem.MeshTri, top: float):
    """The stiffness matrix and the load of scikit-fem, with degrees of freedom node by node."""
    centre = mesh.p[:, mesh.t].mean(axis=1)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP1()))
    parts = []
    for (e, nu), elements in [(LOWER, centre[1] < 0), (UPPER, centre[1] > 0)]:
        part = skfem.Basis(mesh, basis.elem, elements=np.flatnonzero(elements))
        if elements.any():
            parts.append(linear_elasticity(*lame_parameters(e, nu)).assemble(part))
    pressed = mesh.facets_satisfying(lambda x: np.isclose(x[1], top) & (abs(x[0] - 2) < 1))
    facets = skfem.FacetBasis(mesh, basis.elem, facets=pressed)
    load = skfem.LinearForm(lambda v, w: -PRESSURE * v[1]).assemble(facets)
    return basis, sum(parts), load


def test_a_block_as_scikit_fem_has_it():
    mesh = block(-1)
    basis, matrix, load = system(mesh, 0)
    held = basis.get_dofs(lambda x: np.isclose(x[1], -1)).all()
    u = skfem.solve(*skfem.condense(matrix, load, D=held))[basis.nodal_dofs].T
    compared = plane_contact.compare(scene(mesh, {"lower": (-1, 0)}, 0, False), u)["distance"]
    assert compared["displacement_relative"] < 1e-11
    assert compared["energy_relative"] < 1e-11


def test_contact_that_recedes_as_scikit_fem_has_it(plane_contact_reference):
    lower, upper = block(-1), block(0)
    mesh = skfem.MeshTri(
        np.hstack([lower.p, upper.p]), np.hstack([lower.t, upper.t + lower.nvertices])
    )
    basis, matrix, load = system(mesh, 1)
    dofs = basis.nodal_dofs
    node = lambda x, y, of: np.flatnonzero(np.isclose(mesh.p[0], x) & np.isclose(mesh.p[1], y) & of)[0]
    is_lower = np.arange(mesh.nvertices) < lower.nvertices
    pairs = [(node(x, 0, ~is_lower), node(x, 0, is_lower)) for x in np.linspace(0, 4, 17)]
    held = np.append(dofs[:, np.isclose(mesh.p[1], -1)].ravel(), dofs[0, node(2, 1, ~is_lower)])
    free = np.setdiff1d(np.arange(basis.N), held)
    above, below = dofs[1, [a for a, _ in pairs]], dofs[1, [b for _, b in pairs]]
    closed = np.ones(len(pairs), dtype=bool)
    for _ in range(20):
        rows = np.arange(closed.sum())
        ones = np.ones(len(rows))
        ties = sparse.coo_matrix((ones, (rows, above[closed])), (len(rows), basis.N)).tocsr()
        ties -= sparse.coo_matrix((ones, (rows, below[closed])), (len(rows), basis.N)).tocsr()
        both = sparse.bmat([[matrix[free][:, free], ties[:, free].T], [ties[:, free], None]])
        solved = spsolve(both.tocsc(), np.append(load[free], np.zeros(len(rows))))
        u = np.zeros(basis.N)
        u[free] = solved[: len(free)]
        force = np.zeros(len(pairs))
        force[closed] = -solved[len(free) :]
        wanted = np.where(closed, force > 0, u[above] < u[below])
        if (wanted == closed).all():
            break
        closed = wanted
    assert 3 <= closed.sum() < len(pairs), "the blocks part at their ends"
    described = scene(mesh, {"lower": (-1, 0), "upper": (0, 1)}, 1, True)
    compared = plane_contact.compare(described, u[dofs].T, geometry="initial")["distance"]
    assert compared["displacement_relative"] < 1e-9
    assert compared["energy_relative"] < 1e-9
    contact = plane_contact_reference(described)["contact"]
    order = np.argsort(mesh.p[0, contact["node"] - 1])
    np.testing.assert_allclose(contact["force"][order], force, atol=1e-9 * force.max())


def test_compare_is_the_distance_that_the_program_prints():
    tied = plane_contact.solve("fig1", variant="tied")
    compared = plane_contact.compare("fig1", tied["u"], friction=0, geometry="initial")["distance"]
    for name in ["displacement", "displacement_relative", "energy_relative"]:
        assert compared[name] == pytest.approx(tied["distance"][name], rel=1e-9)


def test_a_scene_is_a_path_a_name_or_a_dict_with_arrays(tmp_path):
    path = ROOT / "golden/fig1/scene.json"
    described = json.loads(path.read_text(encoding="utf-8"))
    described["node"] = np.array(described["node"])
    results = [plane_contact.solve(of)["u"] for of in ["fig1", path, str(path), described]]
    for u in results[1:]:
        assert (u == results[0]).all()


def test_a_mesh_that_gmsh_wrote_is_the_same_through_meshio():
    folder = ROOT / "golden/strand"
    described = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    described["mesh"] = meshio.read(folder / "strand.msh")
    through, own = (plane_contact.reference(of)["u"] for of in [described, "strand"])
    np.testing.assert_allclose(through, own, atol=1e-12 * abs(own).max())


def test_errors_have_a_type_for_each_exit_status(tmp_path):
    with pytest.raises(plane_contact.InputError, match="cannot be read") as caught:
        plane_contact.solve("nowhere")
    assert caught.value.result["failure"]["where"] == "nowhere"
    with pytest.raises(plane_contact.AlgorithmFails, match="line 18"):
        plane_contact.solve("fig1", reading={"R4": "eager"})
    with pytest.raises(plane_contact.InputError, match="friction"):
        plane_contact.record("fig1", tmp_path / "s.json", friction=-1)
    with pytest.raises(plane_contact.InputError, match="10 of the scene's 13 nodes"):
        plane_contact.compare("fig1", np.zeros((3, 2)))
    described = json.loads((ROOT / "golden/fig1/scene.json").read_text(encoding="utf-8"))
    described["restraints"] = described["restraints"][:1]
    described["loads"] = [{"on": 21, "traction": [0.0, 6.3]}]
    with pytest.raises(plane_contact.NoEquilibrium):
        plane_contact.reference(described)


def test_a_snapshot_is_recorded_and_verified(tmp_path):
    path = tmp_path / "fig1.snapshot.json"
    recorded = plane_contact.record("fig1", path, variant=["tied", "stepped"])
    assert list(recorded["runs"]) == ["tied", "stepped"]
    assert plane_contact.verify(path)["same"] is True
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace('"iterations": 20', '"iterations": 19', 1), encoding="utf-8")
    with pytest.raises(plane_contact.Differs, match="fig1.snapshot.json") as caught:
        plane_contact.verify(path)
    assert caught.value.result["same"] is False


def test_snapshots_are_verified_from_lists_too(tmp_path):
    paths = [tmp_path / "a.json", tmp_path / "b.json"]
    for path in paths:
        plane_contact.record("fig1", path, variant="tied")
    for files in [paths], [map(str, paths)], [paths[0], [paths[1]]]:
        assert len(plane_contact.verify(*files)["files"]["file"]) == 2


def test_masked_values_are_refused():
    solved = plane_contact.solve("fig1")["u"]
    masked = np.ma.masked_array(solved, mask=True)
    with pytest.raises(ValueError, match="u has masked values"):
        plane_contact.compare("fig1", masked)
    with pytest.raises(ValueError, match="complex"):
        plane_contact.compare("fig1", solved + 1j)
    with pytest.raises(TypeError, match="no number, text, list or dict"):
        plane_contact.solve({"title": object()})
    unmasked = np.ma.masked_array(solved)
    assert plane_contact.compare("fig1", unmasked, variant="stepped") is not None
    folder = ROOT / "golden/strand"
    described = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    mesh = described["mesh"] = meshio.read(folder / "strand.msh")
    mesh.points = np.ma.masked_array(mesh.points, mask=mesh.points > 1)
    with pytest.raises(ValueError, match="mesh.points has masked values"):
        plane_contact.solve(described)


def test_help_is_no_option(tmp_path):
    for value in [True, False]:
        with pytest.raises(plane_contact.InputError, match="help"):
            plane_contact.solve("fig1", help=value)
    with pytest.raises(plane_contact.InputError, match="help"):
        plane_contact.record("fig1", tmp_path / "s.json", help=True)


def test_rows_are_nodes_in_the_order_of_the_mesh(tmp_path):
    """A mesh file counts by its numbers, a mesh of meshio by its rows."""
    folder = ROOT / "golden/strand"
    described = json.loads((folder / "scene.json").read_text(encoding="utf-8"))
    mesh = meshio.read(folder / "strand.msh")
    own = plane_contact.reference({**described, "mesh": mesh})["u"]
    order = np.arange(len(mesh.points))[::-1]
    cells = [(block.type, len(order) - 1 - block.data) for block in mesh.cells]
    turned = meshio.Mesh(mesh.points[order], cells, cell_data=mesh.cell_data, field_data=mesh.field_data)
    u = plane_contact.reference({**described, "mesh": turned})["u"]
    np.testing.assert_allclose(u[order], own, atol=1e-10 * abs(own).max())


def test_the_lines_that_a_mesh_without_tags_is_refused_with_help(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    whole = meshio.read(ROOT / "golden/strand/strand.msh")
    mesh = meshio.Mesh(whole.points, whole.cells)
    mesh.write("part.msh", file_format="gmsh22")
    new = [plane_contact.program(), "scene", "new", "part.msh"]
    refused = subprocess.run(new, capture_output=True, encoding="utf-8", env={**os.environ, "COLUMNS": "80"})
    lines = [line.strip() for line in refused.stderr.splitlines() if line.startswith("  mesh.")]
    assert refused.returncode == 2 and len(lines) == 3
    exec("\n".join(lines), {"mesh": mesh, "np": np})
    assert subprocess.run(new).returncode == 0
    scene = json.loads(Path("part.json").read_text(encoding="utf-8"))
    assert list(scene["materials"]) == ["body"] and scene["restraints"][0]["on"] == "bottom"


def test_the_example_of_the_front_page_runs(capsys):
    page = (ROOT / "README.md").read_text(encoding="utf-8")
    exec(page.split("```python\n")[1].split("```")[0], {})
    error, displacement = map(float, capsys.readouterr().out.split())
    distance = plane_contact.solve("fig1", variant="tied")["distance_from_equilibrium"]
    assert error == pytest.approx(distance["energy_relative"], rel=1e-9)
    assert displacement == pytest.approx(distance["displacement"], rel=1e-9)


def test_it_is_typed():
    assert (Path(plane_contact.__file__).parent / "py.typed").exists()
    source = ROOT / "src/python/plane_contact"
    mypy = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, str(source)]
    checked = subprocess.run(mypy, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout


def plate(inner: str = "triangle", tag: int = 2, named: bool = True) -> dict:
    """A plate of 3 x 3 squares, held below and pressed above; the square in the middle has its own kind and tag."""
    points = np.array([[i, j, 0.0] for j in range(4) for i in range(4)])
    corners = np.array([[n, n + 1, n + 5, n + 4] for n in (0, 1, 2, 4, 6, 8, 9, 10)])
    halves = lambda squares: np.vstack([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])
    middle = np.array([[5, 6, 10, 9]])
    cells = [
        ("line", [[0, 1], [1, 2], [2, 3]]),
        ("line", [[12, 13], [13, 14], [14, 15]]),
        ("line", [[4, 0], [8, 4], [12, 8]]),
        ("triangle", halves(corners)),
        (inner, middle if inner == "quad" else halves(middle)),
    ]
    tags = [np.full(len(data), tag) for (_, data), tag in zip(cells, [1, 4, 3, 2, tag])]
    names = {"bottom": [1, 1], "top": [4, 1], "left": [3, 1], "body": [2, 2]} if named else {}
    mesh = meshio.Mesh(points, cells, cell_data={"gmsh:physical": tags}, field_data=names)
    return {
        "mesh": mesh,
        "plane": "stress",
        "materials": {"body" if named else "2": {"E": 1000, "nu": 0.3}},
        "restraints": [{"on": 1, "fix": ["x", "y"]}],
        "loads": [{"on": 4, "pressure": 1.0}],
    }


def as_file(scene: dict, folder: Path) -> dict:
    """The same scene, its mesh written by meshio."""
    scene["mesh"].cell_data["gmsh:geometrical"] = scene["mesh"].cell_data["gmsh:physical"]
    scene["mesh"].write(folder / "plate.msh", file_format="gmsh22", binary=False)
    return {**scene, "mesh": "plate.msh"}


@pytest.mark.parametrize("load", [3, 4, "left", "top"])
@pytest.mark.parametrize("named", [True, False])
def test_a_mesh_of_meshio_has_the_tags_of_its_file(load, named, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = plate(named=named)
    scene["loads"][0]["on"] = load
    if not named and isinstance(load, str):
        for refused in (scene, as_file(scene, tmp_path)):
            with pytest.raises(plane_contact.InputError, match=load):
                plane_contact.solve(refused)
        return
    through, own = (plane_contact.solve(of) for of in (scene, as_file(scene, tmp_path)))
    assert len(through["elements"]["von_mises_stress"]) == 18
    np.testing.assert_array_equal(through["u"], own["u"])


@pytest.mark.parametrize("inner, tag, words", [
    ("quad", 2, "quad"), ("triangle", 9, "has no material"), ("triangle", 0, "has no material"), ("line3", 2, "line3"),
])  # fmt: skip
def test_no_cell_of_a_mesh_is_left_out(inner, tag, words):
    scene = plate(inner if inner != "line3" else "triangle", tag)
    if inner == "line3":
        scene["mesh"].cells.append(meshio.CellBlock("line3", [[0, 1, 2]]))
        scene["mesh"].cell_data["gmsh:physical"].append(np.array([1]))
    with pytest.raises((plane_contact.InputError, ValueError), match=words):
        plane_contact.solve(scene)


def test_cell_sets_are_groups_beside_tags():
    scene = plate()
    whole = plane_contact.solve(scene)["u"]
    mesh = scene["mesh"]
    mesh.cell_sets = {"pressed": [None, np.array([0, 1, 2]), None, None, None]}
    scene["loads"] = [{"on": "pressed", "pressure": 1.0}]
    np.testing.assert_array_equal(plane_contact.solve(scene)["u"], whole)
    del mesh.cell_data["gmsh:physical"]
    everything = [None, None, None, np.arange(16), np.array([0])]
    mesh.cell_sets |= {"body": everything, "bottom": [np.arange(3), None, None, None, None]}
    scene["restraints"][0]["on"] = "bottom"
    with pytest.raises(plane_contact.InputError, match="has no material"):
        plane_contact.solve(scene)
    everything[4] = np.array([True, True])
    np.testing.assert_array_equal(plane_contact.solve(scene)["u"], whole)
    mesh.cell_sets["two\nlines"] = everything
    with pytest.raises(ValueError, match="line break"):
        plane_contact.solve(scene)


def test_paths_are_those_of_the_caller(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = plate()
    plane_contact.solve(scene, out=Path("results"))
    assert Path("results/result.json").exists()
    plane_contact.record(scene, "plate.json")
    assert plane_contact.verify("plate.json")["same"] is True
    with pytest.raises(plane_contact.InputError, match="here/ccx"):
        plane_contact._json(["compare"], scene, {"ccx": "here/ccx"})
    for command in ("solve", "audit", "compare", "snapshot record"):
        help = [plane_contact.program(), *command.split(), "--help"]
        text = subprocess.run(help, capture_output=True, encoding="utf-8").stdout
        options = re.findall(r"--([a-z-]+) <[A-Z|]*(?:FILE|DIR|FIELD|PROGRAM)[A-Z|]*>", text)
        assert {option.replace("-", "_") for option in options} <= plane_contact._PATHS, command


def test_the_field_of_the_guide_s_example_is_one_of_meshio(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    scene = plate()
    u = plane_contact.solve(scene)["u"]
    described = {**as_file(scene, tmp_path), "contact": None}
    Path("scene.json").write_text(json.dumps({k: v for k, v in described.items() if v}), encoding="utf-8")
    page = (ROOT / "src/guide/scenes.md").read_text(encoding="utf-8")
    example = page.split("```python\n")[1].split("```")[0]
    assert len(example.splitlines()) == 4
    mesh = meshio.Mesh(scene["mesh"].points, scene["mesh"].cells, {"displacement": np.column_stack([u, 0 * u[:, 0]])})
    for factor, said in [(1.0, "True"), (1.1, "False")]:
        mesh.point_data["displacement"] *= factor
        mesh.write("field.vtu")
        exec(example, {})
        same, energy = capsys.readouterr().out.split()
        assert same == said and float(energy) == pytest.approx(factor - 1, abs=1e-9)
    order = np.random.default_rng(1).permutation(len(u))
    compared = plane_contact.compare("scene.json", u[order], points=mesh.points[order])
    assert compared["is_same"] and compared["distance"]["energy_relative"] < 1e-9
    assert not plane_contact.compare("scene.json", u[order])["is_same"]
    with pytest.raises(ValueError, match="points 15"):
        plane_contact.compare("scene.json", u, points=mesh.points[1:])


def test_a_third_column_counts():
    u = plane_contact.solve("fig1", variant="tied")["u"]
    flat, raised = (np.column_stack([u, np.full(len(u), z)]) for z in (0.0, 5.0))
    same = [plane_contact.compare("fig1", of, variant="tied")["is_same"] for of in (u, flat)]
    assert same == [True, True]
    with pytest.raises(plane_contact.InputError, match="moves along z by 5"):
        plane_contact.compare("fig1", raised, variant="tied")


def test_a_difference_is_told_as_verify_tells_it(tmp_path):
    scene, path = tmp_path / "s/scene.json", tmp_path / "s/a.json"
    subprocess.run([plane_contact.program(), "-q", "scene", "copy", "fig1", "--out", str(scene.parent)], check=True)
    plane_contact.record(scene, path, only="u")
    scene.write_text(scene.read_text(encoding="utf-8").replace("30000.0", "31000.0"), encoding="utf-8")
    verify = [plane_contact.program(), "snapshot", "verify", str(path)]
    printed = subprocess.run(verify, capture_output=True, encoding="utf-8", env={**os.environ, "COLUMNS": "100"})
    test = tmp_path / "test_it.py"
    test.write_text(f"import plane_contact\n\ndef test():\n    plane_contact.verify({str(path)!r})\n", encoding="utf-8")
    pytest_ = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-c", os.devnull, str(test)]
    shown = subprocess.run(pytest_, capture_output=True, encoding="utf-8", cwd=tmp_path).stdout
    assert "materials" in printed.stdout and "31000" in printed.stdout
    with pytest.raises(plane_contact.Differs) as caught:
        plane_contact.verify(path)
    assert str(caught.value).strip() == printed.stdout.strip()
    assert "31000" in shown and "_json" not in shown and "subprocess" not in shown


def test_every_function_has_an_example():
    for name, function in vars(plane_contact).items():
        if not name.startswith("_") and getattr(function, "__module__", None) == "plane_contact":
            assert isinstance(function, type) or ">>> " in function.__doc__, name
