/*
 * rt.h - the public interface of librt, a renderer for the study of light transport.
 *
 * OVERVIEW
 *
 * A scene (rt_scene) is read from the .rts language or built by calls. A device
 * (rt_device) is one OpenCL device. A renderer (rt_renderer) is a scene made ready on a
 * device: the bounding volume hierarchy is built on the host and everything the kernels
 * need is uploaded. rt_render makes a film (rt_film) from it, by path tracing, photon
 * mapping or vertex connection and merging; rt_photon_map_emit emits the photons alone, to be
 * inspected, saved, merged and rendered with; rt_trace follows single rays. A film is read in
 * memory or written as an image.
 *
 *     text or calls -> rt_scene -+
 *                                +-> rt_renderer -> rt_film -> memory, .exr, .png, ...
 *                   rt_device ---+        |
 *                                         +-> rt_hit
 *                                         +-> rt_photon_map -> memory, .rtp, .ply
 *
 * A COMPLETE EXAMPLE
 *
 *     #include <rt/rt.h>
 *     #include <stdio.h>
 *
 *     int main(void)
 *     {
 *         const char *text =
 *             "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\n"
 *             "film { width 64  height 64 }\n"
 *             "material white { kd 0.7 }\n"
 *             "plane { point 0 0 0  normal 0 1 0  material white }\n"
 *             "sphere { centre 0 1 0  radius 1  material white }\n"
 *             "light point { position 2 4 -3  intensity 20 }\n";
 *         rt_scene *scene = NULL;
 *         rt_device *device = NULL;
 *         rt_renderer *renderer = NULL;
 *         rt_film *film = NULL;
 *         rt_error error;
 *
 *         if (rt_scene_parse(&scene, text, "example", NULL, &error) == RT_OK &&
 *             rt_device_open(&device, NULL, &error) == RT_OK &&
 *             rt_renderer_create(&renderer, scene, device, NULL, &error) == RT_OK &&
 *             rt_render(&film, renderer, NULL, &error) == RT_OK) {
 *             const float *centre = rt_film_rgb(film) + 3 * (32 * 64 + 32);
 *             printf("radiance %.3f %.3f %.3f\n", centre[0], centre[1], centre[2]);
 *         } else {
 *             fprintf(stderr, "%s\n", error.message);
 *         }
 *         rt_film_destroy(film);
 *         rt_renderer_destroy(renderer);
 *         rt_device_close(device);
 *         rt_scene_destroy(scene);
 *         return film == NULL;
 *     }
 *
 *     cc example.c $(pkg-config --cflags --libs librt-render)
 *
 * CONVENTIONS
 *
 * Units: metres, degrees in this interface and in the language, watts, linear sRGB.
 * Coordinates are right-handed with y up. A colour is float[3], red green blue.
 * What can fail returns rt_status and fills *error, if error is not NULL. Results are
 * written only on success, unless a call says otherwise. Pointers passed in are not kept
 * after the call returns, unless a call says otherwise. Destroying NULL does nothing.
 *
 * Objects may be destroyed in any order: a renderer holds its device, and a scene, a device, a film
 * and a photon map hold the rt_memory and the rt_profile that they were given, so that what is
 * destroyed before them ends when the last of them does.
 *
 * NULL may be passed only where a call says so: for a path, a text or an object (other than a scene
 * under construction) it makes a call that returns rt_status fail with RT_ERROR_USAGE; anywhere
 * else, as for a result or an array, the behaviour is undefined.
 *
 * Option structs: set what you need, leave the rest zero; zero always means the default
 * that the member's comment states. Passing NULL for an option struct means all defaults, to a
 * call with a renderer the options of its scene; where the call is about the options themselves, as
 * rt_render_options_check, or about how a picture is shared, it fails with RT_ERROR_USAGE.
 *
 * The library has no global state, but libraries that it uses do: calls that load a mesh silence
 * OpenMesh's error stream meanwhile; an OpenCL driver compiles in one folder for the whole process,
 * see rt_device_open. Different objects may be used from different threads at once; one object from
 * one thread at a time, but any number may read and render a scene that none changes. The library
 * does not print, exit or install signal handlers; it changes the environment only in the first
 * opening of a device.
 *
 * Coordinates lie within 1e15 metres, and the components of a colour, of whatever unit, between 0
 * and 1e28; values outside are refused.
 */
#ifndef RT_RT_H
#define RT_RT_H

#include "rt/base.h"
#include "rt/profile.h"
#include "rt/optical.h"
#include "rt/scene.h"
#include "rt/device.h"
#include "rt/field.h"
#include "rt/render.h"
#include "rt/setting.h"
#include "rt/photon.h"
#include "rt/film.h"
#include "rt/denoise.h"
#include "rt/paths.h"
#include "rt/share.h"
#include "rt/image.h"

#endif
