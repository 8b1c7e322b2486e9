/* modes.h - the classes of all modes. A new mode is declared here and listed in modes.c. */
#ifndef RT_LIB_MODE_MODES_H
#define RT_LIB_MODE_MODES_H

#include "mode/mode.h"

extern const rt_mode_class rt_mode_path, rt_mode_photon, rt_mode_direct, rt_mode_normals,
    rt_mode_albedo, rt_mode_depth, rt_mode_vcm;

#endif
