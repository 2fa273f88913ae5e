"""The first echo of each sonar: rays followed through mirrors, corners and edges (see sonar_physics)."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from core.geometry import BoolArray, FloatArray

TABLE_STEP = math.radians(1.0)
"""Step of the table of the beam's directivity (rad)."""
CLEAR = 1e-6
"""A reflected ray starts this far off its face (m)."""


@njit(cache=True)
def near_faces(faces: FloatArray, x: float, y: float, reach: float) -> BoolArray:
    """Which faces (F,) come within `reach` metres of a point."""
    near = np.zeros(len(faces), np.bool_)
    for i in range(len(faces)):
        ax, ay = faces[i, 0] - x, faces[i, 1] - y
        dx, dy = faces[i, 2] - faces[i, 0], faces[i, 3] - faces[i, 1]
        share = -(ax * dx + ay * dy) / max(dx * dx + dy * dy, 1e-12)
        share = min(max(share, 0.0), 1.0)
        near[i] = (ax + share * dx) ** 2 + (ay + share * dy) ** 2 <= reach * reach
    return near


@njit(cache=True)
def first_hit(
    x: float, y: float, dx: float, dy: float, reach: float, faces: FloatArray, normals: FloatArray
) -> tuple[float, int]:
    """Distance to the first face that a ray meets within `reach` and its number, or (reach, -1)."""
    best, which = reach, -1
    for i in range(len(faces)):
        towards = dx * normals[i, 0] + dy * normals[i, 1]
        if towards >= -1e-9:
            continue
        t = ((faces[i, 0] - x) * normals[i, 0] + (faces[i, 1] - y) * normals[i, 1]) / towards
        if t < -CLEAR or t >= best:
            continue
        px, py = x + t * dx - faces[i, 0], y + t * dy - faces[i, 1]
        ux, uy = normals[i, 1], -normals[i, 0]
        along = px * ux + py * uy
        length = (faces[i, 2] - faces[i, 0]) * ux + (faces[i, 3] - faces[i, 1]) * uy
        if -1e-9 <= along <= length + 1e-9:
            best, which = max(t, 0.0), i
    return best, which


@njit(cache=True)
def _table(pressure: FloatArray, angle: float) -> float:
    """Relative pressure at an angle off the axis (rad); nothing behind the transducer."""
    at = abs(angle) / TABLE_STEP
    low = int(at)
    if low + 1 >= len(pressure):
        return 0.0
    share = at - low
    return float((1.0 - share) * pressure[low] + share * pressure[low + 1])


@njit(cache=True)
def first_echoes(
    pose: FloatArray,
    mounts: FloatArray,
    limits: FloatArray,
    pressure: FloatArray,
    faces: FloatArray,
    normals: FloatArray,
    surfaces: FloatArray,
    edges: FloatArray,
    thresholds: FloatArray,
    physics: tuple[float, float, float, float, float, float],
    bounces: int,
) -> FloatArray:
    """(S, 2): range (m, inf = none) and strength of the first echo above each sonar's threshold."""
    spacing, beam_share, _, _, _, edge_strength = physics
    out = np.full((len(mounts), 2), np.inf)
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    for s in range(len(mounts)):
        x = pose[0] + cos * mounts[s, 0] - sin * mounts[s, 1]
        y = pose[1] + sin * mounts[s, 0] + cos * mounts[s, 1]
        heading = pose[2] + mounts[s, 2]
        best = np.array([limits[s, 1], 0.0])
        half = min(limits[s, 2] * beam_share / 2, math.pi / 2)
        count = int(2 * half / spacing) + 1
        for k in range(count):
            off = -half + 2 * half * k / max(count - 1, 1)
            sent = _table(pressure[s], off)
            _follow(
                x,
                y,
                heading,
                off,
                sent,
                pressure[s],
                faces,
                normals,
                surfaces,
                thresholds[s],
                physics,
                bounces,
                best,
            )
        if edge_strength > 0.0:
            _diffract(
                x,
                y,
                heading,
                half,
                pressure[s],
                faces,
                normals,
                edges,
                thresholds[s],
                physics,
                best,
            )
        if best[1] > 0.0:
            out[s] = best
    return out


@njit(cache=True)
def _follow(
    x: float,
    y: float,
    heading: float,
    off: float,
    sent: float,
    pressure: FloatArray,
    faces: FloatArray,
    normals: FloatArray,
    surfaces: FloatArray,
    threshold: float,
    physics: tuple[float, float, float, float, float, float],
    bounces: int,
    best: FloatArray,
) -> None:
    """Follows one ray over its bounces; `best` (range, strength) takes an earlier echo."""
    spacing, _, capture, mirror_loss, scatter_loss, _ = physics
    px, py = x, y
    dx, dy = math.cos(heading + off), math.sin(heading + off)
    path, kept = 0.0, 1.0
    for bounce in range(bounces + 1):
        t, face = first_hit(px, py, dx, dy, 2 * best[0] - path, faces, normals)
        if bounce > 0:
            # does the mirrored ray pass the transducer before it meets something?
            back = (x - px) * dx + (y - py) * dy
            if 0.0 < back < t or (face < 0 and back > 0.0):
                miss = abs((x - px) * dy - (y - py) * dx)
                whole = path + back
                if miss < capture + 0.5 * spacing * whole and whole / 2 < best[0]:
                    arrival = math.atan2(-dy, -dx) - heading
                    arrival = (arrival + math.pi) % (2 * math.pi) - math.pi
                    heard = sent * _table(pressure, arrival) * kept
                    heard /= max(whole / 2, 0.1) ** mirror_loss
                    if heard > threshold:
                        best[0], best[1] = whole / 2, heard
        if face < 0:
            return
        path += t
        px += t * dx
        py += t * dy
        towards = -(dx * normals[face, 0] + dy * normals[face, 1])
        glance = math.acos(min(max(towards, 0.0), 1.0)) / surfaces[face, 0]
        answer = math.exp(-glance * glance) + surfaces[face, 2]
        heard = sent * sent * kept * kept * surfaces[face, 1] * answer
        heard /= max(path, 0.1) ** scatter_loss
        if path < best[0] and heard > threshold:
            best[0], best[1] = path, heard
        kept *= surfaces[face, 1]
        dx += 2 * towards * normals[face, 0]
        dy += 2 * towards * normals[face, 1]
        px += CLEAR * normals[face, 0]
        py += CLEAR * normals[face, 1]
        if path >= 2 * best[0] or sent * kept < threshold:
            return


@njit(cache=True)
def _diffract(
    x: float,
    y: float,
    heading: float,
    half: float,
    pressure: FloatArray,
    faces: FloatArray,
    normals: FloatArray,
    edges: FloatArray,
    threshold: float,
    physics: tuple[float, float, float, float, float, float],
    best: FloatArray,
) -> None:
    """Echoes of convex edges in the beam that the transducer sees."""
    scatter_loss, edge_strength = physics[4], physics[5]
    for e in range(len(edges)):
        ex, ey = edges[e, 0] - x, edges[e, 1] - y
        r = math.sqrt(ex * ex + ey * ey)
        if r >= best[0] or r < CLEAR:
            continue
        off = math.atan2(ey, ex) - heading
        off = (off + math.pi) % (2 * math.pi) - math.pi
        if abs(off) > half:
            continue
        level = _table(pressure, off)
        heard = level * level * edge_strength / max(r, 0.1) ** scatter_loss
        if heard <= threshold:
            continue
        t, _ = first_hit(x, y, ex / r, ey / r, r, faces, normals)
        if t >= r - 0.005:
            best[0], best[1] = r, heard
