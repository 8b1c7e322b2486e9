"""Time to equal error: the seconds in which a picture of each scene reaches an error.

The error is the root of the mean squared difference from a kept reference, over the mean of that.
It is measured at 1, 4, 16 ... samples a pixel and interpolated between them, logarithm by
logarithm; beyond the last, the first to take LONGEST seconds, it falls as the root of the time,
and a tilde says so. Seconds are those of the render alone: without start, reading of the scene,
build of the hierarchy and compilation of kernels, in both programs.
"""
import json
import math
import os
import shlex
import statistics
import tempfile

from tree import Failed, has_mitsuba, mitsuba

SCENES = ["box_area", "box_point", "box_caustic", "mesh", "glass_metal", "many_lights", "doorway",
          "image_sky"]
SAMPLERS = ["multijitter", "orthogonal", "ldsampler"]
TARGETS = ["5", "1"]  # percent
LADDER = [4**i for i in range(9)]
LONGEST = 1.0


def scene_file(tree, name):
    own = os.path.join("tests/bench/scenes", name + ".rts")
    if os.path.exists(os.path.join(tree.top, own)):
        return [own]
    return [os.path.join("scenes", name + ".rts"), "--width", 128, "--height", 128]


def relative_error(tree, picture, reference):
    """Without the error of the reference itself. One block is the whole picture."""
    told = json.loads(tree.rtc("compare", picture, reference, "--block", 4096, "--json")[0])
    error = told["rmse"] / statistics.mean(told["worst"]["reference"])
    with open(os.path.splitext(reference)[0] + ".txt", encoding="utf-8") as file:
        own = float(file.read())
    return math.sqrt(max(error**2 - own**2, (0.1 * error) ** 2))


def time_to(target, steps):
    """Seconds to an error, from steps of (seconds, error), and whether they are extrapolated."""
    for (time0, error0), (time1, error1) in zip(steps, steps[1:]):
        if error1 <= target < error0:
            part = math.log(error0 / target) / math.log(error0 / error1)
            return time0 * (time1 / time0) ** part, False
    seconds, error = steps[0] if steps[0][1] <= target else steps[-1]
    return seconds * (error / target) ** 2, True


def our_steps(tree, name, seed, reference, folder):
    steps = []
    options = shlex.split(os.environ.get("RTC_OPTIONS", ""))
    for spp in LADDER:
        out = os.path.join(folder, "ours.pfm")
        stats = tree.render(*scene_file(tree, name), "--spp", spp, "--seed", seed, *options,
                            out=out)
        steps.append((stats["render_seconds"], relative_error(tree, out, reference)))
        if steps[-1][0] > LONGEST or steps[-1][1] < 0.01:
            break
    return steps


def their_steps(tree, name, sampler, seed, reference, folder):
    told = mitsuba(tree.top, name, *LADDER, "--sampler", sampler, "--seed", seed, "--until",
                   LONGEST, "--out", folder)
    spps = [spp for spp in LADDER if str(spp) in told]
    return [(told[str(spp)],
             relative_error(tree, os.path.join(folder, f"{spp}.pfm"), reference)) for spp in spps]


def best_sampler(found):
    """The sampler that is the fastest to 1 %, or that of the first run."""
    times = {name: statistics.median(found[name]["1"]) for name in SAMPLERS if name in found}
    return min(times, key=times.get) if times else None


def add(found, who, steps):
    entry = found.setdefault(who, {"5": [], "1": [], "beyond": [], "steps": steps})
    for target in TARGETS:
        seconds, beyond = time_to(0.01 * float(target), steps)
        entry[target].append(seconds)
        if beyond and target not in entry["beyond"]:
            entry["beyond"].append(target)


def collect(tree, wanted, runs, results):
    """Adds the times of the scenes to `results`, and returns what failed."""
    failures = set()
    peer = has_mitsuba()
    for name in SCENES if wanted is None else wanted:
        reference = os.path.join(tree.top, "tests/bench/reference", name + ".exr")
        found = {}
        try:
            with tempfile.TemporaryDirectory() as folder:
                for seed in range(1, runs + 1):
                    add(found, "ours", our_steps(tree, name, seed, reference, folder))
                    samplers = SAMPLERS if seed == 1 else [best_sampler(found)]
                    for who in ["independent", *samplers] if peer else []:
                        add(found, who, their_steps(tree, name, who, seed, reference, folder))
            results[name] = found
        except (Failed, OSError, KeyError, ValueError) as error:
            failures.add(f"{name}: {error}")
    return failures


def show(entry, target):
    if entry is None:
        return "-"
    values = entry[target]
    middle = statistics.median(values)
    half = (max(values) - min(values)) / 2 / middle
    return f"{'~' if target in entry['beyond'] else ''}{middle:.3g} ± {100 * half:.0f} %"


def table(results):
    """The lines of the page."""
    if not results:
        return []
    lines = ["Time to equal error: seconds until the relative RMSE is 5 % and 1 %, and ours as a "
             "part of Mitsuba's with its best sampler. A tilde: extrapolated.", "",
             "| scene | error | ours, s | Mitsuba, independent, s | Mitsuba, best sampler, s | "
             "ours / best |", "|---|---|---|---|---|---|"]
    parts = []
    for name, found in results.items():
        best = best_sampler(found)
        for target in TARGETS:
            part = "-"
            if best:
                parts.append(statistics.median(found["ours"][target]) /
                             statistics.median(found[best][target]))
                part = f"{parts[-1]:.2f}"
            lines.append(f"| {name} | {target} % | {show(found['ours'], target)} | "
                         f"{show(found.get('independent'), target)} | "
                         f"{show(found.get(best), target)} {best or ''} | {part} |")
    if parts:
        mean = math.exp(statistics.mean(map(math.log, parts)))
        good = "reached" if mean <= 0.2 and max(parts) <= 0.5 else "not reached"
        lines += ["", f"Geometric mean {mean:.3f} (target 0.2), worst {max(parts):.2f} (0.5): "
                  f"{good}."]
    return lines + [""]
