"""A display of its own, the program in a window on it, and what that program has of the machine."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time


def start(command, **more):
    return subprocess.Popen(command, start_new_session=True, **more)


def end(process, how=signal.SIGTERM):
    if process.poll() is None:
        process.send_signal(how)
    process.wait(30)


class Display:
    """Xvfb with a window manager: small, as every pixel is drawn by the processor."""

    def __init__(self):
        self.server = start(["Xvfb", "-displayfd", "1", "-noreset", "-nolisten", "tcp", "-screen", "0", "640x480x24"],
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.name = f":{self.server.stdout.readline().strip()}"
        if self.name == ":":
            raise RuntimeError("Xvfb does not start; install xvfb")
        self.environment = {**os.environ, "DISPLAY": self.name}
        # A window that is opened while the manager begins may never be told that it is seen; GLFW waits for that.
        with tempfile.TemporaryDirectory() as folder:
            begun = pathlib.Path(folder) / "begun"
            self.manager = start(["openbox", "--startup", f"touch '{begun}'"], env=self.environment,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            until = time.monotonic() + 30
            while not begun.exists():
                if self.manager.poll() is not None or time.monotonic() > until:
                    raise RuntimeError("openbox does not start; install openbox")
                time.sleep(0.02)

    def xdotool(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, timeout=60, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)

    def go_away(self):
        end(self.server, signal.SIGKILL)

    def close(self):
        for process in (self.manager, self.server):
            end(process)


class Window:
    """The program with a script in it. Its sessions and files are below `folder`."""

    def __init__(self, program, display, folder, arguments, **variables):
        self.folder = folder
        with open(folder / "told", "wb") as told:
            self.process = start([program, "window", *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=told,
                                 env={**display.environment, "XDG_STATE_HOME": str(folder / "state"), **variables})

    def told(self):
        return (self.folder / "told").read_text(errors="replace")

    def wait(self, seconds):
        """Its exit code; None if it does not end."""
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None

    def wait_for(self, file, seconds):
        """Whether the file comes before the program ends."""
        until = time.monotonic() + seconds
        while not file.exists() and self.process.poll() is None and time.monotonic() < until:
            time.sleep(0.05)
        return file.exists()

    def sample(self):
        """Memory [MB], descriptors, threads."""
        here = pathlib.Path("/proc") / str(self.process.pid)
        status = dict(line.split(":", 1) for line in (here / "status").read_text().splitlines() if ":" in line)
        return int(status["VmRSS"].split()[0]) / 1024, len(list((here / "fd").iterdir())), int(status["Threads"])
