"""What is done in the window: chapters that begin by opening something, of calls that are all right where they stand.
Between them are marks: a session of three views, the same each time, a file that says that it is there, and a rest."""
import random

SMALL = {"sensor.width": 80, "sensor.height": 60, "map.resolution": 0.04, "views.count": 12,
         "planner.ray_columns": 8, "planner.ray_rows": 6, "evaluation.surface_samples": 500,
         "termination.surface_left": 0, "termination.views": 100, "gibbs.sweeps": 20}
MOST_VIEWS = 7  # of twelve candidates
LAYERS = ("object", "cloud", "octree", "views", "rays", "region", "missed", "surface", "candidates", "legends",
          "occupied", "unknown", "free", "uncertain")
CHOICES = {
    "object-style": "solid wire ghost", "surface-of": "map cloud", "surface-colour": "uncertainty single deviation",
    "cloud-colour": "view height distance single", "voxel-colour": "probability entropy error class",
    "second-view": "object surface cloud octree missed none",
    "standard-view": "front right back left top bottom usual",
    "section-axis": "x y z none", "slice-axis": "x y z none", "frame": "all region object"}
PANELS = "session layers candidates view inspector gibbs curves timeline comparison log".split()
GAINS = ("occlusion-aware", "unobserved-voxel", "area-factor", "average-entropy", "random", "farthest", "new-surface")
FILES = {"export-cloud": "ply", "export-map": "ot", "export-surface": "stl", "export-views": "json",
         "export-curves": "svg", "save-picture": "png", "export-picture": "png", "save-script": "txt"}


class Calls:
    """`folder`: for what is written; `program`: its driver is a scanner."""

    def __init__(self, seed, folder, program):
        self.random = random.Random(seed)
        self.folder, self.program = folder, program
        self.views, self.exports = 0, 0
        self.lines = []
        settings = folder / "small.toml"
        tables = {}
        for key, value in SMALL.items():
            tables.setdefault(key.split(".")[0], []).append(f"{key.split('.')[1]} = {value}")
        settings.write_text("".join(f"[{name}]\n" + "\n".join(rows) + "\n" for name, rows in tables.items()))
        self.small = f'open "{settings}"'

    def script(self, steps, every):
        """So many lines, with a mark after each `every`; the numbers of the marks are in the names of their files."""
        self.mark(0)
        for number in range(1, steps // every + 1):
            end = number * every - 8  # the mark's own
            while len(self.lines) < end:
                before = len(self.lines)
                self.chapter()
                if len(self.lines) > end:  # half of it would leave something open
                    self.lines[before:] = ["turn 5 0"] * (end - before)
            self.mark(number)
        return "\n".join(self.lines + ["quit"]) + "\n"

    def mark(self, number):
        self.add(self.small, "open sphere", "step", "step", "step", "frame",
                 f'export-views "{self.folder}/mark_{number}.csv"', "wait 1")

    def add(self, *lines):
        self.lines += lines

    def step(self, count=1):
        for _ in range(min(count, MOST_VIEWS - self.views)):
            self.add("step")
            self.views += 1

    def chapter(self):
        self.begin()
        self.step(2)
        for act in self.random.sample(self.acts(), 6):
            act()
            self.step(self.random.randint(0, 1))

    def begin(self):
        """One of the ways to come to a scan without a view."""
        self.views = 0
        kind = self.random.randrange(7)
        if kind == 0:
            self.add("open box")
        elif kind == 1:
            self.add(self.small)
        elif kind == 2:
            self.add("open sphere", "step", "step", "reset")
        elif kind == 3:
            self.exports += 1
            kept = self.folder / f"kept_{self.exports}"
            self.add("open sphere", "step", "step", f'export "{kept}"', f'open "{kept}"')
            self.views = 2
        elif kind == 4:
            self.add("open sphere", "step", f'export-map "{self.folder}/map.ot"', f'open "{self.folder}/map.ot"',
                     self.small, "open sphere")
        elif kind == 5:
            self.add("open sphere", "step", "reset-settings", self.small, "open sphere")
        else:
            self.add("open sphere", "set map.resolution 0.05", "step", "undo", "undo", "redo",
                     "reset-setting map.resolution", self.small)

    def acts(self):
        return [self.layers, self.choices, self.camera, self.selection, self.settings, self.timeline, self.panels,
                self.sheets, self.files, self.history, self.taking, self.gibbs, self.holding, self.recording, self.measuring, self.playing,
                self.scanner, self.cutting, self.presenting]

    def layers(self):
        for layer in self.random.sample(LAYERS, 3):
            self.add(f"toggle-{layer}", f"toggle-{layer}")
        self.add("threshold 0.4", "uncertain-from 0.3", "lock-ranges", "lock-ranges")

    def choices(self):
        for command in self.random.sample(sorted(CHOICES), 3):
            names = CHOICES[command].split()
            self.add(f"{command} {self.random.choice(names[:-1])}", f"{command} {names[-1]}")

    def camera(self):
        self.add(f"turn {self.random.randint(-90, 90)} 5", "zoom 1", "zoom -1", "toggle-orthographic",
                 "keep-camera here", f"look-from {self.random.randint(0, 359)} 20", "go-to-camera here",
                 "remove-camera here",
                 "toggle-orthographic", "frame")

    def selection(self):
        self.add("select-next", "look-through", "select-taken 1", "inspect-ray 5", "inspect-voxel 0.01 0.02 0.03",
                 "custom-view 0.6 -0.6 0.5 0 0 0", "take-custom-view", "take-proposal", "undo", "redo",
                 "clear-selection")

    def settings(self):
        self.add(f"set planner.gain {self.random.choice(GAINS)}", f"set planner.cost_weight {self.random.random():.3f}",
                 "undo", "redo", "reset-setting planner.gain", "reset-setting planner.cost_weight")

    def timeline(self):
        name = f"way-{self.random.randint(1, 10 ** 6)}"
        self.add("previous-view", "next-view", "go-to-view 1", f"branch {name}", "step", f"rename-branch {name} other",
                 "go-to-branch main", "compare other", "stop-comparing", "split other", "stop-comparing",
                 "remove-branch other")

    def panels(self):
        self.add(*(f"panel {panel}" for panel in self.random.sample(PANELS, 5)))
        self.add("curves coverage entropy", "sort gain descending", "curves gain time", "sort view ascending",
                 "panel candidates")

    def sheets(self):
        pairs = ("dark", "hide-panels", "shortcuts", "guide", "palette", "full-screen")
        for command in self.random.sample(pairs, 3):
            self.add(command, command)
        self.add("manual planning", "manual", "text-size bigger", "text-size usual", "file-dialog export",
                 "file-dialog", "forget-runs", "panel-sizes 200 200 150")

    def files(self):
        for command in self.random.sample(sorted(FILES), 3):
            more = " 64x48" if command.endswith("picture") else ""
            self.add(f'{command} "{self.folder}/{command}.{FILES[command]}"{more}')
        self.add(f'export-turntable "{self.folder}/turn" 2 64x48')

    def history(self):
        self.add("step", "undo", "redo", "undo", "step", "undo", "go-to-view 1", "undo")

    def taking(self):
        first, second = self.random.sample(range(1, 12), 2)  # the first view is taken from 0
        self.add(self.small, "open sphere", "step", f"select-view {first}", "take-view", "step",
                 f"take-view {second}", "step", "undo", "redo")
        self.views = 3

    def gibbs(self):
        self.add("refine 1 12", "voxel-map gibbs", "voxel-colour difference", "voxel-colour class",
                 "voxel-map conventional")

    def holding(self):
        """What runs is paused and cancelled, which a script does not wait for."""
        self.add("open sphere", "set map.resolution 0.02", "step", "step", "refine 2 100000", "pause-refinement",
                 "resume-refinement", "cancel", "wait until done", self.small, "open sphere", "speed 2", "play", "pause", "wait until done", "speed 0")
        self.begin()  # how many views it took is not known
        self.step(2)

    def recording(self):
        self.add(f'record "{self.folder}/recorded.nextview"', "turn 10 0", 'caption "Why? {reason}"', 'caption ""',
                 "record-stop")

    def cutting(self):
        self.add("section-axis z", "section-at 0.01", "flip-section", "section-axis none", "slice-axis y",
                 "slice-at 0.05", "slice-at 0 0.1", "slice-axis none")

    def presenting(self):
        self.add("title Title Subtitle 0.1", "highlight view 0.1", "orbit 10 0.1 5", "fly-to 20 30 0.1 1.2",
                 "wait until done", "assert views > 0", "panel candidates")

    def measuring(self):
        self.add("measure", "measure-point 0 0 0.1", "measure-point 0.1 0 0.1", "measure bore", "measure",
                 "edit-region", "edit-region", "clear-selection")

    def playing(self):
        if self.views + 2 > MOST_VIEWS:
            return
        self.views += 2
        self.add(f"set termination.views {self.views}", "speed 0", "play",
                 "set termination.views 1", "continue", "set termination.views 100")

    def scanner(self):
        settings = "--sensor.width 80 --sensor.height 60"
        self.add(f"connect \"'{self.program}' driver simulated sphere {settings}\"", "step", "reconnect", "step",
                 "disconnect")
        self.views = 0  # it goes back to the object, not to its scan
        self.step(2)
