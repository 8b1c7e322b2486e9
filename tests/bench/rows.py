"""The rows of the benchmark: what is measured, how, and what it must reach.

A measurement runs programs once and returns figures by name; a row compares two of them. Its ratio
tells how many times as fast, or as small, ours is as the peer, or as the limit, so above 1 is
better, and the target is the least ratio.
"""
import os
import shutil
import time
from dataclasses import dataclass

from tree import Failed, Tree, has_mitsuba, intel_environment, mitsuba, run


@dataclass
class Row:
    """Where `limit` is given, that is what ours is compared with; else the figure `peer`."""
    what: str
    unit: str
    ours: str
    peer: str = ""
    peer_name: str = ""
    target: float = 0.0
    limit: float = 0.0
    smaller_is_better: bool = False


ROWS = [
    Row("path tracing, Cornell box of 32 triangles, 512 x 512, 64 samples, depth 8", "Msamples/s",
        "cornell.ours", "cornell.mitsuba", "Mitsuba llvm", 1.5),
    Row("the same with --roulette-threshold 1", "Msamples/s",
        "cornell.roulette", "cornell.mitsuba", "Mitsuba llvm"),
    Row("the same, peak memory of the process", "MB",
        "cornell.ours.memory", "cornell.mitsuba.memory", "Mitsuba llvm", smaller_is_better=True),
    Row("path tracing, mesh of 1.5 M triangles, area light and even sky, 512 x 512, 16 samples, "
        "depth 8", "Msamples/s", "mesh.ours", "mesh.mitsuba", "Mitsuba llvm", 1.5),
    Row("the same, peak memory of the process", "MB",
        "mesh.ours.memory", "mesh.mitsuba.memory", "Mitsuba llvm", 1.0, smaller_is_better=True),
    Row("the same, load the binary PLY file and build", "s",
        "mesh.load.ours", "mesh.load.mitsuba", "Mitsuba llvm", 1.0, smaller_is_better=True),
    Row("closest hit, 1.5 M triangles, 1 M camera rays in tiles of 8 x 8", "Mrays/s",
        "camera.ours", "camera.embree", "Embree 3", 1.3),
    Row("the same, diffuse rays", "Mrays/s", "diffuse.ours", "diffuse.embree", "Embree 3", 1.2),
    Row("build of the hierarchy over these triangles", "s",
        "build.ours", "build.embree", "Embree 3", 1.0, smaller_is_better=True),
    Row("progressive photon mapping, 512 x 512 eye paths and light paths a pass, depth 10",
        "passes/s", "passes.ours", "passes.smallvcm", "SmallVCM ppm", 4.0),
    Row("photon gather on the host, k = 50 of 1 M, 100 k queries", "k queries/s",
        "gather.host", "gather.flann", "FLANN", 1.0),
    Row("photon gather on the device, the same", "k queries/s",
        "gather.device", "gather.flann", "FLANN", 5.0),
    Row("compile cold to first sample, path", "s", "cold.path", limit=5.0, target=1.0,
        smaller_is_better=True),
    Row("compile cold to first sample, photon", "s", "cold.photon", limit=5.0, target=1.0,
        smaller_is_better=True),
    Row("start to first sample, warm, path", "s", "warm.path", limit=0.2, target=1.0,
        smaller_is_better=True),
    Row("start to first sample, warm, photon", "s", "warm.photon", limit=0.2, target=1.0,
        smaller_is_better=True),
    Row("path tracing with 2 threads beside 1", "Msamples/s",
        "threads.two", "threads.one", "1 thread", 1.9),
    Row("the same beside two renders at once", "Msamples/s",
        "threads.two", "threads.apart", "2 x 1 thread", 0.95),
    Row("photon passes with 2 threads beside 1", "passes/s",
        "threads.photon.two", "threads.photon.one", "1 thread", 1.9),
    Row("the same beside two renders at once", "passes/s",
        "threads.photon.two", "threads.photon.apart", "2 x 1 thread", 0.95),
    Row("on Intel's runtime: path tracing, the Cornell box of 32 triangles", "Msamples/s",
        "intel.cornell", "cornell.ours", "PoCL"),
    Row("the same, closest hit, camera rays", "Mrays/s", "intel.camera", "camera.ours", "PoCL"),
    Row("the same, closest hit, diffuse rays", "Mrays/s", "intel.diffuse", "diffuse.ours", "PoCL"),
    Row("the same, progressive photon mapping", "passes/s", "intel.passes", "passes.ours", "PoCL"),
]


def rate(stats):
    """Million samples a second."""
    return 1e-6 * stats["spp"] * stats["width"] * stats["height"] / stats["render_seconds"]


def measure_cornell(tree):
    plain = tree.render("tests/bench/cornell32.rts")
    more = tree.render("tests/bench/cornell32.rts", "--roulette-threshold", 1)
    return {"cornell.ours": rate(plain), "cornell.ours.memory": plain["memory"],
            "cornell.roulette": rate(more)}


def peer_cornell(tree):
    their = mitsuba(tree.top, "cornell32", 64)
    return {"cornell.mitsuba": 512 * 512 * 64e-6 / their["64"],
            "cornell.mitsuba.memory": their["memory"]}


def measure_mesh(tree):
    stats = tree.render("tests/bench/scenes/mesh.rts", "--width", 512, "--height", 512,
                        "--spp", 16)
    start = time.perf_counter()
    tree.rtc("check", "--quiet", "tests/bench/scenes/mesh.rts")
    return {"mesh.ours": rate(stats), "mesh.ours.memory": stats["memory"],
            "mesh.load.ours": time.perf_counter() - start + stats["build_seconds"]}


def peer_mesh(tree):
    their = mitsuba(tree.top, "mesh", 16, "--size", "512x512")
    return {"mesh.mitsuba": 512 * 512 * 16e-6 / their["16"], "mesh.load.mitsuba": their["load"],
            "mesh.mitsuba.memory": their["memory"]}


def measure_passes(tree):
    return tree.program("bench_progressive", "scenes/cornell.rts", 20)


def peer_passes(tree):
    """By the clock over the difference of two runs: it prints the CPU time of all threads."""
    folder = os.environ["SMALLVCM"]
    out = os.path.join(os.path.abspath(tree.build), "bench", "smallvcm.bmp")
    seconds = [run([os.path.join(folder, "smallvcm"), "-s", "1", "-a", "ppm", "-i", str(passes),
                    "-o", out])[1] for passes in (2, 22)]
    return {"passes.smallvcm": 20 / (seconds[1] - seconds[0])}


def first_sample(tree, mode, cache):
    env = {"POCL_CACHE_DIR": cache, "XDG_CACHE_HOME": cache}
    return tree.render("scenes/cornell.rts", "--mode", mode, "--width", 8, "--height", 8,
                       "--spp", 1, "--photons", 100, env=env)["seconds"]


def measure_start(tree):
    cache = os.path.join(os.path.abspath(tree.build), "bench", "cache")
    found = {}
    for mode in ("path", "photon"):
        shutil.rmtree(cache, ignore_errors=True)
        os.makedirs(cache)
        found["cold." + mode] = first_sample(tree, mode, cache)
        found["warm." + mode] = first_sample(tree, mode, cache)
    return found


def pass_rate(stats):
    return stats["passes"] / (stats["emit_seconds"] + stats["gather_seconds"])


def measure_threads(tree):
    """Two renders at once, of one thread each, show what the machine has for two threads."""
    path = ("tests/bench/cornell32.rts", "--spp", 16)
    photon = ("scenes/cornell.rts", "--mode", "photon", "--passes", 6, "--photons", 1000000,
              "--radius", 0.0054)
    found = {}
    for name, of, work in (("threads.", rate, path), ("threads.photon.", pass_rate, photon)):
        found[name + "one"] = of(tree.render(*work, "--threads", 1))
        found[name + "two"] = of(tree.render(*work, "--threads", 2))
        found[name + "apart"] = sum(map(of, tree.render_twice(*work)))
    return found


def measure_intel(tree):
    """Ours on a second driver, where it is there and is not the one that all rows are taken on."""
    environment = {} if tree.device else intel_environment(os.path.join(tree.build, "bench"))
    if not environment:
        return {}
    other = Tree(tree.top, tree.build)
    other.env.update(environment)
    traced = other.program("bench_trace")
    return {"intel.cornell": rate(other.render("tests/bench/cornell32.rts")),
            "intel.camera": traced["camera.ours"], "intel.diffuse": traced["diffuse.ours"],
            "intel.passes": measure_passes(other)["passes.ours"]}


@dataclass
class Measurement:
    name: str
    ours: object          # called with the tree; a program that runs ours and the peer in turn
    peer: object = None   # the same for the peer, where that is another program
    needs: object = None  # whether the peer is there


MEASUREMENTS = [
    Measurement("cornell", measure_cornell, peer_cornell, has_mitsuba),
    Measurement("mesh", measure_mesh, peer_mesh, has_mitsuba),
    Measurement("trace", lambda tree: tree.program("bench_trace")),
    Measurement("passes", measure_passes, peer_passes, lambda: bool(os.environ.get("SMALLVCM"))),
    Measurement("gather", lambda tree: tree.program("bench_gather")),
    Measurement("start", measure_start),
    Measurement("threads", measure_threads),
    Measurement("intel", measure_intel),
]


def take(tree, measurement, with_peer):
    """One run of a measurement: its figures, and what failed."""
    found, failures = {}, []
    for part in (measurement.ours, measurement.peer if with_peer else None):
        if part is None:
            continue
        try:
            found.update(part(tree))
        except (Failed, OSError, KeyError, ValueError) as error:
            failures.append(f"{measurement.name}: {error}")
    return found, failures
