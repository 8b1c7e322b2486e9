"""test_exit.py - interpreters end well, whatever the order in which their objects go.

Each program runs in an interpreter of its own, up to its very end. With a library that is built for
the address sanitizer, as by `make check-sanitize`, Python has to load the sanitizer first:

    export LIBRT_LIBRARY=build/sanitize/librt-render.so.0
    export ASAN_OPTIONS=detect_leaks=0:use_sigaltstack=0:exitcode=99
    LD_PRELOAD="$(cc -print-file-name=libasan.so) $(cc -print-file-name=libubsan.so)" \\
        python test_exit.py
"""
import os
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor
from itertools import permutations

from test_python import SCENE, run_tests

BEGIN = f"""
import atexit, gc, os, sys, threading, time, weakref
import librt_render as rt
TEXT = '''{SCENE}'''
memory = rt.Memory()
device = rt.Device(threads=1, memory=memory)
scene = rt.Scene.parse(TEXT, memory=memory)
renderer = rt.Renderer(scene, device)
"""

RENDER = "film = renderer.render(spp=1, aov=True)\n"

# What becomes of a renderer that has rendered nothing, or of what it has made.
ENDS = {
    "nothing is deleted": "",
    "a renderer refers to itself": "renderer.me = renderer",
    "all refer to all": """
for each in (memory, device, scene, renderer):
    each.all = (renderer, scene, device, memory)""",
    "a cycle is collected at once": """
for each in (memory, device, scene, renderer):
    each.all = (renderer, scene, device, memory)
del each, memory, device, scene, renderer
gc.collect()""",
    "nothing is collected": "gc.disable()\nrenderer.me = renderer",
    "all is frozen": "renderer.me = renderer\ngc.freeze()",
    "an exception ends the program": """
def fail(held):
    raise SystemError("expected")
fail(renderer)""",
    "a program exits in a function": """
def leave(held):
    sys.exit(0)
leave(renderer)""",
    "the interpreter's own module has it": "sys.renderer = renderer\nsys.scene = scene",
    "an exit function has the last reference": """
atexit.register(lambda held: None, renderer)
del memory, device, scene, renderer""",
    "an exit function renders": "atexit.register(renderer.render, spp=1)",
    "a finalizer of another object renders": """
class Last:
    def __del__(self):
        self.renderer.render(spp=1)
last = Last()
last.renderer, last.me = renderer, last
del memory, device, scene, renderer""",
    "a finalizer of another module renders": """
class Last:
    def __del__(self):
        try:
            renderer.render(spp=1, width=16, height=16)
        except Exception:
            pass
sys.modules["last"] = Last()""",
    "a weak reference tells its end": "weakref.finalize(renderer, lambda: None)",
    "a thread has the last reference": """
def render(renderer):
    time.sleep(0.1)
    renderer.render(spp=1)
threading.Thread(target=render, args=(renderer,)).start()
del memory, device, scene, renderer""",
    "a thread's own storage has it": """
local = threading.local()
local.renderer, local.scene = renderer, scene
del memory, device, scene, renderer""",
    "a daemon sleeps with it": """
threading.Thread(target=lambda held: time.sleep(60), args=(renderer,), daemon=True).start()
del memory, device, scene, renderer""",
    "a daemon renders": """
threading.Thread(target=lambda: renderer.render(spp=1 << 20), daemon=True).start()
time.sleep(0.5)""",
    "a daemon makes renderers": """
def make():
    while True:
        rt.Renderer(scene, device)
threading.Thread(target=make, daemon=True).start()
time.sleep(0.2)""",
    "a fork ends first": """
child = os.fork()
if child != 0:
    assert os.waitpid(child, 0)[1] == 0""",
    "a fork cannot use the device": """
child = os.fork()
if child == 0:
    for use in (lambda: renderer.render(spp=1), rt.Device):
        try:
            use()
        except RuntimeError:
            continue
        os._exit(1)
    os._exit(0)
assert os.waitpid(child, 0)[1] == 0""",
    "a film outlives all": RENDER + "del memory, device, scene, renderer",
    "an array outlives all": RENDER + """
array = film["albedo"]
del memory, device, scene, renderer, film
assert array.max() > 0""",
    "a film is in a cycle": RENDER + "film.renderer = renderer\nrenderer.film = device.film = film",
    "a photon map outlives all": """
photons = renderer.emit(photons=20000).photons()
del memory, device, scene, renderer
assert len(photons) > 0""",
    "a callback is the end": """
def stop(progress):
    raise SystemExit(0)
renderer.render(spp=1 << 20, progress=stop)""",
    "a cycle is collected in a callback": """
def collect(progress):
    gc.collect()
    return True
second = rt.Renderer(scene, device)
second.me = second
del second
try:
    renderer.render(spp=1 << 20, progress=collect)
except rt.Cancelled:
    pass
used = memory.info.used
del renderer, scene
gc.collect()
assert memory.info.used < used""",
    "two devices are crossed": """
others = rt.Device(threads=1), rt.Scene.parse(TEXT)
other = rt.Renderer(others[1], others[0])
other.first, renderer.second = renderer, other
del device, others""",
}
ENDS.update({f"{' then '.join(order)} goes": f"del {', '.join(order)}" for order in
             permutations(("device", "memory", "renderer", "scene"))})


def run(end):
    """What an interpreter says that ends so."""
    return subprocess.run([sys.executable, "-c", BEGIN + end], capture_output=True, text=True,
                          timeout=300)


class Exit(unittest.TestCase):
    def test_an_interpreter_ends_well_in_any_order(self):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            runs = dict(zip(ENDS, pool.map(run, ENDS.values())))
        self.assertGreaterEqual(len(runs), 20)
        for name, ended in runs.items():
            is_wrong = "SystemError" in ENDS[name]
            with self.subTest(name):
                self.assertEqual(ended.returncode, 1 if is_wrong else 0, ended.stderr)
                if not is_wrong:
                    self.assertEqual(ended.stderr, "")


if __name__ == "__main__":
    run_tests("test_exit")
