"""test_python.py - the Python package against the C interface, closed forms and rt.h."""
import gc
import inspect
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
from pathlib import Path
from unittest import mock

import librt_render as rt
import numpy as np
from librt_render import _interface, _library

SCENE = """
camera { eye 0 1 -4  look_at 0 1 0  fov 40 }
film { width 32  height 24 }
material white { kd 0.7 }
plane { point 0 0 0  normal 0 1 0  material white }
sphere { centre 0 1 0  radius 1  material white }
light point { position 2 4 -3  intensity 20 }
"""


def built():
    """The same scene by calls."""
    scene = rt.Scene()
    scene.camera((0, 1, -4), (0, 1, 0), fov=40)
    scene.options = rt.Options(width=32, height=24)
    white = scene.material("white", kd=0.7)
    scene.plane((0, 0, 0), (0, 1, 0), material=white)
    scene.sphere((0, 1, 0), 1, material=white)
    scene.point_light((2, 4, -3), intensity=20)
    return scene


def resident_bytes():
    """The memory that this process has in use."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.device = rt.Device()
        cls.scene = rt.Scene.parse(SCENE)
        cls.renderer = rt.Renderer(cls.scene, cls.device)
        cls.film = cls.renderer.render(spp=4, aov=True)


class Interface(unittest.TestCase):
    def test_every_call_that_fills_a_scene_is_a_method_with_its_parameters(self):
        # Parameters that are structs, whose members are the method's.
        struct = {"material", "texture", "mesh", "light", "environment", "medium", "camera",
                  "grid", "portal"}
        for function, names in _interface.PARAMETERS.items():
            for prefix in ("rt_scene_add_", "rt_scene_set_"):
                if not function.startswith(prefix):
                    continue
                if function in ("rt_scene_set_memory", "rt_scene_set_root"):  # of the constructor
                    continue
                name = function[len(prefix):]
                if name == "options":
                    self.assertIsInstance(rt.Scene.options, property)
                    continue
                method = getattr(rt.Scene, name)
                wanted = [n for n in names if n not in ("scene", "out", "error", "surface")]
                wanted = [n for n in wanted if not n.endswith("_count") and n != "info"]
                given = list(inspect.signature(method).parameters)[1:]
                if wanted[-1] in struct:
                    wanted.pop()
                self.assertEqual(given[:len(wanted)], wanted, function)
                self.assertIn(_interface.DOCS[function], method.__doc__)

    def test_every_function_of_the_library_has_documentation(self):
        self.assertEqual([f for f in _interface.PARAMETERS if f not in _interface.DOCS], [])

    def test_structs_have_the_layout_of_the_interface(self):
        photon = _library.dtype("rt_photon")
        self.assertEqual(photon.itemsize, 64)
        self.assertEqual(photon.fields["flux"][1], 32)


class Library(unittest.TestCase):
    """Which library is opened, in a process of its own."""

    def said(self, path):
        run = subprocess.run([sys.executable, "-c", "import librt_render"], capture_output=True,
                             text=True, env={**os.environ, "LIBRT_LIBRARY": path})
        self.assertNotEqual(run.returncode, 0)
        return run.stderr.splitlines()[-1]

    def test_a_library_that_is_not_there_is_told_with_what_to_do(self):
        line = self.said("/nowhere/librt-render.so.0")
        self.assertRegex(line, "ImportError: /nowhere/librt-render.so.0 cannot be loaded")
        self.assertRegex(line, "make install.*LIBRT_LIBRARY")

    def test_another_library_is_refused(self):
        self.assertRegex(self.said("libm.so.6"), "libm.so.6 is not librt")

    def test_a_library_of_another_version_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            source, path = (os.path.join(folder, name) for name in ("other.c", "other.so"))
            with open(source, "w", encoding="utf-8") as out:
                out.write('const char *rt_version(void) { return "9.8.7"; }\n')
            subprocess.run(["cc", "-shared", "-fPIC", "-o", path, source], check=True)
            self.assertRegex(self.said(path), "is version 9.8.7.*is for 0.*pip install")

    def test_a_tree_whose_headers_changed_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "build"))
            library = os.path.join(folder, "build", _library._SONAME)
            with mock.patch.multiple(_interface, TREE=folder, HEADERS={"rt.h": "0" * 64}):
                self.assertIsNone(_library._in_tree())  # nothing is built there
                with open(library, "wb"):
                    pass
                self.assertEqual(_library._in_tree(), library)
                with open(os.path.join(folder, "rt.h"), "w", encoding="utf-8") as out:
                    out.write("changed")
                with self.assertRaisesRegex(ImportError, "rt.h has changed.*pip install"):
                    _library._in_tree()


class Scenes(Case):
    def test_text_and_calls_make_the_same_picture(self):
        other = rt.Renderer(built(), self.device).render(spp=4)
        self.assertTrue(np.array_equal(other.rgb, self.film.rgb))
        self.assertGreater(self.film.rgb.mean(), 0.01)

    def test_a_wrong_text_is_told_with_all_its_places(self):
        with self.assertRaises(rt.InputError) as caught:
            rt.Scene.parse("camera { eye 0 }\nspher { }\n", name="wrong.rts")
        self.assertEqual((caught.exception.file, caught.exception.line), ("wrong.rts", 1))
        self.assertGreater(len(caught.exception.diagnostics), 1)
        self.assertTrue(str(caught.exception).startswith("wrong.rts:1:"))

    def test_a_probable_mistake_is_a_warning(self):
        with self.assertWarns(rt.RenderWarning):
            rt.Scene.parse(SCENE.replace("light point", "# light"))

    def test_textures_and_the_environment_take_a_layer(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "layers.exr")
            self.film.write(path)
            scene = rt.Scene()
            scene.material(kd_texture=scene.texture(path=path, layer="albedo"))
            scene.environment(path=path, layer="albedo")
            for wrong in (lambda: scene.texture(path=path, layer="albdo"),
                          lambda: rt.Scene().environment(path=path, layer="albdo")):
                with self.assertRaisesRegex(rt.InputError, "did you mean 'albedo'"):
                    wrong()
        with self.assertRaisesRegex(rt.InputError, "name its file"):
            rt.Scene().environment(1, layer="albedo")

    def test_the_environment_takes_a_transform(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sky.exr")
            self.film.write(path)
            rt.Scene().environment(path=path, transform=[[0, 0, 1, 0], [0, 1, 0, 0], [1, 0, 0, 0]])
            with self.assertRaisesRegex(rt.InputError, "must be a rotation"):
                rt.Scene().environment(path=path, transform=np.diag([1, 1, 2, 1]))

    def test_textures_have_a_filter_a_channel_and_a_rotation(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            self.film.write(path)
            scene = rt.Scene()
            scene.material(ks=0.5, roughness_texture=scene.texture(
                path=path, filter="nearest", channel="g", power=2, rotate=30, shear=0.5))
            for wrong, said in (({"filter": "trilinear"}, "filter is one of bilinear, nearest"),
                                ({"channel": "red"}, "channel is one of all, r, g, b, a")):
                with self.assertRaisesRegex(ValueError, said):
                    scene.texture(path=path, **wrong)
            with self.assertRaisesRegex(rt.InputError, "power is 11"):
                scene.texture(path=path, power=11)
            with self.assertRaisesRegex(rt.InputError, "no alpha, A, among R, G, B"):
                scene.texture(path=path, channel="a")

    def test_textures_hold_others(self):
        scene = rt.Scene()
        inner = scene.texture("checker", a=0.2, b=0.8, name="squares")
        worn = scene.texture("mix", a_texture=inner, b=(0.5, 0.4, 0.3), weight=0.25)
        scene.material(kd_texture=scene.texture("multiply", a_texture=worn, b=0.5))
        with self.assertRaisesRegex(rt.InputError, "there is no texture 9"):
            scene.texture("multiply", a_texture=9, b=1)
        with self.assertRaisesRegex(rt.InputError, "product with a black b"):
            scene.texture("multiply", a_texture=inner)
        for _ in range(7):
            inner = scene.texture("checker", a_texture=inner)
        with self.assertRaisesRegex(rt.InputError, "in it texture .*, in it 'squares'"):
            scene.texture("checker", a_texture=inner)

    def test_what_has_no_effect_is_a_warning(self):
        scene, renderer = rt.Scene(), rt.Renderer(built(), self.device)
        for said, useless in (
                ("'eta' of a material.*fresnel conductor", lambda: scene.material(kd=1, eta=1.5)),
                ("'g' of a medium.*scattering", lambda: scene.medium(0, g=0.5)),
                ("'path' of a texture.*image", lambda: scene.texture("checker", path="a.png")),
                ("'weight' of a texture.*mix", lambda: scene.texture("checker", weight=0.5)),
                ("'layer' of a texture.*image", lambda: scene.texture("checker", layer="a")),
                ("'fov' of a camera.*perspective",
                 lambda: scene.camera((0, 0, 1), (0, 0, 0), kind="orthographic", fov=40)),
                ("'k' has no effect.*photon", lambda: renderer.render(spp=1, k=20)),
                ("'k' has no effect.*photon", lambda: rt.render(built(), spp=1, k=20)),
                ("'k' has no effect.*photon", lambda: renderer.render_chunks(0, spp=1, k=20))):
            with self.assertWarnsRegex(rt.RenderWarning, said) as caught:
                useless()
            self.assertEqual(os.path.basename(caught.filename), "test_python.py")
        with warnings.catch_warnings():
            warnings.simplefilter("error", rt.RenderWarning)
            scene.material(ks=1, fresnel="conductor", eta=1.5, k=3)
            scene.material(metal="gold", roughness=0.1)
            scene.material(glass="bk7", priority=1)
            scene.camera((0, 0, 1), (0, 0, 0), fov=40)
            scene.medium(0.1, g=0.5)
            renderer.render(spp=1, aov=False)

    def test_a_metal_or_a_glass_has_a_name(self):
        scene = rt.Scene()
        with self.assertRaisesRegex(rt.InputError, "takes metal or eta, not both"):
            scene.material(metal="gold", eta=1.5)
        with self.assertRaisesRegex(ValueError, "did you mean 'gold'"):
            scene.material(metal="gild")

    def test_a_density_comes_from_an_array(self):
        """The upper half of a box lets exp(-0.5 x 2) through, the lower all."""
        density = np.zeros((1, 8, 1))
        density[0, 4:] = 2
        scene = rt.Scene()
        scene.environment(1)
        scene.medium(absorption=0.5, density=scene.grid(
            density, lo=(-1, -2, -0.5), hi=(1, 2, 0.5)))
        scene.camera((0, 1.5, -3), (0, 1.5, 0), projection="orthographic", width=0.2)
        upper = rt.render(scene, width=16, height=16, spp=64, max_depth=1, aov=False).rgb
        scene.camera((0, -1.5, -3), (0, -1.5, 0), "orthographic", width=0.2)
        lower = rt.render(scene, width=16, height=16, spp=64, max_depth=1, aov=False).rgb
        self.assertLess(abs(upper.mean() - np.exp(-1)), 0.02)
        self.assertTrue((lower == 1).all())

    def test_an_albedo_comes_from_an_array_of_colours(self):
        """Where all light is scattered the sky stays as it is; where none is, it is absorbed."""
        colours = np.zeros((1, 1, 2, 3))
        colours[..., 0] = 1
        scene = rt.Scene()
        scene.environment(1)
        box = {"lo": (-1, -1, -1), "hi": (1, 1, 1)}
        scene.medium(scattering=0.5, density=scene.grid(np.ones((1, 1, 1)), **box),
                     albedo=scene.grid(colours, wrap="repeat", **box))
        scene.camera((0, 0, -3), (0, 0, 0), projection="orthographic", width=0.2)
        rgb = rt.render(scene, width=16, height=16, spp=64, max_depth=100, aov=False).rgb
        self.assertLess(abs(rgb[..., 0].mean() - 1), 0.01)
        self.assertLess(abs(rgb[..., 1:].mean() - np.exp(-1)), 0.02)
        with self.assertRaisesRegex(ValueError, "clamp, repeat"):
            scene.grid(colours, wrap="mirror")

    def test_wrong_arguments_are_refused(self):
        scene = rt.Scene()
        white = scene.material(kd=0.7)
        for wrong in (lambda: scene.sphere((0, 0), 1, material=white),
                      lambda: scene.sphere((0, 0, 0), -1, material=white),
                      lambda: scene.sphere((0, 0, 0), 1, material=7),
                      lambda: scene.material(kd=(1, 2)), lambda: scene.material(fresnel="glass"),
                      lambda: scene.sphere((0, 0, 0), float("nan"), material=white),
                      lambda: scene.grid(np.ones((2, 3))), lambda: scene.grid([[[-1]]]),
                      lambda: scene.grid([[[1]]], lo=(1, 0, 0), hi=(1, 1, 1)),
                      lambda: scene.mesh([[0, 0, 0]], [[0, 0, -1]]),
                      lambda: scene.mesh([[0, 0, 0]], [[0, 0, 1]])):
            with self.assertRaises(ValueError):
                wrong()
        for wrong in (lambda: scene.sphere((0, 0, 0), 1, colour=1), lambda: scene.material(kx=1)):
            with self.assertRaises(TypeError):
                wrong()

    def test_what_is_no_object_is_told_by_its_name_and_the_near_one(self):
        scene = rt.Scene()
        scene.material("red glass")
        white = scene.material("white", kd=0.7)
        for said, wrong in (
                ("memory takes an object of Memory.*Scene.parse reads a text",
                 lambda: rt.Scene(SCENE)),
                ("memory takes an object of Memory, not 1024", lambda: rt.Device(memory=1024)),
                ("takes the path of a file; Scene.parse", lambda: rt.Scene.load(SCENE)),
                ("takes a text; Scene.load reads the file 'a.rts'",
                 lambda: rt.Scene.parse("a.rts")),
                ("source takes an object of str", lambda: rt.Scene.parse(None)),
                ("scene takes an object of Scene, not 'a.rts'", lambda: rt.Renderer("a.rts")),
                ("device takes an object of Device, not 0", lambda: rt.Renderer(self.scene, 0)),
                ("options takes an object of Options, not 'path'.*by name",
                 lambda: self.renderer.render("path")),
                ("photon_map takes an object of PhotonMap, not 'a.rtp'; PhotonMap.load",
                 lambda: self.renderer.render(photon_map="a.rtp")),
                ("resume takes an object of Film", lambda: self.renderer.render(resume="a.rtpart")),
                ("film takes an object of Film", lambda: self.renderer.denoise(3)),
                ("join takes an object of Film", lambda: rt.Film.join(["a.rtpart"])),
                ("merge takes an object of PhotonMap", lambda: rt.PhotonMap.merge(["a.rtp"])),
                ("not the name 'whit'; that of 'white' is 1",
                 lambda: scene.sphere((0, 0, 0), 1, material="whit")),
                ("a shape needs a material", lambda: scene.sphere((0, 0, 0), 1)),
                ("what Scene.material returned, not 1.5",
                 lambda: scene.sphere((0, 0, 0), 1, material=1.5)),
                ("what Scene.texture returned, not 'wood'",
                 lambda: scene.material(kd_texture="wood")),
                ("what Scene.grid returned, not 'smoke'", lambda: scene.medium(density="smoke")),
                ("Scene.load_mesh first, returned, not 'bunny'", lambda: scene.instance("bunny")),
                ("a shape has no 'materal'.*did you mean 'material'",
                 lambda: scene.sphere((0, 0, 0), 1, materal=white)),
                ("a camera has no 'fovv'.*did you mean 'fov'",
                 lambda: scene.camera((0, 0, 0), (0, 0, 1), fovv=40)),
                ("kd of a material takes 3 numbers, not 'red'", lambda: scene.material(kd="red"))):
            with self.assertRaisesRegex(TypeError, said):
                wrong()
        self.assertEqual(scene.info.shapes, 0)

    def test_a_word_that_is_none_names_the_near_one(self):
        scene = rt.Scene()
        for said, wrong in (
                ("not 'dielectrc'; did you mean 'dielectric'",
                 lambda: scene.material(fresnel="dielectrc")),
                ("not 'bhv'; did you mean 'bvh'", lambda: rt.Renderer(self.scene, accel="bhv")),
                ("not 'phton'; did you mean 'photon'", lambda: self.renderer.render(mode="phton")),
                ("not 'acs'; did you mean 'aces'",
                 lambda: self.film.write("a.png", tonemap="acs"))):
            with self.assertRaisesRegex(ValueError, said):
                wrong()
        with self.assertRaisesRegex(KeyError, "no layer 'albdo'.*did you mean 'albedo'"):
            self.film["albdo"]

    def test_a_file_that_is_missing_is_told_with_the_near_one(self):
        readers = {".rts": (rt.Scene.load, rt.render), ".obj": (rt.Scene().load_mesh,),
                   ".exr": (rt.Image.read, lambda path: rt.Scene().texture(path=path)),
                   ".rtp": (rt.PhotonMap.load,), ".rtpart": (rt.Film.load,)}
        for suffix, calls in readers.items():
            for read in calls:
                with tempfile.TemporaryDirectory() as folder:
                    there, missing = (os.path.join(folder, f"{name}{suffix}")
                                      for name in ("room", "rom"))
                    self.assertEqual(self.said_of(read, missing).count(missing), 1)
                    with open(there, "w", encoding="utf-8"):
                        pass
                    self.assertRegex(self.said_of(read, missing),
                                     f"{missing}.*; did you mean '{there}'")
                    # A folder that is not there, beside one with a near name.
                    os.mkdir(os.path.join(folder, "scenes"))
                    self.assertRegex(self.said_of(read, os.path.join(folder, "scens", "a.rts")),
                                     f"did you mean '{folder}/scenes'")

    def said_of(self, read, path):
        with self.assertRaises(rt.InputError) as caught:
            read(path)
        return str(caught.exception)

    def test_constants_of_a_text_are_set(self):
        text = SCENE.replace("radius 1", "radius size").replace("kd 0.7", "kd tint")
        text = "let size = 1\nlet tint = 0.7\n" + text
        plain = rt.render(rt.Scene.parse(text), self.device, spp=4)
        self.assertTrue(np.array_equal(plain.rgb, self.film.rgb))
        scene = rt.Scene.parse(text, constants={"size": 0.5, "tint": (0.7, 0, 0)})
        film = rt.render(scene, self.device, spp=4)
        self.assertEqual(film.rgb[:, :, 1].max(), 0)
        with self.assertRaisesRegex(rt.InputError, "no constant 'sise'"):
            rt.Scene.parse(text, constants={"sise": 1})

    def test_scenes_of_other_programs_are_read_and_written(self):
        text = ("<scene><default name='r' value='1'/><sensor type='perspective' id='a'/>"
                "<sensor type='perspective' id='b'/><shape type='sphere'>"
                "<float name='radius' value='$r'/></shape></scene>")
        with tempfile.TemporaryDirectory() as folder:
            path, written = Path(folder) / "a.xml", Path(folder) / "a.rts"
            path.write_text(text)
            with self.assertWarnsRegex(rt.RenderWarning, r"a\.xml:1: camera 2 'b' is left out"):
                scene = rt.Scene.load(path, constants={"r": 2})
            self.assertEqual(scene.info.shapes, 1)
            with self.assertRaisesRegex(rt.InputError, "the file has the cameras 1 'a', 2 'b'"):
                rt.Scene.load(path, camera="c")
            with self.assertRaises(rt.InputError) as caught:
                rt.Scene.load(path, strict=True)
            self.assertEqual([(each.severity, each.line)
                              for each in caught.exception.diagnostics
                              if "camera 2" in each.message], [("error", 1)])
            self.assertEqual(rt.Scene.convert(path, written, camera="b").info.shapes, 1)
            self.assertEqual(rt.Scene.load(written).info.shapes, 1)
            with self.assertRaisesRegex(ValueError, "is of scenes of other programs alone"):
                rt.Scene.load(written, strict=True)

    def test_a_mesh_of_arrays_is_hit_where_it_lies(self):
        scene = rt.Scene()
        white = scene.material(kd=0.5)
        mesh = scene.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        scene.instance(mesh, material=white, transform=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5]])
        hits = rt.Renderer(scene, self.device).trace(
            [[0.25, 0.25, 0], [0.75, 0.75, 0]], [[0, 0, 1], [0, 0, 1]])
        self.assertAlmostEqual(hits["t"][0], 5, places=5)
        self.assertTrue(np.isinf(hits["t"][1]))

    def test_a_mesh_of_arrays_has_attributes(self):
        scene = rt.Scene()
        wear = scene.texture("attribute", attribute="wear")
        ramp = scene.texture("gradient", b=1, attribute="uv1")
        corners, faces = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        mesh = scene.mesh(corners, faces, attributes={"wear": [0, 0.5, 1]},
                          triangle_attributes={"uv1": [[0.5, 0.25]]})
        scene.instance(mesh, material=scene.material(ks=0.5, roughness_texture=wear))
        scene.instance(mesh, material=scene.material(kd_texture=ramp))
        with self.assertRaisesRegex(rt.InputError, "which its mesh does not have; it has 'uv1'"):
            scene.instance(scene.mesh(corners, faces, attributes={"uv1": [[0, 0]] * 3}),
                           material=scene.material(ks=0.5, roughness_texture=wear))
        with self.assertRaisesRegex(ValueError, r"'wear' has the shape \(2,\) for 3 vertices"):
            scene.mesh(corners, faces, attributes={"wear": [0, 1]})

    def test_what_a_mesh_file_says_is_a_list(self):
        square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.obj")
            for faces, count in (("f 1 2 3 4", 0), ("f 1 3 2 4\nf 1 2 3", 1)):
                with open(path, "w", encoding="ascii") as file:
                    file.write(square + faces + "\n")
                _, info = rt.Scene().load_mesh(path)
                self.assertEqual((len(info.warnings), info.part_count), (count, 1))
        self.assertIn("a.obj:5: ", info.warnings[0])

    def test_a_transform_has_double_precision(self):
        scene = rt.Scene()
        white = scene.material(kd=0.5)
        far = 5000000.1
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "far.obj")
            with open(path, "w", encoding="ascii") as file:
                file.write(f"v {far} 0 5\nv {far + 1} 0 5\nv {far} 1 5\nf 1 2 3\n")
            mesh, info = scene.load_mesh(path)
        self.assertEqual(info.warnings, [])
        scene.instance(mesh, material=white,
                       transform=[[1, 0, 0, -far], [0, 1, 0, 0], [0, 0, 1, 0]])
        hits = rt.Renderer(scene, self.device).trace(
            [[0.01, 0.25, 0], [-0.01, 0.25, 0]], [[0, 0, 1], [0, 0, 1]])
        self.assertAlmostEqual(hits["t"][0], 5, places=5)
        self.assertTrue(np.isinf(hits["t"][1]))


class Settings(Case):
    def test_settings_are_those_of_the_table(self):
        options = rt.Options(mode="photon", k=50, radius=0.25, aov=True)
        self.assertEqual((options["mode"], options["k"], options["radius"], options["aov"]),
                         ("photon", 50, 0.25, True))
        self.assertIn("nearest photons", rt.Options.help("k"))
        self.assertEqual(rt.Options(k="all")["k"], "all")

    def test_an_unknown_setting_names_the_near_one(self):
        with self.assertRaisesRegex(TypeError, "did you mean 'spp'"):
            self.renderer.render(ssp=4)

    def test_a_value_out_of_range_names_its_setting(self):
        with self.assertRaises(rt.UsageError) as caught:
            self.renderer.render(spp=-1)
        self.assertEqual(caught.exception.field, "spp")


class Films(Case):
    def test_arrays_are_the_film_s_memory_and_keep_it(self):
        film = self.renderer.render(spp=1)
        address = film.rgb.__array_interface__["data"][0]
        self.assertEqual(address, film.rgb.__array_interface__["data"][0])
        self.assertFalse(film.rgb.flags.writeable)
        self.assertTrue(np.shares_memory(film.rgb, np.asarray(film)))
        with self.assertRaises(ValueError):
            film.rgb[0, 0, 0] = 1
        rgb, copy = film.rgb, film.rgb.copy()
        del film
        gc.collect()
        others = [self.renderer.render(spp=1) for _ in range(3)]
        self.assertTrue(np.array_equal(rgb, copy))
        del others

    def test_layers_have_their_names_and_shapes(self):
        self.assertEqual(self.film["depth"].shape, (24, 32))
        self.assertEqual(self.film["albedo"].shape, (24, 32, 3))
        self.assertAlmostEqual(float(self.film["albedo"].max()), 0.7, places=5)
        with self.assertRaisesRegex(KeyError, "albedo"):
            self.film["albdo"]

    def test_parts_joined_have_the_bits_of_the_whole(self):
        whole = self.renderer.render(spp=8, part=(1, 1))
        parts = [self.renderer.render(spp=8, part=(i, 3)) for i in (3, 1, 2)]
        self.assertTrue(np.array_equal(rt.Film.join(parts).rgb, whole.rgb))
        with self.assertRaises(rt.UsageError):
            rt.Film.join([parts[0], parts[0]])

    def test_chunks_add_up_to_the_picture(self):
        count = self.renderer.chunk_count(spp=8)
        whole = self.renderer.render(spp=8, part=(1, 1))
        films = [self.renderer.render_chunks(i, spp=8) for i in range(count)]
        films = [rt.Film.from_bytes(each.to_bytes()) for each in films]
        self.assertTrue(np.array_equal(rt.Film.join(films).rgb, whole.rgb))

    def test_a_film_goes_through_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "film.rtpart")
            film = self.renderer.render(spp=2, part=(1, 1))
            film.save(path)
            self.assertTrue(np.array_equal(rt.Film.load(path).rgb, film.rgb))
            more = self.renderer.render(spp=4, resume=rt.Film.load(path))
            self.assertEqual(more.stats.spp, 4)
            for name in ("a.exr", "a.pfm"):
                film.write(os.path.join(folder, name))
                image = rt.Image.read(os.path.join(folder, name))
                self.assertTrue(np.array_equal(image.rgb, film.rgb))
            with self.assertRaises(rt.OutputError):
                film.write(os.path.join(folder, "none", "a.exr"))

    def test_notebooks_show_pictures(self):
        for picture in (self.film, rt.Image.from_array(self.film.rgb),
                        rt.compare(self.film, self.film.rgb * 1.1)):
            self.assertTrue(picture._repr_png_().startswith(b"\x89PNG"))

    def test_comparison_of_equal_pictures_finds_nothing(self):
        found = rt.compare(self.film, self.film.rgb)
        self.assertEqual((found.mse, found.off, found.ratio), (0, 0, 1))
        brighter = rt.compare(self.film.rgb * 1.25, self.film)
        self.assertAlmostEqual(brighter.ratio, 1.25, places=5)
        self.assertEqual(len(brighter.blocks_array), brighter.blocks)


class Paths(Case):
    def test_paths_add_up_to_the_pixel(self):
        found = self.renderer.paths(16, 12, spp=4)
        self.assertEqual(len(found), 4)
        weight = found.paths["weight"][:, None]
        mean = (weight * found.paths["radiance"]).sum(axis=0) / weight.sum()
        self.assertTrue(np.allclose(mean, self.film.rgb[12, 16], rtol=1e-4))
        added = found.of(1)["emitted"].sum(axis=0) + found.of(1)["direct"].sum(axis=0)
        self.assertTrue(np.allclose(added, found.paths["radiance"][1], rtol=1e-5))
        self.assertEqual(found.event(found.of(1)["event"][0]), "camera")
        self.assertFalse(found.vertices.flags.writeable)
        with self.assertRaises(rt.UsageError) as caught:
            self.renderer.paths(32, 0)
        self.assertEqual(caught.exception.field, "pixel")


class Denoising(Case):
    def test_without_a_denoiser_there_is_no_layer(self):
        film = self.renderer.render(spp=1)
        with self.assertRaisesRegex(rt.DeviceError, "Open Image Denoise"):
            self.renderer.denoise(film, "/nowhere/libOpenImageDenoise.so")
        self.assertNotIn("denoised", film.layers)


class Photons(Case):
    def test_photons_are_a_structured_array_of_the_map_s_memory(self):
        photons = self.renderer.emit(photons=2000, direct="photons").photons()
        self.assertEqual(photons.dtype.names[0], "position")
        self.assertFalse(photons.flags.writeable)
        self.assertTrue(np.allclose(np.linalg.norm(photons["wi"], axis=1), 1, atol=1e-5))

    def test_the_ledger_closes(self):
        row = self.renderer.emit(photons=20000, direct="photons").ledger[0]
        spent = row["absorbed"] + row["escaped"] + row["cut_off"] + row["roulette"]
        self.assertTrue(np.allclose(row["emitted"], spent, rtol=1e-6))

    def test_irradiance_is_that_of_the_closed_form(self):
        scene = rt.Scene()
        scene.plane((0, 0, 0), (0, 1, 0), material=scene.material(kd=0.5))
        scene.point_light((0, 1, 0), intensity=1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = rt.Renderer(scene, self.device).emit(photons=200000, direct="photons")
        value = found.irradiance(self.device, [[0, 0, 0]], [[0, 1, 0]], k=2000)[0, 0]
        self.assertAlmostEqual(value, 1, delta=0.08)  # E = I / r^2; four standard deviations
        reading = found.illuminance([[0, 0, 0]], [[0, 1, 0]], k=2000)[0]
        same = found.irradiance(self.device, [[0, 0, 0]], [[0, 1, 0]], k=2000, kernel="box")
        self.assertAlmostEqual(reading["irradiance"][0], same[0, 0], delta=1e-4)  # all weigh alike

    def test_parts_merged_are_the_map(self):
        whole = self.renderer.emit(photons=20000)
        parts = [self.renderer.emit(photons=20000, part=(i, 2)) for i in (2, 1)]
        merged = rt.PhotonMap.merge(parts)
        self.assertEqual(merged.photons().tobytes(), whole.photons().tobytes())


class Calls(Case):
    def test_a_cancelled_render_has_its_film_and_frees_all(self):
        memory = rt.Memory()
        device = rt.Device(memory=memory)
        renderer = rt.Renderer(self.scene, device)
        before = memory.info.used
        with self.assertRaises(rt.Cancelled) as caught:
            renderer.render(spp=1000000, progress=lambda p: p.stage == "render" and p.fraction > 0)
        self.assertGreater(caught.exception.film.stats.spp, 0)
        self.assertGreater(memory.info.used, before)
        caught.exception.film = None
        del caught
        gc.collect()
        self.assertEqual(memory.info.used, before)
        del renderer, device
        gc.collect()
        self.assertEqual(memory.info.used, 0)

    def test_many_cancelled_renders_leave_no_memory(self):
        memory = rt.Memory()
        renderer = rt.Renderer(self.scene, rt.Device(memory=memory))

        def cancel(how):
            with self.assertRaises((rt.Cancelled, KeyError)):
                renderer.render(width=256, height=256, spp=100000, progress=how)

        def fail(progress):
            if progress.stage == "render" and progress.fraction > 0:
                raise KeyError("stop")
            return False

        for _ in range(3):  # what is allocated once
            cancel(lambda p: p.stage == "render" and p.fraction > 0)
        gc.collect()
        used, resident = memory.info.used, resident_bytes()
        for _ in range(20):
            cancel(lambda p: p.stage == "render" and p.fraction > 0)
            cancel(fail)
        gc.collect()
        self.assertEqual(memory.info.used, used)
        self.assertLess(resident_bytes() - resident, 20 << 20)  # 40 films would be 60 MB at least

    def test_what_a_callback_raises_comes_out(self):
        def fail(_progress):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.renderer.render(progress=fail)

    def test_control_c_ends_a_render(self):
        signalled = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        signalled.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                self.renderer.render(width=48, height=36, spp=1 << 20)
        finally:
            signalled.join()

    def test_a_callback_cannot_use_the_device_that_calls_it(self):
        with self.assertRaises(RuntimeError):
            self.renderer.render(progress=lambda _: self.renderer.render() and False)

    def test_a_limit_on_memory_holds(self):
        with self.assertRaises(MemoryError):
            device = rt.Device(memory=rt.Memory(1 << 20))
            rt.Renderer(self.scene, device).render(width=4096, height=4096)

    def test_ten_threads_render_ten_scenes(self):
        films = [None] * 10

        def work(i):
            scene = rt.Scene.parse(SCENE.replace("radius 1", f"radius {0.5 + i / 20}"))
            films[i] = rt.render(scene, rt.Device(threads=1), spp=2)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(10)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i, film in enumerate(films):
            scene = rt.Scene.parse(SCENE.replace("radius 1", f"radius {0.5 + i / 20}"))
            alone = rt.render(scene, self.device, spp=2)
            self.assertEqual(film.rgb.tobytes(), alone.rgb.tobytes(), i)

    def test_one_device_serves_many_threads_in_turn(self):
        films = [None] * 6

        def work(i):
            films[i] = self.renderer.render(spp=2, seed=i)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i, film in enumerate(films):
            self.assertTrue(np.array_equal(film.rgb, self.renderer.render(spp=2, seed=i).rgb))


class Lines(unittest.TextTestResult):
    """Prints what tests/run.sh reads."""

    def addSuccess(self, test):
        print(f"ok {test._testMethodName[5:]}", flush=True)

    def addFailure(self, test, err):
        print(f"not ok {test._testMethodName[5:]}\n{self._exc_info_to_string(err, test)}",
              flush=True)
        super().addFailure(test, err)

    addError = addFailure

    def addSubTest(self, test, subtest, err):
        if err is not None:
            self.addFailure(test, err)


def run_tests(name):
    """Runs the tests of the program that calls it."""
    runner = unittest.TextTestRunner(resultclass=Lines, stream=open(os.devnull, "w"))
    outcome = unittest.main(testRunner=runner, exit=False, argv=[name]).result
    raise SystemExit(not outcome.wasSuccessful())


if __name__ == "__main__":
    run_tests("test_python")
