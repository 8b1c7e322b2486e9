/* renderer.h - a scene made ready on a device, which all modes render from. */
#ifndef RT_LIB_RENDER_RENDERER_H
#define RT_LIB_RENDER_RENDERER_H

#include "device/device.h"
#include "pack/pack.h"
#include "rt.h"
#include "types.h"

struct rt_renderer {
    rt_device *device;
    rt_scene_image image; /* on the host; freed when the device has its copy */
    cl_mem scene;         /* the same on the device */
    rt_camera camera;
    int has_camera, has_light, hidden_caustics; /* RT_CAUSTICS_* */
    int is_dark;                                /* it has lights, which light nothing */
    double brightest;                           /* see rt_scene_brightest */
    int has_grids;                              /* a medium's density lies on a grid */
    int has_media;             /* it takes the integrators that know media, see scene.h */
    int has_shading_normals;   /* likewise */
    int has_dispersion;        /* likewise */
    int is_plain;              /* as in rt_scene_image; and it takes no other integrators */
    int has_rough_diffuse;     /* some shape has a diffuse lobe other than Lambert's */
    int has_rough_specular;    /* some shape reflects or refracts by a rough lobe */
    rt_render_options options; /* the scene's own */
    double build_seconds;
};

/*
 * The programs of an integrator that knows all scenes, by what a scene has, and the one that this
 * scene takes: of the fewest things that have all that it has.
 */
enum { RT_PROGRAM_KINDS = 6 };
#define RT_PROGRAMS(name)                                                                          \
    {                                                                                              \
        name, name "_plain", name "_media", name "_grids", name "_dispersive",                     \
            name "_grids_dispersive"                                                               \
    }
const char *rt_renderer_program(const rt_renderer *renderer,
                                const char *const programs[RT_PROGRAM_KINDS]);

/* The same of a program that knows all scenes, and another of it for plain ones. */
#define RT_PROGRAM_OF(renderer, name) ((renderer)->is_plain ? name "_plain" : name)

/* Parameters of a launch that follow from the options; items and samples are left to the caller. */
rt_params rt_params_make(const rt_render_options *options);

/* Sets up the camera of the scene on the device for a film of the options' size and filter. */
rt_status rt_renderer_aim(rt_renderer *renderer, const rt_render_options *options, rt_error *error);

/* The work-items that trace so many rays. */
size_t rt_trace_items(const rt_device *device, rt_trace_kind kind, size_t count);

#endif
