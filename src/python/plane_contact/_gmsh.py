"""A mesh of meshio as a file of Gmsh, with all its cells and groups."""

from typing import Any

import numpy as np

__tracebackhide__ = True

#: What the program reads: Gmsh's number of the kind, and its dimension.
_KINDS = {"vertex": (15, 0), "line": (1, 1), "triangle": (2, 2)}


def whole(values: Any, name: str) -> Any:
    """Returns values as they are. Raises ValueError where some are masked: they stand for no number."""
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked values: give a number for each (np.ma.filled)")
    return values


def write(path: str, mesh: Any) -> None:
    """Writes all cells in their order; behind them one of several groups stands again for each other of its groups."""
    whole(mesh.points, "mesh.points")
    for block in mesh.cells:
        whole(block.data, f"mesh.cells of kind {block.type!r}")
    for name, blocks in mesh.cell_data.items():
        for values in blocks:
            whole(values, f"mesh.cell_data[{name!r}]")
    points = np.zeros((len(mesh.points), 3))
    points[:, : np.shape(mesh.points)[1]] = mesh.points
    names, elements = _elements(mesh)
    for _, name in names:
        if "\n" in name or "\r" in name:
            raise ValueError(f"group {name!r} has a line break in its name")
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dim} {tag} "{name}"' for (dim, name), tag in names.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{n} {x!r} {y!r} {z!r}" for n, (x, y, z) in enumerate(points.tolist(), 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{n} {element}" for n, element in enumerate(elements, 1)]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["$EndElements", ""]))


def _elements(mesh: Any) -> tuple[dict[tuple[int, str], int], list[str]]:
    """Returns the tags of the named groups by dimension and name, and the cells as elements."""
    physical = mesh.cell_data.get("gmsh:physical")
    geometrical = mesh.cell_data.get("gmsh:geometrical")
    sets = {name: blocks for name, blocks in mesh.cell_sets.items() if not name.startswith("gmsh:")}
    if physical is None and not sets:
        raise ValueError("the mesh has no groups: give it cell_sets, or physical groups of Gmsh")
    own = mesh.field_data.items() if physical is not None else ()
    names = {(int(dim), name): int(tag) for name, (tag, dim) in own}
    last = max(map(abs, [0, *names.values(), *np.concatenate([[], *(physical or [])]).astype(int)]))
    elements, again = [], []
    for k, block in enumerate(mesh.cells):
        if len(block.data) == 0:
            continue
        if block.type not in _KINDS:
            raise ValueError(f"the mesh has cells of kind {block.type!r}, expected vertex, line or triangle")
        kind, dim = _KINDS[block.type]
        tags: list[list[int]] = [[] for _ in block.data]
        if physical is not None:
            tags = [[int(tag)] if tag else [] for tag in physical[k]]
        for name, blocks in sets.items():
            if blocks[k] is not None and len(blocks[k]) > 0:
                tag = names.setdefault((dim, name), last + 1)
                last = max(last, tag)
                for cell in np.arange(len(tags))[blocks[k]]:
                    tags[cell] += [] if tag in tags[cell] else [tag]
        for cell, nodes in enumerate(block.data):
            corners = " ".join(str(n + 1) for n in nodes)
            of = tags[cell] or [0]
            surface = of[0] if geometrical is None else int(geometrical[k][cell])
            first, *others = [f"{kind} 2 {tag} {surface} {corners}" for tag in of]
            elements.append(first)
            again += others
    return names, elements + again
