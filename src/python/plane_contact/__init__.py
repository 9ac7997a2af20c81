"""Plane contact by finite elements: the program plane-contact, called from Python.

A scene is a path, the name of a scene of the program, or a dict as a scene file has it; there
``"mesh"`` may be a mesh of meshio, and lists may be arrays. A result is what the program prints as
JSON: lists of numbers are numpy arrays, with nan for null, and a list of objects is a dict of its
columns. Options are those of the command, with ``_`` for ``-``.

Row k of what nodes have is node k + 1: of a mesh of meshio the row k of ``mesh.points``, of a mesh
file the nodes by ascending number, which ``meshio.read`` leaves in the order of the file.

>>> import plane_contact
>>> result = plane_contact.reference("fig1")
>>> result["u"].shape
(13, 2)
>>> bool(result["elements"]["von_mises_stress"].max() > 12)
True
>>> plane_contact.compare("fig1", result["u"], friction=0, geometry="initial")["is_same"]
True
"""

import json
import os
import shutil
import subprocess
import sysconfig
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np

from ._gmsh import whole, write

File = Union[str, "os.PathLike[str]"]
Scene = Union[File, Mapping[str, Any]]
Result = dict[str, Any]

#: pytest shows the caller's line, and leaves out those of this module.
__tracebackhide__ = True

#: The options that are paths: those of the caller, wherever the program runs.
_PATHS = {"out", "csv", "with", "c_cnt", "km", "ccx"}


class Error(Exception):
    """The program ended with another exit status than 0."""

    def __init__(self, message: str, result: Optional[Result] = None):
        super().__init__(message)
        #: What the program printed as JSON, where it did.
        self.result = result


class InputError(Error):
    """The input is at fault; the message says what, where, and how to fix it."""


class AlgorithmFails(Error):
    """The published algorithm fails as printed."""


class NoEquilibrium(Error):
    """No equilibrium was found, or more than one."""


class Differs(Error):
    """What was compared differs, or nothing could be compared."""


_ERRORS = {1: Differs, 2: InputError, 3: AlgorithmFails, 4: NoEquilibrium}


def solve(scene: Scene = "strand", **options: Any) -> Result:
    """Runs the scene, as ``plane-contact solve`` does.

    >>> solve("fig1", variant="tied", reading={"R5": "node_n"})["coupling"]
    'nts'
    """
    # Large meshes have their fields too.
    return _json(["solve"], scene, {"fields": True, **options})


def reference(scene: Scene = "strand", **options: Any) -> Result:
    """Returns the reference solution: without friction, in small displacements, which is unique.

    >>> reference("fig1")["variant"]
    'unilateral'
    """
    return solve(scene, reference=True, **options)


def audit(scene: Scene = "strand", **options: Any) -> Result:
    """Judges what the paper claims on a scene, as ``plane-contact audit`` does.

    >>> judged = audit("two-blocks")["claims"]
    >>> judged["id"][:2], judged["verdict"][:2]
    (['P1', 'P2'], ['true', 'true only if'])
    """
    return _json(["audit"], scene, options)


def compare(scene: Scene, u: Any, points: Any = None, **options: Any) -> Result:
    """Returns how far displacements ``u``, a row for each node, are from the contact solution.

    Row k is that of node k + 1, or with ``points``, as a mesh of meshio has them, that of the node there.
    As ``plane-contact compare --with FIELD`` does, also where they differ: ``distance`` has the largest
    difference of a node and the distance in the energy norm, ``contact`` what the displacements imply of
    contact. With ``friction=0, geometry="initial"`` it is the distance from the reference solution.

    >>> moved = 1.01 * reference("fig1")["u"]
    >>> found = compare("fig1", moved, friction=0, geometry="initial")
    >>> found["is_same"], round(float(found["distance"]["energy_relative"]), 4)
    (False, 0.01)
    """
    u = _rows(u, "u")
    places = np.arange(1, len(u) + 1)[:, None] if points is None else _rows(points, "points")[:, :2]
    if len(places) != len(u):
        raise ValueError(f"u has {len(u)} rows, points {len(places)}")
    columns = (["node"] if points is None else ["x", "y"]) + ["ux", "uy", "uz"][: u.shape[1]]
    lines = (",".join(map(repr, [*at, *by])) for at, by in zip(places.tolist(), u.tolist()))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "field.csv")
        Path(path).write_text("\n".join([",".join(columns), *lines, ""]), encoding="utf-8")
        try:
            return _json(["compare"], scene, {**options, "with": path})
        except Differs as differs:
            assert differs.result is not None
            return differs.result


def record(scene: Scene, out: File, **options: Any) -> Result:
    """Records a snapshot of what the scene gives in the file ``out``, and returns it.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     record("fig1", Path(folder) / "fig1.json", tolerance=1e-3)["summary"]["stepped"]["end"]
    'exit status 0, 20 iterations; 4 nodes in contact: 5, 6, 7, 9'
    """
    _run(["snapshot", "record"], scene, {**options, "out": out})
    recorded: Result = arrays(json.loads(Path(out).read_text(encoding="utf-8")))
    return recorded


def verify(*files: Union[File, Iterable[File]], scene: Optional[File] = None) -> Result:
    """Runs again what snapshots recorded, files or lists of them. Raises `Differs`, whose ``result`` says what differs.

    >>> with tempfile.TemporaryDirectory() as folder:
    ...     recorded = record("fig1", Path(folder) / "fig1.json")
    ...     verify(Path(folder) / "fig1.json")["same"]
    True
    """
    single = (str, os.PathLike)
    lists = [[entry] if isinstance(entry, single) else list(entry) for entry in files]
    names = [os.fspath(file) for entry in lists for file in entry]
    return _json(["snapshot", "verify"], None, {"scene": scene}, names)


def arrays(value: Any) -> Any:
    """Returns JSON with arrays in place of lists of numbers, and columns in place of lists of objects.

    >>> arrays([{"node": 5, "gap": 0.5}, {"node": 6, "gap": None}])["gap"]
    array([0.5, nan])
    """
    if isinstance(value, dict):
        return {key: arrays(entry) for key, entry in value.items()}
    if not isinstance(value, list):
        return value
    if value and all(isinstance(entry, dict) for entry in value):
        keys = dict.fromkeys(key for entry in value for key in entry)
        return {key: arrays([entry.get(key) for entry in value]) for key in keys}
    try:
        array = np.array(value)
        # None becomes nan.
        array = array.astype(float) if array.dtype == object else array
    except (TypeError, ValueError):
        return [arrays(entry) for entry in value]
    return array if array.dtype.kind in "bif" else [arrays(entry) for entry in value]


def program() -> str:
    """Returns the path of the program: that of this installation, else the one on the PATH.

    >>> Path(program()).stem
    'plane-contact'
    """
    here = sysconfig.get_path("scripts")
    found = shutil.which("plane-contact", path=here) or shutil.which("plane-contact")
    if found is None:
        raise FileNotFoundError("the program plane-contact is neither beside Python nor on the PATH")
    return found


def _json(
    command: list[str], scene: Optional[Scene], options: Mapping[str, Any], files: Iterable[str] = ()
) -> Result:
    result: Result = arrays(json.loads(_run(command, scene, {**options, "json": True}, files)))
    return result


def _run(
    command: list[str], scene: Optional[Scene], options: Mapping[str, Any], files: Iterable[str] = ()
) -> str:
    """Returns what the program prints; a scene that is a dict is given to it on standard input."""
    words = [program(), *command]
    for option, value in options.items():
        if option == "help":
            raise InputError("help is no option here: help(plane_contact), or plane-contact --help")
        if value is not None and value is not False:
            name = "--" + option.replace("_", "-")
            words += [name] if value is True else [f"{name}={_word(option, value)}"]
    words += ["--", *files] if files else []
    with tempfile.TemporaryDirectory() as folder:
        text, place = None, None
        if isinstance(scene, Mapping):
            scene = dict(scene)
            if hasattr(scene.get("mesh"), "cells"):
                write(os.path.join(folder, "mesh.msh"), scene["mesh"])
                scene["mesh"], place = "mesh.msh", folder
            text = json.dumps(scene, default=_plain)
            words.append("-")
        elif scene is not None:
            words += ["--", os.fspath(scene)]
        ran = subprocess.run(words, input=text, capture_output=True, encoding="utf-8", cwd=place)
    if ran.returncode != 0:
        raise _error(ran)
    return ran.stdout


def _rows(values: Any, name: str) -> "np.ndarray[Any, Any]":
    """Returns a row of two or three numbers for each node."""
    if np.iscomplexobj(values):
        raise ValueError(f"{name} is complex, expected real numbers")
    rows = np.asarray(whole(values, name), dtype=float)
    if rows.ndim != 2 or rows.shape[1] not in (2, 3):
        raise ValueError(f"{name} has the shape {rows.shape}, expected a row of two or three for each node")
    return rows


def _plain(value: Any) -> Any:
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    array = np.asarray(whole(value, "the scene"))
    if array.dtype.kind not in "biufUO" or array.shape == () and array.dtype == object:
        raise TypeError(f"{value!r} is no number, text, list or dict, of which a scene is made")
    return array.tolist()


def _word(option: str, value: Any) -> str:
    # A program's name alone is looked for on the PATH.
    if option in _PATHS and (option != "ccx" or os.path.dirname(value)):
        return str(os.path.abspath(value))
    if isinstance(value, Mapping):
        return ",".join(f"{key}={entry}" for key, entry in value.items())
    return ",".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)


def _error(ran: "subprocess.CompletedProcess[str]") -> Error:
    try:
        result = json.loads(ran.stdout)
    except ValueError:
        result = None
    message = ran.stderr.strip() or f"plane-contact ended with {ran.returncode}"
    if result is not None and "failure" in result:
        message = result["failure"]["message"]
    elif ran.returncode == 1 and result is not None:
        message = result.get("text", message)
    return _ERRORS.get(ran.returncode, Error)(message, arrays(result))
