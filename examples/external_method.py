#!/usr/bin/env python3
"""An external method for bqsa-bench (docs/external-methods.md), in the plane and in space.

Closed-loop damped least squares for the tip; in its null space each obstacle pushes away the point
of the arm that is nearest to it. Python 3 and its standard library.
"""
import json
import math
import sys

DESCRIPTION = {
    "protocol": "bqsa-method/1", "kind": "reactive",
    "summary": "damped least squares, pushed away from nearest points in the null space",
    "source": "Liegeois 1977 (gradient projection)",
    "capabilities": {"planar": True, "spatial": True, "link_radius": True, "margin": True,
                     "moving": True, "prismatic": True, "keeps_limits": False},
    "parameters": [
        {"name": "influence", "unit": "m", "default": 0.04, "minimum": 1e-3, "maximum": 10,
         "meaning": "clearance below which an obstacle pushes"},
        {"name": "gain", "unit": "rad/(s m^2)", "default": 1000, "minimum": 0, "maximum": 1e6,
         "meaning": "strength of the push"},
        {"name": "exempt_length", "unit": "m", "default": 0.08, "minimum": 0, "maximum": 10,
         "meaning": "part of the last link, from the tip, that may be near obstacles"}]}
DAMPING = 1e-4  # [m]

def add(a, b, factor=1.0): return [x + factor * y for x, y in zip(a, b)]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def apply(matrix, v): return [dot(row, v) for row in matrix]
def transposed(matrix): return [list(column) for column in zip(*matrix)]
def cross(a, b): return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]

def turned(v, axis, angle):
    """v turned about a unit axis through the origin (Rodrigues)."""
    c, s = math.cos(angle), math.sin(angle)
    along = (1 - c) * dot(axis, v)
    return [c * v[i] + s * w + along * axis[i] for i, w in enumerate(cross(axis, v))]

def pose(robot, q):
    """Axes, pivots and points of the arm for joint values q: those for q = 0, moved joint by joint."""
    zero = robot["at_zero"]
    axes, pivots, points = ([list(v) for v in zero[key]] for key in ("axes", "pivots", "points"))
    for j in reversed(range(len(q))):  # a joint takes along all that is further out
        about, through = zero["axes"][j], zero["pivots"][j]
        if robot["joint_types"][j] == "prismatic":
            move = lambda p: add(p, about, q[j])
        else:
            move = lambda p: add(through, turned(add(p, through, -1), about, q[j]))
            axes[j + 1:] = [turned(axis, about, q[j]) for axis in axes[j + 1:]]
        pivots[j + 1:] = [move(p) for p in pivots[j + 1:]]
        points = [move(p) if zero["moving_joints"][k] > j else p for k, p in enumerate(points)]
    return axes, pivots, points

def jacobian(types, axes, pivots, point, joints):
    """3 x n; only the first `joints` joints move the point."""
    column = lambda j: (axes[j] if types[j] == "prismatic"
                        else cross(axes[j], add(point, pivots[j], -1)))
    return transposed([column(j) if j < joints else [0.0] * 3 for j in range(len(axes))])

def solved(A, b):
    """x with A x = b, A symmetric and positive definite (Gauss)."""
    rows = [row + [value] for row, value in zip(A, b)]
    for k, pivot in enumerate(rows):
        for i in range(len(rows)):
            if i != k:
                rows[i] = add(rows[i], pivot, -rows[i][k] / pivot[k])
    return [row[-1] / row[k] for k, row in enumerate(rows)]

def least_squares(J, v):
    """Damped least squares: the q with J q = v, nearly."""
    A = [[dot(a, b) + DAMPING ** 2 * (i == k) for k, b in enumerate(J)] for i, a in enumerate(J)]
    return apply(transposed(J), solved(A, v))

def nearest(a, b, obstacle):
    """Distance, place 0 .. 1 on the segment ab and unit normal of its nearest point to an ellipsoid."""
    axes = transposed(obstacle["rotation"])  # rows: directions of the axes
    x0, d = apply(axes, add(a, obstacle["center"], -1)), apply(axes, add(b, a, -1))
    squares = [s * s for s in obstacle["semi_axes"]]
    low, high = 0.0, max(obstacle["semi_axes"]) * (math.hypot(*x0) + math.hypot(*d))
    for _ in range(50):  # x - l n is on the surface for the right l, n = x / (squares + l)
        l = (low + high) / 2
        w = [1 / (s + l) for s in squares]
        wd = [wi * di for wi, di in zip(w, d)]
        t = min(max(-dot(wd, x0) / dot(wd, d), 0.0), 1.0)
        n = [wi * xi for wi, xi in zip(w, add(x0, d, t))]
        low, high = (l, high) if sum(s * ni * ni for s, ni in zip(squares, n)) > 1 else (low, l)
    length = math.hypot(*n)
    return l * length, t, [ni / length for ni in apply(transposed(axes), n)]

def step(problem, parameters, request):
    q, robot, dt, tick = request["q"], problem["robot"], problem["dt"], request["tick"]
    types, task = robot["joint_types"], robot["dimension"]
    moving = robot["at_zero"]["moving_joints"]
    axes, pivots, points = pose(robot, q)
    J = jacobian(types, axes, pivots, points[-1], len(q))[:task]
    track = least_squares(J, add(request["p_WT_desired"], points[-1], -1)[:task])

    push, clamps = [0.0] * len(q), []
    for index, obstacle in enumerate(problem["obstacles"]):
        shape = dict(obstacle, **(obstacle["motion"][tick] if obstacle["motion"] else {}))
        found = []
        for link, radius in zip(robot["links"], problem["link_radii"]):
            a, b = points[link["start"]], points[link["end"]]
            if link["end"] == len(points) - 1:  # the last part has to be where the task is
                part = parameters["exempt_length"] / math.dist(a, b)
                b = add(b, add(b, a, -1), -min(part, 1 - 1e-6))
            distance, t, normal = nearest(a, b, shape)
            found.append((distance - radius - problem["margin"], t, normal, a, b, link))
        clearance, t, normal, a, b, link = min(found, key=lambda item: item[0])
        if clearance < parameters["influence"]:
            point = add(a, add(b, a, -1), t)
            away = transposed(jacobian(types, axes, pivots, point, moving[link["end"]]))
            size = parameters["gain"] * (parameters["influence"] - clearance) * dt
            push = add(push, apply(away, normal), size)
            clamps.append({"link": link["number"], "obstacle": index})
    push = add(push, least_squares(J, apply(J, push)), -1)  # its part that leaves the tip where it is
    fits = min(min(1, max(limit - abs(v), 0) / abs(p)) if p else 1
               for limit, v, p in zip(problem["max_step"], track, push))
    return {"tick": tick, "q": add(add(q, track), push, fits), "state": "unclaimed",
            "clamps": clamps}

def main():
    for line in sys.stdin:
        request = json.loads(line)
        if request["request"] == "describe":
            answer = DESCRIPTION
        elif request["request"] == "prepare":
            problem, parameters, answer = request["problem"], request["parameters"], {}
        elif request["request"] == "step":
            answer = step(problem, parameters, request)
        else:  # quit
            break
        print(json.dumps(answer), flush=True)

main()
