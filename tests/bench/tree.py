"""A build of the project, its programs, and those of its peers, run one at a time."""
import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor


class Failed(Exception):
    """A program that did not do its work."""


def run(command, env=None, cwd=None):
    """Runs a command: what it printed, the seconds by the clock, and its peak memory in MB."""
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as errors:
        start = time.perf_counter()
        process = subprocess.Popen(command, env={**os.environ, **(env or {})}, cwd=cwd,
                                   stdin=subprocess.DEVNULL, stdout=out, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        errors.seek(0)
        if process.returncode != 0:
            said = errors.read().strip() or out.read().strip()
            raise Failed(f"{command[0]}: {said[-300:]}")
        return out.read(), seconds, usage.ru_maxrss / 1000


def names(text, known, option):
    """The names of a list on the command line; None for all, and "none" for none of them."""
    if text is None:
        return None
    wanted = [] if text == "none" else text.split(",")
    unknown = [name for name in wanted if name not in known]
    if unknown:
        sys.exit(f"{option}: there is no {unknown[0]!r}; there are {', '.join(known)}")
    return wanted


def figures(text):
    """The figures that a program printed, one a line behind its name."""
    lines = (line.split() for line in text.splitlines())
    return {words[0]: float(words[1]) for words in lines if len(words) == 2}


class Tree:
    """A source tree, its build folder, and the device that its programs use."""

    def __init__(self, top, build, device=None):
        self.top, self.build, self.device, self.env = top, build, device, {}
        if device:
            self.env["RT_TEST_DEVICE"] = device

    def rtc(self, *arguments, env=None):
        device = ["--device", self.device] if self.device else []
        command = [os.path.join(self.build, "rtc"), *map(str, arguments), *device]
        return run(command, {**self.env, **(env or {})}, cwd=self.top)

    def render(self, *arguments, out=None, env=None):
        """What --stats tells of a render, with the seconds and the memory of the process."""
        out = out or os.path.join(self.build, "bench", "picture.pfm")
        text, seconds, memory = self.rtc(*arguments, "--quiet", "--progress", "none", "--stats",
                                         "--json", "--out", out, env=env)
        return {**json.loads(text), "seconds": seconds, "memory": memory}

    def render_twice(self, *arguments):
        """What two renders at once tell, of one thread each: what the machine has for two."""
        outs = [os.path.join(self.build, "bench", f"picture{i}.pfm") for i in range(2)]
        with ThreadPoolExecutor(2) as pool:
            return list(pool.map(
                lambda out: self.render(*arguments, "--threads", 1, out=out), outs))

    def program(self, name, *arguments):
        command = [os.path.join(self.build, "tests/bench", name), *map(str, arguments)]
        return figures(run(command, self.env, cwd=self.top)[0])


PYTHON = os.environ.get("PYTHON", sys.executable)


def has_mitsuba():
    return subprocess.run([PYTHON, "-c", "import mitsuba"], capture_output=True,
                          check=False).returncode == 0


def mitsuba(top, *arguments):
    """Figures of a run of Mitsuba's, its peak memory among them."""
    script = os.path.join(top, "tests/bench/peers/mitsuba_bench.py")
    text, _, memory = run([PYTHON, script, *map(str, arguments)], cwd=top)
    return {**figures(text), "memory": memory}


def make_inputs(tree):
    """The mesh, and where Mitsuba is there the sky, that scenes of the benchmark read."""
    folder = os.path.join(tree.build, "bench")
    os.makedirs(folder, exist_ok=True)
    mesh, sky = os.path.join(folder, "mesh.ply"), os.path.join(folder, "sky.exr")
    if not os.path.exists(mesh):
        run([os.path.join(tree.build, "rtc"), "mesh", "knot", "--triangles", "1.5e6", "--out",
             mesh], cwd=tree.top)
    if not os.path.exists(sky) and has_mitsuba():
        mitsuba(tree.top, "--sky", sky)


def intel_environment(folder):
    """What makes Intel's runtime from PyPI the only driver, where it is there; else nothing."""
    prefix = os.environ.get("INTEL_OPENCL", sys.prefix)
    found = glob.glob(os.path.join(prefix, "lib", "libintelocl.so"))
    if not found:
        return {}
    vendors = os.path.join(folder, "vendors")
    shutil.rmtree(vendors, ignore_errors=True)
    os.makedirs(vendors)
    with open(os.path.join(vendors, "intel.icd"), "w", encoding="utf-8") as file:
        file.write(found[0] + "\n")
    libraries = os.path.dirname(found[0])
    return {"OCL_ICD_VENDORS": vendors,
            "LD_LIBRARY_PATH": libraries + ":" + os.environ.get("LD_LIBRARY_PATH", "")}


def first_line(command, cwd):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    return done.stdout.strip().splitlines()[0] if done.stdout.strip() else "unknown"


def describe(tree):
    """The machine, the driver and the commit, for the head of the page."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    with open("/proc/meminfo", encoding="utf-8") as file:
        memory = int(file.readline().split()[1]) / 2**20
    commit = first_line(["git", "describe", "--always", "--dirty"], tree.top)
    text = tree.rtc("doctor")[0]
    opened = [line for line in text.splitlines() if "opened " in line]
    driver = opened[0].split("opened ", 1)[1].split(";")[0] if opened else "unknown"
    return {"cpu": models[0] if models else "unknown", "cores": os.cpu_count(),
            "memory_gib": round(memory, 1), "driver": driver, "commit": commit,
            "date": time.strftime("%Y-%m-%d")}
