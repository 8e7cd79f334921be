"""An invisible X server, and keys and mouse for it, which tests of windows share."""
import ctypes
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import harness

TOOLS = {"Xvfb": "xvfb", "xdotool": "xdotool", "import": "imagemagick", "identify": "imagemagick"}


def need(renderer):
    """Skips the file's tests if something is missing."""
    library = pathlib.Path(os.environ["SWARMANOID_BUILD"]) / "lib" / "swarmanoid" / f"libswarmanoid_{renderer}.so"
    if not library.exists():
        harness.skip(f"{renderer} is not part of this build")
    missing = [f"{tool} (package {package})" for tool, package in TOOLS.items() if shutil.which(tool) is None]
    if missing:
        harness.skip("there is no " + ", no ".join(missing))


class Display:
    """One Xvfb, ended by close()."""

    def __init__(self, size="1280x900"):
        reader, writer = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", size + "x24", "-nolisten", "tcp", "-noreset"],
                                       pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as answer:
            number = answer.readline().strip()
        if not number:
            harness.skip("Xvfb does not start")
        self.name = ":" + number
        self.environment = {"DISPLAY": self.name, "LIBGL_ALWAYS_SOFTWARE": "1"}

    def close(self):
        self.server.send_signal(signal.SIGTERM)
        self.server.wait(60)

    def tool(self, *words, check=True):
        done = subprocess.run([str(w) for w in words], env={**os.environ, **self.environment}, capture_output=True, text=True,
                              timeout=100)
        if check and done.returncode != 0:
            raise AssertionError(f"{words}: {done.stderr}")
        return done.stdout.strip()

    def window(self, title, timeout=100, run=None):
        """The window with this title, as soon as it is there; keys go to it from then on."""
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            found = self.tool("xdotool", "search", "--onlyvisible", "--name", f"^{title}$", check=False).split()
            if found and self.focus(found[0]):
                return found[0]
            if run is not None and run.process.poll() is not None:
                raise AssertionError("the run ended before its window was there: " + run.process.stderr.read())
            time.sleep(0.05)
        raise AssertionError(f"no window '{title}' after {timeout} s")

    def focus(self, window):
        """False if it has gone: some windows are made twice before they stay."""
        try:
            self.tool("xdotool", "windowfocus", "--sync", window)
        except AssertionError as error:
            if "BadWindow" not in str(error):
                raise
            return False
        return True

    def windows(self, title):
        return self.tool("xdotool", "search", "--name", f"^{title}$", check=False).split()

    def key(self, *keys):
        for key in keys:
            self.tool("xdotool", "key", key)

    def click(self, x, y, button=1):
        self.tool("xdotool", "mousemove", int(x), int(y), "click", button)

    def drag(self, start, end, button=1, hold=None):
        words = ["keydown", hold] if hold else []
        words += ["mousemove", *map(int, start), "mousedown", button, "sleep", "0.1"]
        # In steps, as a hand does it.
        for step in range(1, 5):
            words += ["mousemove", *(int(a + (b - a) * step / 4) for a, b in zip(start, end)), "sleep", "0.05"]
        words += ["mouseup", button] + (["keyup", hold] if hold else [])
        self.tool("xdotool", *words)

    def screenshot(self, path):
        self.tool("import", "-window", "root", path)

    def colours_now(self, area):
        """The number of colours in an area of the screen, WIDTHxHEIGHT+X+Y."""
        with tempfile.NamedTemporaryFile(suffix=".png") as picture:
            self.screenshot(picture.name)
            return int(self.tool("convert", picture.name, "-crop", area, "+repage", "-format", "%k", "info:"))

    def ask_to_close(self, window):
        """What a window manager sends when somebody clicks on the cross."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XInternAtom.restype = ctypes.c_ulong

        class ClientMessage(ctypes.Structure):
            _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                        ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong),
                        ("format", ctypes.c_int), ("data", ctypes.c_long * 5), ("padding", ctypes.c_long * 24)]

        display = ctypes.c_void_p(x11.XOpenDisplay(self.name.encode()))
        atom = lambda name: x11.XInternAtom(display, name, 0)
        message = ClientMessage(type=33, window=int(window), message_type=atom(b"WM_PROTOCOLS"), format=32)
        message.data[0] = atom(b"WM_DELETE_WINDOW")
        x11.XSendEvent(display, ctypes.c_ulong(int(window)), 0, ctypes.c_long(0), ctypes.byref(message))
        x11.XCloseDisplay(display)
