"""A mesh of meshio as a file of Gmsh, with its named groups."""

from typing import Any

import numpy as np

#: What the program reads: Gmsh's number of the kind, and its dimension.
_KINDS = {"vertex": (15, 0), "line": (1, 1), "triangle": (2, 2)}


def whole(values: Any, name: str) -> Any:
    """Returns values as they are. Raises ValueError where some are masked: they stand for no number."""
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked values: give a number for each (np.ma.filled)")
    return values


def write(path: str, mesh: Any) -> None:
    """Writes the vertices, lines and triangles that are in a group, and all triangles."""
    whole(mesh.points, "mesh.points")
    for block in mesh.cells:
        whole(block.data, f"mesh.cells of kind {block.type!r}")
    for name, blocks in mesh.cell_data.items():
        for values in blocks:
            whole(values, f"mesh.cell_data[{name!r}]")
    points = np.zeros((len(mesh.points), 3))
    points[:, : np.shape(mesh.points)[1]] = mesh.points
    tags: dict[tuple[int, str], int] = {}
    elements = []
    for dim, name, kind, nodes in _members(mesh):
        tag = tags.setdefault((dim, name), len(tags) + 1)
        elements.append(f"{kind} 2 {tag} {tag} " + " ".join(str(n + 1) for n in nodes))
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(tags))]
    lines += [f'{dim} {tag} "{name}"' for (dim, name), tag in tags.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{n} {x!r} {y!r} {z!r}" for n, (x, y, z) in enumerate(points.tolist(), 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{n} {element}" for n, element in enumerate(elements, 1)]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["$EndElements", ""]))


def _members(mesh: Any) -> Any:
    """Yields each element of a group: dimension, name of the group, kind and nodes."""
    for name, blocks in _groups(mesh):
        for block, members in zip(mesh.cells, blocks):
            if members is not None and len(members) > 0:
                if block.type not in _KINDS:
                    raise ValueError(f"group {name!r} has elements of kind {block.type!r}")
                kind, dim = _KINDS[block.type]
                for nodes in np.asarray(block.data)[np.asarray(members, dtype=int)]:
                    yield dim, name, kind, nodes


def _groups(mesh: Any) -> Any:
    """Yields the name of each group with its members in each block of cells."""
    named = {name: blocks for name, blocks in mesh.cell_sets.items() if not name.startswith("gmsh:")}
    if named:
        yield from named.items()
        return
    if "gmsh:physical" not in mesh.cell_data:
        raise ValueError("the mesh has no groups: give it cell_sets, or physical groups of Gmsh")
    for name, (tag, dim) in mesh.field_data.items():
        is_of = [_KINDS.get(block.type, (0, -1))[1] == dim for block in mesh.cells]
        physical = zip(is_of, mesh.cell_data["gmsh:physical"])
        yield name, [np.flatnonzero(tags == tag) if here else None for here, tags in physical]
