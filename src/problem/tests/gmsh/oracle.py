"""Prints what meshio reads in each mesh beside it, in a canonical text that src/problem/tests/gmsh.rs compares with.

    pip install meshio==5.3.5
    python3 src/problem/tests/gmsh/oracle.py > src/problem/tests/gmsh/expected.txt

Per file: `node <row> <x> <y> <z>` for each node, `<name>: <kind> <rows of its nodes>` for each element of each physical
group; the lines of a file sorted. Rows count from 1 in ascending order of the file's own node numbers.
"""

from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import meshio

DIM = {"vertex": 0, "line": 1, "triangle": 2}


def groups(mesh):
    """Yields (name, kind, node rows from 0) of every element of every physical group."""
    names = {(dim, tag): name for name, (tag, dim) in mesh.field_data.items()}
    for i, block in enumerate(mesh.cells):
        for name in mesh.field_data:
            if name in mesh.cell_sets:  # MSH 4.1: a cell may be in many groups
                rows = mesh.cell_sets[name][i]
            else:  # MSH 2.2: one group to a cell
                tags = mesh.cell_data["gmsh:physical"][i]
                rows = [r for r, tag in enumerate(tags) if names.get((DIM[block.type], tag)) == name]
            for row in rows:
                yield name, block.type, block.data[row]


def canonical(mesh):
    """The sorted lines of one mesh."""
    lines = [f"node {i} " + " ".join(f"{x:.12f}" for x in xyz) for i, xyz in enumerate(mesh.points, 1)]
    lines += [f"{name}: {kind} " + " ".join(str(n + 1) for n in rows) for name, kind, rows in groups(mesh)]
    return sorted(lines)


def read(path):
    """Reads a mesh; meshio prints an empty line, which is kept from the output."""
    with redirect_stdout(StringIO()):
        return meshio.read(path)


def main():
    print(f"# What meshio {meshio.__version__} reads; made by src/problem/tests/gmsh/oracle.py, not by hand.")
    for path in sorted(Path(__file__).parent.glob("*.msh")):
        print(f"\nfile {path.name}")
        print("\n".join(canonical(read(path))))


if __name__ == "__main__":
    main()
