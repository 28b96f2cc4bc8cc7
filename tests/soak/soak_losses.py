"""What goes away under the program: its display, all that it gave to the graphics card, and the hour that it was."""
import csv
import os
import pathlib
import random
import subprocess
import sys
import time

import soak_calls
import soak_window

SETTINGS = {**soak_calls.SMALL, "views.count": 40, "termination.views": 30}
DIFFERS = {"timings.csv", "state", "journal", "manifest.json"}  # seconds; how far it had come when


def words(settings):
    return [word for key, value in settings.items() for word in (f"--{key}", str(value))]


def run(program, *arguments, **variables):
    plain = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run([program, *map(str, arguments)], env={**plain, **variables}, capture_output=True,
                          text=True, timeout=300, errors="replace", check=False)


def contents(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}


def different(folder, expected):
    found, wanted = contents(folder), contents(expected)
    return [name for name in sorted(set(found) | set(wanted))
            if pathlib.Path(name).name not in DIFFERS and found.get(name) != wanted.get(name)]


def in_window(options, folder, lines, killed_after=None, **variables):
    """Plays the lines; kills the display so many seconds after the mark, if they say so. Exit code, what it told."""
    folder.mkdir()
    script = folder / "script.txt"
    script.write_text("\n".join([*lines, "quit"]) + "\n")
    display = soak_window.Display()
    try:
        arguments = ["sphere", *words(SETTINGS), "--script", script]
        window = soak_window.Window(options.program, display, folder, arguments, **variables)
        if killed_after is not None and window.wait_for(folder / "mark.csv", 120):
            time.sleep(killed_after)
            display.go_away()
        return window.wait(120), window.told()
    finally:
        display.close()


def whole_session(options, folder):
    """The session that a window has kept, gone on with to its end."""
    kept = [journal.parent for journal in (folder / "state/nextview").glob("*/journal")]
    if len(kept) != 1:
        return None, f"{len(kept)} sessions were kept"
    done = run(options.program, "scan", "--resume", kept[0], "--no-pictures")
    return kept[0], "" if done.returncode == 0 else f"the session cannot be gone on with: {done.stderr[-500:]}"


def display_goes_away(options, folder):
    def lines(name):
        return ["step"] * 3 + [f'export-views "{folder / name}/mark.csv"'] + ["step"] * 27

    code, told = in_window(options, folder / "whole", lines("whole"))
    expected, fault = whole_session(options, folder / "whole")
    if code != 0 or fault:
        return [f"without a fault it ended with {code}: {told} {fault}"]
    faults, delays = [], random.Random(options.seed)
    for number in range(3):
        name = f"killed_{number}"
        code, told = in_window(options, folder / name, lines(name), killed_after=delays.uniform(0, 1))
        if code != 2 or sum(line.startswith("nextview: ") for line in told.splitlines()) != 1:
            faults.append(f"ended with {code}: {told}")
        kept, fault = whole_session(options, folder / name)
        faults += [fault] if fault else [f"{file} is another one" for file in different(kept, expected)]
    return faults


def library(folder, name):
    """What is loaded before the program."""
    built = folder / f"{name}.so"
    source = pathlib.Path(__file__).with_name(f"{name}.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", built, source, "-ldl"], check=True)
    return str(built)


def context_goes_away(options, folder):
    """Pictures of window and scene, with and without, while all that can be drawn is shown."""
    losses = 12
    lost = {"LD_PRELOAD": library(folder, "lost_context"), "NEXTVIEW_LOSE_CONTEXT": str(losses),
            "NEXTVIEW_WINDOWS": str(folder / "windows")}
    for name, variables in (("never", {}), ("lost", lost)):
        out = folder / name
        lines = []
        for number in range(6):
            lines += ["step", "panel view", f"select-view {number}", "turn 60 0", "wait 0.5", "second-view octree",
                      "toggle-surface", "wait until done", "turn -60 0", "full-screen", "wait 0.5", "full-screen",
                      f'export-picture "{out}/scene_{number}.png" 320x240', "second-view none", "toggle-surface",
                      "dark", "panel session"]
        code, told = in_window(options, out, [*lines, f'export "{out}/scan"'], **variables)
        if code != 0 or told:
            return [f"{name}: ended with {code}: {told}"]
    windows = int((folder / "windows").read_text())
    faults = [] if windows == losses + 1 else [f"{windows} windows for {losses} losses"]
    for number in range(6):
        file = f"scene_{number}.png"
        if (folder / "never" / file).read_bytes() != (folder / "lost" / file).read_bytes():
            faults.append(f"{file} is another one")
    return faults + [f"{file} is another one" for file in different(folder / "lost/scan", folder / "never/scan")]


def below_zero(folder):
    """Seconds that nothing can have taken."""
    faults = []
    for file in folder.rglob("timings.csv"):
        for row in csv.DictReader(file.open()):
            faults += [f"{file.name}: {name} is {value}" for name, value in row.items() if value.startswith("-")]
    return faults


def clock_goes_back(options, folder):
    back = {"LD_PRELOAD": library(folder, "clock_back"), "NEXTVIEW_CLOCK_BACK": "100"}
    asked = run(sys.executable, "-c", "import time; time.sleep(0.5); print(time.time())", **back)
    faults = [] if float(asked.stdout) < time.time() - 3600 else ["the clock was not set back"]
    for name, variables in (("steady", {}), ("back", back)):
        settings = words({**SETTINGS, "termination.views": 6})
        done = run(options.program, "scan", "sphere", *settings, "--out", folder / name, **variables)
        if done.returncode != 0:
            faults.append(f"scan: ended with {done.returncode}: {done.stderr[-500:]}")
        out = folder / f"{name} window"
        code, told = in_window(options, out, ["step"] * 6 + [f'export "{out}/scan"'], **variables)
        if code != 0 or told:
            faults.append(f"window: ended with {code}: {told}")
    for before, after in (("steady", "back"), ("steady window/scan", "back window/scan")):
        faults += [f"{after}: {file} is another one" for file in different(folder / after, folder / before)]
    return faults + below_zero(folder / "back") + below_zero(folder / "back window")
