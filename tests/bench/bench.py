#!/usr/bin/env python3
"""Measures the speed of the project beside its peers: one page.

    bench.py [--device NAME] [--runs N] [--only NAME,...] [--suite NAME,...|none] [--keep]
    bench.py --base DIR [...]

Run from the top directory, after the programs of the benchmark have been built; `make bench` does
both. Prints the page, and writes it to build/bench/bench.md and its figures to bench.json. Each
measurement is taken RUNS times (5), ours and the peer in turn. --keep begins with the figures of
an earlier bench.json, so that a page can be made in pieces.

--base compares with the build of another commit, in DIR/build, instead of with peers.
"""
import argparse
import json
import os
import statistics
import sys

import rows
import suite
from tree import Failed, Tree, describe, intel_environment, make_inputs, names


def spread(values):
    """Half of the range, as a part of the median."""
    middle = statistics.median(values)
    return (max(values) - min(values)) / 2 / middle if middle else 0.0


def show(values, unit=""):
    if not values:
        return "-"
    return f"{statistics.median(values):.3g} ± {100 * spread(values):.0f} % {unit}".rstrip()


def ratio_of(row, figures):
    """How many times as good ours is."""
    ours, peer = figures.get(row.ours), [row.limit] if row.limit else figures.get(row.peer)
    if not ours or not peer:
        return None
    ratio = statistics.median(ours) / statistics.median(peer)
    return 1 / ratio if row.smaller_is_better else ratio


def reached(row, ratio):
    if ratio is None or not row.target:
        return ""
    return "yes" if ratio >= row.target else "no"


def page_of(machine, figures, results, failures):
    lines = ["# Benchmark", "",
             f"{machine['cpu']}, {machine['cores']} cores, {machine['memory_gib']} GiB; "
             f"{machine['driver']}; commit {machine['commit']}, {machine['date']}.", "",
             "Medians, ± half of the range; the ratio is how many times as good ours is.", ""]
    lines += suite.table(results)
    lines += ["| what | ours | peer | ratio | target | reached |", "|---|---|---|---|---|---|"]
    for row in rows.ROWS:
        if not figures.get(row.ours):
            continue
        ratio = ratio_of(row, figures)
        peer = (f"at most {row.limit:g} {row.unit}" if row.limit
                else f"{row.peer_name} {show(figures.get(row.peer))}")
        lines.append(
            f"| {row.what} | {show(figures.get(row.ours), row.unit)} | {peer} | "
            f"{'-' if ratio is None else f'{ratio:.2f}'} | {row.target or ''} | "
            f"{reached(row, ratio)} |")
    if failures:
        lines += ["", "What failed:", ""] + [f"- {failure}" for failure in sorted(failures)]
    return "\n".join(lines) + "\n"


def collect(tree, wanted, runs, figures):
    """Adds the figures of all runs, and returns what failed."""
    failures = set()
    chosen = [m for m in rows.MEASUREMENTS if wanted is None or m.name in wanted]
    peers = {m.name: m.needs is not None and m.needs() for m in chosen}
    fresh = {}
    for count in range(runs):
        for measurement in chosen:
            print(f"run {count + 1} of {runs}: {measurement.name}", file=sys.stderr)
            found, failed = rows.take(tree, measurement, peers[measurement.name])
            failures.update(failed)
            for name, value in found.items():
                fresh.setdefault(name, []).append(value)
    figures.update(fresh)
    return failures


def compare(base, head, wanted, runs):
    """Ours at two commits, in turn: what moved, and what did not beyond the noise."""
    found = ({}, {})
    for count in range(runs):
        for measurement in rows.MEASUREMENTS:
            if wanted is not None and measurement.name not in wanted:
                continue
            print(f"run {count + 1} of {runs}: {measurement.name}", file=sys.stderr)
            for tree, into in zip((base, head), found):
                for name, value in rows.take(tree, measurement, False)[0].items():
                    into.setdefault(name, []).append(value)
    print("| what | base | head | times as good | moved |\n|---|---|---|---|---|")
    for row in rows.ROWS:
        before, after = (into.get(row.ours, []) for into in found)
        if not before and not after:
            continue
        if not before or not after:
            print(f"| {row.what} | {show(before, row.unit)} | {show(after, row.unit)} | - | |")
            continue
        ratio = statistics.median(after) / statistics.median(before)
        apart = min(after) > max(before) or max(after) < min(before)
        better = (ratio > 1) != row.smaller_is_better
        moved = ("better" if better else "worse") if apart else "within noise"
        print(f"| {row.what} | {show(before, row.unit)} | {show(after, row.unit)} | "
              f"{1 / ratio if row.smaller_is_better else ratio:.3f} | {moved} |")
    print("\nMoved: every run of one lies beyond every run of the other; by chance, of five runs "
          "each, 1 in 126.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--build", default="build")
    parser.add_argument("--device")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", help="names of measurements, or none")
    parser.add_argument("--suite", help="names of scenes, or none")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--base", help="a tree of another commit, built")
    arguments = parser.parse_args()
    if arguments.runs < 1:
        sys.exit(f"RUNS: {arguments.runs} runs measure nothing; give 1 or more")
    wanted = names(arguments.only, [m.name for m in rows.MEASUREMENTS], "ONLY")
    scenes = names(arguments.suite, suite.SCENES, "SUITE")
    top = os.getcwd()
    build = os.path.join(top, arguments.build)
    folder = os.path.join(build, "bench")
    if arguments.device and "intel" in arguments.device.lower():
        os.environ.update(intel_environment(folder))
    tree = Tree(top, build, arguments.device)
    make_inputs(tree)
    if arguments.base:
        base = Tree(os.path.abspath(arguments.base),
                    os.path.join(os.path.abspath(arguments.base), "build"), arguments.device)
        make_inputs(base)
        compare(base, tree, wanted, arguments.runs)
        return

    path = os.path.join(folder, "bench.json")
    kept = {"figures": {}, "suite": {}}
    if arguments.keep and os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            kept = json.load(file)
    machine, figures, results = describe(tree), kept["figures"], kept["suite"]
    failures = collect(tree, wanted, arguments.runs, figures)
    failures |= suite.collect(tree, scenes, arguments.runs, results)
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"machine": machine, "figures": figures, "suite": results}, file, indent=1)
    page = page_of(machine, figures, results, failures)
    with open(os.path.join(folder, "bench.md"), "w", encoding="utf-8") as file:
        file.write(page)
    print(page, end="")


if __name__ == "__main__":
    try:
        main()
    except Failed as error:
        sys.exit(str(error))
