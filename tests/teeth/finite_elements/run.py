"""Finite-element gear bodies with one or several teeth: run once, the results kept in the package.

    pip install scikit-fem gmsh meshio
    python tests/teeth/finite_elements/run.py    about two minutes; writes its results

Plane stress, quadratic triangles, E = b = module = 1, bore fixed. A unit force acts on a node of the flank along
the line of action. What is recorded is the displacement along each load's own line of action of

``section``  the cross-section through the loaded point, taken as rigid: its mean displacement and mean turn, which is
             what a Timoshenko beam's displacement stands for (Cowper 1966);
``tip``      the end of the tooth, likewise: the tooth beyond the load carries nothing and moves as a rigid body, so
             nothing of the indentation is in it (only for loads at some distance below the tip);
``centre``   the point where the load's line crosses the tooth's centre line (Weber and Banaschek).

The three differ only in what they call indentation, and show how much of the answer depends on that.
"""

from __future__ import annotations

import itertools
import json
import math
import re
import tempfile
from pathlib import Path

import gmsh
import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementTriP2, ElementVector, MeshTri, MeshTri2, condense
from skfem.helpers import ddot, sym_grad, trace

from gearpair.teeth.spurpair import SpurGear, SpurPair
from gearpair.teeth.tooth_profile import ToothProfile

RESULTS = Path(__file__).parents[3] / "gearpair" / "teeth" / "data" / "finite_elements.json"
NU = 0.3


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    """Points (2, n) of a tooth on the y axis, moved clockwise by an angle: towards the loaded flank's side."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, s], [-s, c]]) @ points


def outline(tooth: ToothProfile, rolls: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
    """Right-hand fillet, and the involute cut at the loaded points: pieces of (2, n) points, root to tip."""
    y, h, _, _ = tooth.fillet(np.linspace(0, 1, 60))
    gear = tooth.gear
    tip = math.sqrt((gear.tip_circle_mm / gear.base_radius_mm) ** 2 - 1)
    cuts = [tooth.first_roll, *[t for t in np.sort(rolls) if tooth.first_roll + 1e-9 < t < tip - 1e-9], tip]
    pieces = []
    for left, right in itertools.pairwise(cuts):
        yy, hh, _, _ = tooth.involute(np.linspace(left, right, 12))
        pieces.append(np.array([hh, yy]))
    return np.array([h, y]), pieces


def build_mesh(gear: SpurGear, angles: list[float], watched: int, rolls: np.ndarray, size: float) -> MeshTri2:
    """Ring with teeth at the given angles; the first few have nodes at the loads and where they cross the centre."""
    tooth = ToothProfile(gear)
    m = gear.module_mm
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    geo, mesh = gmsh.model.occ, gmsh.model.mesh
    centre = geo.addPoint(0, 0, 0)

    def point(xy: np.ndarray) -> int:
        return geo.addPoint(float(xy[0]), float(xy[1]), 0)

    def spline(points: np.ndarray, first: int, last: int) -> int:
        return geo.addSpline([first, *[point(p) for p in points.T[1:-1]], last])

    fillet, pieces = outline(tooth, rolls)
    mirror = np.diag([-1.0, 1.0])
    curves, fine, feet, inner = [], [], [], []
    for angle in sorted(angles):
        # clockwise: from the left foot over the tip to the right foot
        nodes = [point(turned(p[:, None], angle)[:, 0]) for p in (mirror @ fillet[:, 0], mirror @ fillet[:, -1])]
        left_foot, last = nodes
        flank = [spline(turned(mirror @ fillet, angle), left_foot, last)]
        for piece in pieces:
            nxt = point(turned((mirror @ piece)[:, -1:], angle)[:, 0])
            flank.append(spline(turned(mirror @ piece, angle), last, nxt))
            last = nxt
        nxt = point(turned(pieces[-1][:, -1:], angle)[:, 0])
        flank.append(geo.addCircleArc(last, centre, nxt))
        last = nxt
        for piece in reversed([fillet, *pieces]):
            nxt = point(turned(piece[:, :1], angle)[:, 0])
            flank.append(spline(turned(piece[:, ::-1], angle), last, nxt))
            last = nxt
        feet.append((left_foot, last, angle))
        curves.append(flank)
        fine.extend(flank)
        for t in rolls if angle in angles[:watched] else ():
            crossing = np.array([[0.0], [tooth.base_radius / math.cos(t - gear.base_half_angle)]])
            inner.append(point(turned(crossing, angle)[:, 0]))
    root = tooth.root_radius
    boundary = []
    for k, flank in enumerate(curves):
        boundary.extend(flank)
        start, here = feet[k][1], feet[k][2] + gear.root_half_angle
        stop, there = feet[(k + 1) % len(feet)][0], feet[(k + 1) % len(feet)][2] - gear.root_half_angle
        span = (there - here) % (2 * math.pi)
        parts = max(1, math.ceil(span / 1.5))
        last = start
        for i in range(1, parts + 1):
            angle = here + span * i / parts
            nxt = stop if i == parts else point(np.array([root * math.sin(angle), root * math.cos(angle)]))
            boundary.append(geo.addCircleArc(last, centre, nxt))
            last = nxt
    rim = geo.addCurveLoop(boundary)
    bore = geo.addCircle(0, 0, 0, gear.bore_mm / m)
    face = geo.addPlaneSurface([rim, geo.addCurveLoop([bore])])
    geo.remove([(0, centre)])
    geo.synchronize()
    mesh.embed(0, inner, 2, face)
    mesh.field.add("Distance", 1)
    mesh.field.setNumbers(1, "CurvesList", fine)
    mesh.field.setNumber(1, "Sampling", 40)
    mesh.field.add("Threshold", 2)
    for name, value in (("InField", 1), ("SizeMin", size), ("SizeMax", 12 * size), ("DistMin", 1.0), ("DistMax", 9.0)):
        mesh.field.setNumber(2, name, value)
    mesh.field.setAsBackgroundMesh(2)
    for option in ("FromPoints", "FromCurvature", "ExtendFromBoundary"):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", 0)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.model.addPhysicalGroup(2, [face], name="gear")
    mesh.generate(2)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "gear.msh")
        gmsh.write(path)
        gmsh.finalize()
        return MeshTri2.load(path)


def probes(basis: Basis, points: np.ndarray) -> csr_matrix:
    """Rows that give all x, then all y components at points: Basis.probes, which curved meshes lack.

    Elements away from the boundary have straight sides, so the mesh of the vertices finds them.
    """
    straight = MeshTri(basis.mesh.p, basis.mesh.t, validate=False)
    cells = straight.element_finder()(*points)
    local = basis.mapping.invF(points[:, :, None], tind=cells)
    values = [basis.elem.gbasis(basis.mapping, local, k, tind=cells)[0] for k in range(basis.Nbfun)]
    rows = np.tile(np.arange(2 * points.shape[1]), basis.Nbfun)
    columns = basis.element_dofs[:, np.tile(cells, 2)].ravel()
    return coo_matrix((np.array(values).ravel(), (rows, columns)), shape=(2 * points.shape[1], basis.N)).tocsr()


@BilinearForm
def elasticity(u, v, _):
    strain, virtual = sym_grad(u), sym_grad(v)
    return (ddot(strain, virtual) * (1 - NU) + NU * trace(strain) * trace(virtual)) / (1 - NU**2)


def rigid(basis: Basis, tooth: ToothProfile, angle: float, at: float, roll: float) -> np.ndarray:
    """Row that gives the displacement along a load's line, of the cross-section at roll angle `at` taken as rigid."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    y, h, _, _ = (float(value) for value in tooth.involute(at))
    load_y, load_h, _, _ = (float(value) for value in tooth.involute(roll))
    inside = h * (1 - 1e-6) * nodes
    values = probes(basis, turned(np.array([inside, np.full_like(inside, y)]), angle))
    values = values[: len(nodes)], values[len(nodes) :]
    across, along = (
        axis[0] * values[0] + axis[1] * values[1] for axis in turned(np.eye(2), angle).T
    )  # components in the tooth's own axes
    mean_x, mean_y = across.T @ (weights / 2), along.T @ (weights / 2)
    turn = along.T @ (weights * nodes * 1.5 / h)
    slope = roll - tooth.gear.base_half_angle
    # moved rigidly from the section's middle to the load
    at_load_x, at_load_y = mean_x - (load_y - y) * turn, mean_y + load_h * turn
    return -math.cos(slope) * at_load_x - math.sin(slope) * at_load_y


def influence(
    gear: SpurGear, angles: list[float], watched: int, rolls: np.ndarray, size: float
) -> dict[str, np.ndarray]:
    """Compliances times E b: rows are measures (tooth by tooth, roll by roll), columns loads on the first tooth."""
    mesh = build_mesh(gear, angles, watched, rolls, size)
    tooth = ToothProfile(gear)
    basis = Basis(mesh, ElementVector(ElementTriP2()), intorder=4)
    stiffness = elasticity.assemble(basis)
    fixed = np.flatnonzero(np.hypot(*basis.doflocs) < gear.bore_mm / gear.module_mm * (1 + 1e-6))
    free_matrix, _, _, free = condense(stiffness, np.zeros(basis.N), D=fixed)

    def dofs_at(x: float, y: float, angle: float) -> np.ndarray:
        distance = np.hypot(*(basis.doflocs - turned(np.array([[x], [y]]), angle)))
        found = np.flatnonzero(distance < 1e-7)
        assert len(found) == 2, (x, y, distance.min())
        return found  # x, then y

    tip_radius = (gear.tip_circle_mm - 0.1 * gear.module_mm) / gear.base_radius_mm
    tip_roll = math.sqrt(tip_radius**2 - 1)
    loads = np.zeros((basis.N, len(rolls)))
    rows: dict[str, list[np.ndarray]] = {"section": [], "tip": [], "centre": []}
    for k, angle in enumerate(angles[:watched]):
        for i, t in enumerate(rolls):
            slope = t - gear.base_half_angle
            direction = turned(np.array([[-math.cos(slope)], [-math.sin(slope)]]), angle)[:, 0]
            if k == 0:
                y, h, _, _ = (float(value) for value in tooth.involute(t))
                loads[dofs_at(h, y, angle), i] = direction
            centre = np.zeros(basis.N)
            centre[dofs_at(0.0, tooth.base_radius / math.cos(slope), angle)] = direction
            rows["centre"].append(centre)
            rows["section"].append(rigid(basis, tooth, angle, t, t))
            rows["tip"].append(rigid(basis, tooth, angle, tip_roll, t))
    moved = np.zeros_like(loads)
    moved[free] = splu(free_matrix.tocsc()).solve(np.ascontiguousarray(loads[free]))
    return {"nodes": basis.N // 2} | {name: np.array(measure) @ moved for name, measure in rows.items()}


def positions(pair: SpurPair) -> np.ndarray:
    """Contact positions in mesh periods: five in the first zone, one in the middle, five one period later."""
    first = (pair.contact_ratio - math.floor(pair.contact_ratio)) * np.arange(5) / 4
    return np.concatenate([first, [pair.contact_ratio / 2], first + 1])


def rolls_of(pair: SpurPair, who: str) -> np.ndarray:
    on_pinion = pair.contact_start_mm + positions(pair) * pair.base_pitch_mm
    if who == "pinion":
        return on_pinion / pair.pinion.base_radius_mm
    return (pair.line_of_action_mm - on_pinion) / pair.gear.base_radius_mm


CASES: dict[str, tuple[dict[str, float], str, int, int, tuple[float, ...]]] = {
    # name: the pair, which gear, how many teeth it has and how many of them are watched, element sizes
    "34": ({}, "pinion", 1, 1, (0.2, 0.1, 0.05)),
    "34 in a row": ({}, "pinion", 5, 5, (0.1, 0.05)),
    "34 all round": ({}, "pinion", 34, 3, (0.2, 0.1)),
    "34 with 54": ({"gear_teeth": 54}, "pinion", 3, 3, (0.1, 0.05)),
    "54 with 34": ({"gear_teeth": 54}, "gear", 3, 3, (0.1, 0.05)),
    "20 shifted": ({"pinion_teeth": 20, "pinion_shift": 0.3}, "pinion", 3, 3, (0.1, 0.05)),
    "34 thin ring": ({"bore_ratio": 0.6}, "pinion", 3, 3, (0.1, 0.05)),
}


def main() -> None:
    results = []
    for name, (changes, who, count, watched, sizes) in CASES.items():
        pair = SpurPair(**changes)
        gear, rolls = getattr(pair, who), rolls_of(pair, who)
        # loaded tooth first, then alternately to both sides
        steps = sorted(range(-((count - 1) // 2), count // 2 + 1), key=lambda step: (abs(step), -step))
        runs = [influence(gear, [2 * math.pi * k / gear.teeth for k in steps], watched, rolls, size) for size in sizes]
        blocks = {}
        for measure in ("section", "tip", "centre"):
            finest, coarser = runs[-1][measure], runs[-2][measure]
            for k, step in enumerate(steps[:watched]):
                block, before = (run[k * len(rolls) : (k + 1) * len(rolls)] for run in (finest, coarser))
                if step == 0:
                    block, before = np.diag(block), np.diag(before)
                elif measure != "section":
                    continue  # no indentation so far away: one measure is enough
                blocks[f"{measure} {step:+d}" if step else measure] = {
                    "compliance": [[float(f"{v:.6g}") for v in row] for row in np.atleast_2d(block)],
                    "change_on_refining": float(f"{np.abs(block / before - 1).max():.2g}"),
                }
        results.append(
            {
                "case": name,
                "pair": changes,
                "gear": who,
                "positions": positions(pair).round(12).tolist(),
                "sizes": sizes,
                "nodes": [int(run["nodes"]) for run in runs],
                "blocks": blocks,
            }
        )
        print(name, results[-1]["nodes"], {key: block["change_on_refining"] for key, block in blocks.items()})
    RESULTS.write_text(_compact(results))


def _compact(results: list[dict[str, object]]) -> str:
    """JSON with one row of numbers a line."""
    text = json.dumps(results, indent=1)
    row = re.compile(r"\[[\s\d.,e+-]+\]")
    return row.sub(lambda found: " ".join(found[0].split()), text) + "\n"


if __name__ == "__main__":
    main()
