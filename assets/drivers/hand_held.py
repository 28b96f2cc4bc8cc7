#!/usr/bin/env python3
"""A driver of Nextview for a scanner that is moved by hand: hand_held.py FOLDER

Says on standard error from where the next scan is wanted, and waits until one appears in FOLDER: points in the camera
frame [m] as .ply. Where the scan was really taken from is read from a .txt file of the same name, put there before it:
T_world_camera, 16 numbers by rows. Without one it is taken to be where it was wanted."""
import json, math, os, select, sys

FOLDER = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__))
SCANNER = {"intrinsics": [600.0, 600.0, 319.5, 239.5], "width": 640, "height": 480, "max_range": 1.5, "range_noise": 0.001}
wanted = [1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
unread = b""


def next_request(seconds=None):
    """The next request; None if none comes within so many seconds."""
    global unread
    while b"\n" not in unread:
        if not select.select([0], [], [], seconds)[0]:
            return None
        more = os.read(0, 65536)
        unread += more or sys.exit()
    line, unread = unread.split(b"\n", 1)
    return json.loads(line)


def answer(request, **values):
    print(json.dumps({"id": request["id"], **(values if "error" in values else {"ok": True, **values})}), flush=True)


def cost(start, goal):
    distance = math.dist(start[3:12:4], goal[3:12:4])
    cosine = (sum(start[i] * goal[i] for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)) - 1) / 2
    return {"distance": distance, "rotation": math.acos(max(-1, min(1, cosine))), "seconds": 10 + 10 * distance}


def scans():
    """The scans in the folder that hold something, and how much."""
    sizes = {f: os.path.getsize(os.path.join(FOLDER, f)) for f in os.listdir(FOLDER) if f.endswith(".ply")}
    return {f: size for f, size in sizes.items() if size > 0}


def wait_for_scan(request):
    print("take the scan and save it as .ply in", FOLDER, file=sys.stderr, flush=True)
    before = scans()
    while True:
        stop = next_request(0.3)
        if stop:
            answer(request, error="stopped")
            return answer(stop)
        now = scans()
        for name in sorted(set(now) - taken):
            if now[name] == before.get(name):  # it grows no more
                taken.add(name)
                pose_file = os.path.join(FOLDER, name[:-4] + ".txt")
                pose = [float(x) for x in open(pose_file).read().split()] if os.path.exists(pose_file) else wanted
                return answer(request, file=os.path.join(FOLDER, name), pose=pose)
        before = now


taken = set(scans())
while True:
    request = next_request()
    if request["request"] == "hello":
        answer(request, protocol=1, name="hand-held scanner", abilities=["stop", "free-hand"], timeout=0, **SCANNER)
    elif request["request"] == "reach":
        answer(request, reach=[cost(request["from"], pose) for pose in request["poses"]])
    elif request["request"] == "move":
        wanted = request["pose"]
        print("move the scanner to x y z = {:.3f} {:.3f} {:.3f} m,".format(*wanted[3:12:4]),
              "looking along {:.2f} {:.2f} {:.2f}".format(*wanted[2:11:4]), file=sys.stderr, flush=True)
        answer(request, pose=wanted)
    elif request["request"] == "capture":
        wait_for_scan(request)
    elif request["request"] == "stop":
        answer(request)
    else:  # bye
        break
