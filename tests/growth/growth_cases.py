"""The commands that are measured, and how fast each may grow. A bound is the exponent that must be, and 0.2 to 0.4 for
what is measured: it lies nearer to it than to that of the next worse way to do the same."""
import dataclasses
import typing

import growth_inputs as make

SETTINGS = {"--object.longest_side": "0.5", "--sensor.width": "160", "--sensor.height": "120",
            "--map.resolution": "0.02", "--views.count": "24", "--planner.ray_columns": "16",
            "--planner.ray_rows": "12", "--evaluation.surface_samples": "2000", "--termination.surface_left": "0"}
PLAIN = ["--no-pictures", "--no-surfaces"]


@dataclasses.dataclass
class Case:
    command: str
    quantity: str
    sizes: list
    arguments: typing.Callable  # of the folder for results and the size
    seconds: float  # bound of the exponent
    memory: float
    prepare: typing.Callable = None  # of the folder and the size: writes files, and returns what is to be run before
    stdin: str = ""  # a file in the folder that it reads


def scan(views, out, *more, object="sphere"):
    """A small scan; of two settings of a key the last one counts."""
    settings = {**SETTINGS, **dict(zip(more[::2], more[1::2]))}
    given = [word for pair in settings.items() for word in pair]
    return ["scan", object, *given, *PLAIN, "--termination.views", str(views), "--out", str(out)]


def sized(words, size):
    return [str(size) if word == "SIZE" else word for word in words]


def session(views, *more):
    """To be run before: a session in the folder `scan`, of so many views; 0: of as many as the size says."""
    return lambda at, n: [scan(views or n, at / "scan", *sized(more, n))]


def steps_of_a_scan():
    """Linear in everything but the voxels."""
    def six_views(key):
        return lambda at, n: scan(6, at / "out", key, str(n))

    return [
        # Each view costs the same: nothing is gone through again from the first view on.
        Case("scan", "views", [25, 50, 100, 200], lambda at, n: scan(n, at / "out", "--views.count", "210"), 1.25, 1.2),
        # Rays cross as many as the edge has, but free space, and distances in the object's box, are of each voxel.
        Case("scan", "voxels along an edge", [64, 128, 256],
             lambda at, n: scan(3, at / "out", "--map.resolution", str(1.28 / n)), 3.3, 3.2),
        # A tree of boxes over them: n log n.
        Case("scan", "triangles", [50000, 200000, 800000],
             lambda at, n: scan(3, at / "out", object=str(at / "part.ply")), 1.3, 1.2,
             lambda at, n: make.sphere(at / "part.ply", n)),
        Case("scan", "candidates", [50, 400, 3200], six_views("--views.count"), 1.25, 1.2),
        Case("scan", "rows of rays", [25, 100, 400],
             lambda at, n: scan(6, at / "out", "--planner.ray_columns", "200", "--planner.ray_rows", str(n)),
             1.25, 1.2),
        # Pixels are edge by edge.
        Case("scan", "pixels along an edge", [320, 640, 1280, 2560],
             lambda at, n: scan(3, at / "out", "--sensor.width", str(n), "--sensor.height", str(n)), 2.2, 2.2),
        Case("scan", "samples of the truth", [40000, 160000, 640000], six_views("--evaluation.surface_samples"),
             1.3, 1.2),
        Case("scan", "plans tried out", [1024, 8192, 65536], six_views("--planner.simulations"), 1.2, 1.2),
    ]


def whole_scans():
    """Over many views."""
    sampled = ["--planner.gain", "gibbs", "--gibbs.view_sweeps", "4", "--gibbs.chains", "2", "--gibbs.ray_spacing", "0"]
    moved = ["--views.count", "60", "--registration.mode", "correct", "--robot.position_error", "0.002"]
    recorded = ["--map.resolution", "0.02", "--planner.ray_columns", "16", "--planner.ray_rows", "12"]
    return [
        # Each scan is laid on the surface of those before it, which is brought along; it does not grow for long.
        Case("scan, registered", "views", [12, 24, 48], lambda at, n: scan(n, at / "out", *moved), 1.4, 1.2),
        # After each view all rays so far are sampled again: views by views.
        Case("scan, gain gibbs", "views", [4, 8, 16], lambda at, n: scan(n, at / "out", *sampled), 2.2, 1.2),
        # All frames that are left are ranked at each step, frames by frames; but ranking is the least of it.
        Case("scan --recorded", "frames", [25, 50, 100],
             lambda at, n: ["scan", "--recorded", str(at / "scan"), *PLAIN, *recorded, "--out", str(at / "out")],
             1.4, 1.2, session(0, "--views.count", "110")),
        Case("scan --resume", "views", [25, 50, 100, 200], lambda at, n: ["scan", "--resume", str(at / "scan"), *PLAIN],
             1.25, 1.2, session(0, "--views.count", "210")),
        Case("driver simulated", "captures", [40, 160, 640],
             lambda at, n: ["driver", "simulated", "sphere", "--sensor.width", "320", "--sensor.height", "240"],
             1.2, 1.2, lambda at, n: make.requests(at / "requests", n, at / "captured"), "requests"),
    ]


def of_maps():
    """What samples, scores and fits."""
    rough = ["--sensor.width", "64", "--sensor.height", "48", "--map.resolution", "0.04"]
    plain = [*PLAIN, "--gibbs.until_stationary", "false", "--gibbs.chains", "2"]

    def refine(*more):
        return lambda at, n: ["refine", str(at / "scan"), *plain, *sized(more, n), "--out", str(at / "out")]

    return [
        Case("refine", "views", [8, 16, 32], refine("--gibbs.sweeps", "40", "--gibbs.ray_spacing", "0"), 1.3, 1.2,
             session(0, "--views.count", "40")),
        Case("refine", "sweeps", [50, 200, 800], refine("--gibbs.sweeps", "SIZE"), 1.2, 1.2, session(6)),
        Case("calibrate", "views", [8, 24, 72],
             lambda at, n: ["calibrate", "sphere", "--held-out", "box", "--views", str(n), *rough, "--no-pictures",
                            "--out", str(at / "out")], 1.3, 1.2),
        Case("calibrate --fit new-surface", "parts", [2, 4, 8],
             lambda at, n: ["calibrate", "--fit", "new-surface", "--parts", str(n), "--views", "4", *rough,
                            "--out", str(at / "out")], 1.3, 1.2),
        Case("score SESSION", "candidates", [50, 400, 3200], lambda at, n: ["score", str(at / "scan"), "--gain", "all"],
             1.2, 1.2, session(4, "--views.count", "SIZE")),
        Case("score --scene", "views", [100, 400, 1600],
             lambda at, n: ["score", "--gain", "all", "--scene", str(at / "scene.txt")],
             1.2, 1.2, lambda at, n: make.scene(at / "scene.txt", n)),
        # A number of each sweep is kept, to tell how exact the means are.
        Case("posterior", "sweeps", [40000, 160000, 640000],
             lambda at, n: ["posterior", "--problem", "slot", "--sweeps", str(n)], 1.2, 1.2),
    ]


def of_results():
    """What writes, draws and tells."""
    def export(*what):
        return lambda at, n: ["export", str(at / "scan"), *(word.format(at=at, n=n) for word in what)]

    return [
        Case("export cloud", "views", [50, 100, 200], export("cloud", "{at}/out.ply"), 1.3, 1.2,
             session(0, "--views.count", "210")),
        Case("export surface --of cloud", "views", [12, 24, 48], export("surface", "{at}/out.ply", "--of", "cloud"),
             1.3, 1.2, session(0, "--views.count", "60")),
        # The cells that a surface goes through are looked for in all of the map.
        Case("export surface", "voxels along an edge", [64, 128, 256], export("surface", "{at}/out.ply"), 3.4, 3.2,
             lambda at, n: [scan(3, at / "scan", "--map.resolution", str(1.28 / n))]),
        Case("export turntable", "frames", [8, 32, 128],
             export("turntable", "{at}/out", "--frames", "{n}", "--size", "320x240"), 1.2, 1.2, session(4)),
        # Pixels are edge by edge, here as in the next.
        Case("export picture", "pixels along an edge", [1024, 2048, 4096],
             export("picture", "{at}/out.png", "--size", "{n}x{n}"), 2.2, 2.2, session(4)),
        Case("figure", "pixels along an edge", [1024, 2048, 4096],
             lambda at, n: ["figure", "strategy", str(at / "scan"), "--views", "1,2", "--size", f"{n}x{n}",
                            "--out", str(at / "out")],
             2.2, 2.2, session(4)),
        Case("demo", "frames", [40, 80, 160],
             lambda at, n: ["demo", str(at / "d.nextview"), "--fps", "10", "--size", "320x180",
                            "--out", str(at / "out")],
             1.2, 1.2, lambda at, n: make.demo(at / "d.nextview", n // 10)),
        Case("info SESSION", "views", [50, 100, 200], lambda at, n: ["info", str(at / "scan")], 1.2, 1.2,
             session(0, "--views.count", "210")),
        Case("info MESH", "triangles", [100000, 400000, 1600000], lambda at, n: ["info", str(at / "part.ply")],
             1.4, 1.2, lambda at, n: make.sphere(at / "part.ply", n)),
        Case("info CLOUD", "points", [400000, 1600000, 6400000], lambda at, n: ["info", str(at / "part.ply")],
             1.3, 1.2, lambda at, n: make.cloud(at / "part.ply", n)),
    ]


def of_studies():
    """Nothing of a run is kept in memory but its key, and what its object's mean needs."""
    def studied_before(at, runs):
        make.study(at / "study.toml", runs)
        return [["study", str(at / "study.toml"), "--out", str(at / "done")]]

    return [
        Case("study", "runs", [16, 64, 256], lambda at, n: ["study", str(at / "study.toml"), "--out", str(at / "out")],
             1.2, 1.2, lambda at, n: make.study(at / "study.toml", n)),
        Case("study --merge", "runs", [64, 256, 1024],
             lambda at, n: ["study", "--merge", str(at / "done"), "--out", str(at / "out")], 1.2, 1.2,
             studied_before),
    ]


def cases():
    return steps_of_a_scan() + whole_scans() + of_maps() + of_results() + of_studies()
