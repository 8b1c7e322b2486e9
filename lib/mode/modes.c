/* modes.c - the class of each mode, and the light that one leaves out of a scene. */
#include "mode/modes.h"
#include "scene/scene.h"
#include "setting/options.h"

const rt_mode_class *rt_mode_class_of(rt_mode mode)
{
    /* Without default: the compiler names a mode that is missing. */
    switch (mode) {
    case RT_MODE_PATH:
        return &rt_mode_path;
    case RT_MODE_PHOTON:
        return &rt_mode_photon;
    case RT_MODE_DIRECT:
        return &rt_mode_direct;
    case RT_MODE_NORMALS:
        return &rt_mode_normals;
    case RT_MODE_ALBEDO:
        return &rt_mode_albedo;
    case RT_MODE_DEPTH:
        return &rt_mode_depth;
    case RT_MODE_VCM:
        return &rt_mode_vcm;
    }
    return NULL;
}

int rt_mode_has_caustics(const rt_renderer *renderer, const rt_render_options *options,
                         int surfaces)
{
    return (renderer->hidden_caustics & surfaces) && options->max_depth >= RT_CAUSTIC_DEPTH;
}

const char *rt_renderer_leaves_out(const rt_renderer *renderer, const rt_render_options *options)
{
    rt_render_options o = options ? *options : renderer->options;
    if (rt_options_check(&o, NULL) != RT_OK)
        return NULL;
    rt_options_complete(&o);
    const rt_mode_class *mode = rt_mode_class_of(o.mode);
    return mode->leaves_out ? mode->leaves_out(renderer, &o) : NULL;
}
