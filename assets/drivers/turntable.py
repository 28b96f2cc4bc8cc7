#!/usr/bin/env python3
"""A driver of Nextview for a turntable: turntable.py FOLDER [DISTANCE HEIGHT]

The camera stands still, DISTANCE from the axis and HEIGHT above the middle of the object [m], and looks at that middle;
the object turns. Seen from the object the camera flies on a circle: all other poses cannot be reached. In this example
nothing turns, and FOLDER holds what the camera sees, named by the angle in degrees: 000.ply, 015.ply, …, points in the
camera frame [m]. The views are at those angles, and every 15 degrees while there is no scan yet."""
import json, math, os, sys

FOLDER = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__))
DISTANCE, HEIGHT = (float(x) for x in (sys.argv[2:4] or ("0.8", "0.4")))
SCANNER = {"intrinsics": [600.0, 600.0, 319.5, 239.5], "width": 640, "height": 480, "max_range": 1.5, "range_noise": 0.001}
TURN_RATE = 0.5  # [rad/s]
angle = 0.0  # where the table stands [rad]


def pose_at(a):
    """T_world_camera at an angle of the table: x to the right, y down, z towards the middle."""
    c, s, length = math.cos(a), math.sin(a), math.hypot(DISTANCE, HEIGHT)
    z = (-c * DISTANCE / length, -s * DISTANCE / length, -HEIGHT / length)
    x = (-s, c, 0.0)
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    position = (c * DISTANCE, s * DISTANCE, HEIGHT)
    return [v for i in range(3) for v in (x[i], y[i], z[i], position[i])] + [0.0, 0.0, 0.0, 1.0]


def angle_of(pose):
    return math.atan2(pose[7], pose[3])


def obstacle(pose):
    """Why a pose cannot be reached; empty if it can."""
    near = pose_at(angle_of(pose))
    off = math.dist(pose[3:12:4], near[3:12:4])
    cosine = (sum(pose[i] * near[i] for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)) - 1) / 2
    turned = math.degrees(math.acos(max(-1, min(1, cosine))))
    return f"it lies {off:.2f} m and {turned:.0f} degrees off the circle around the turntable" if off > 0.04 or turned > 4 else ""


def reach(start, goal):
    if obstacle(goal):
        return {"unreachable": obstacle(goal)}
    turn = abs(math.remainder(angle_of(goal) - angle_of(start), 2 * math.pi))
    return {"distance": turn * DISTANCE, "rotation": turn, "seconds": turn / TURN_RATE}


def scans():
    """The scans by their angles [degrees]."""
    files = os.listdir(FOLDER) if os.path.isdir(FOLDER) else []
    return {float(f[:-4]): f for f in files if f.endswith(".ply") and f[:-4].isdigit()}


def capture():
    """The scan whose angle is nearest, and the pose that belongs to it."""
    angles = scans()
    off = {a: abs(math.remainder(math.radians(a) - angle, 2 * math.pi)) for a in angles}
    nearest = min(off, key=off.get, default=None)
    if nearest is None or off[nearest] > math.radians(3):
        return {"error": f"there is no scan of {math.degrees(angle) % 360:.0f} degrees in {FOLDER}"}
    return {"file": os.path.join(FOLDER, angles[nearest]), "pose": pose_at(math.radians(nearest))}


for line in sys.stdin:
    request = json.loads(line)
    kind, result = request["request"], {}
    if kind == "bye":
        break
    if kind == "hello":
        degrees = sorted(scans()) or range(0, 360, 15)
        angle = math.radians(degrees[0])
        views = [pose_at(math.radians(a)) for a in degrees]
        result = dict(protocol=1, name="turntable", abilities=[], start=pose_at(angle), views=views, **SCANNER)
    elif kind == "reach":
        result = {"reach": [reach(request["from"], pose) for pose in request["poses"]]}
    elif kind == "move" and obstacle(request["pose"]):
        result = {"error": obstacle(request["pose"])}
    elif kind == "move":
        angle = angle_of(request["pose"])  # here a real driver turns the table
        print(f"turned to {math.degrees(angle) % 360:.1f} degrees", file=sys.stderr, flush=True)
        result = {"pose": pose_at(angle)}
    elif kind == "capture":
        result = capture()
    print(json.dumps({"id": request["id"], **({} if "error" in result else {"ok": True}), **result}), flush=True)
