/* modes.c - the class of each mode. */
#include "mode/modes.h"

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
