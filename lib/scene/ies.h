/* ies.h - reads the intensities of luminaires from IES files (ANSI/IESNA LM-63). */
#ifndef RT_LIB_SCENE_IES_H
#define RT_LIB_SCENE_IES_H

#include "base/bytes.h"
#include "scene/scene.h"

/* What an IES file holds at most, bytes, and angles of each kind. */
enum { RT_IES_BYTES_MAX = 64 << 20, RT_IES_ANGLES_MAX = 36001 };

/*
 * Reads a file of type C, photometry about a vertical axis: values are candela, times the file's
 * multiplier and ballast factors, all around, whatever symmetry the file has. u are angles about
 * the axis, v those from it, radians. What is not measured is dark. Fails with RT_ERROR_INPUT, the
 * line named.
 */
rt_status rt_ies_decode(rt_scene_light_table *out, const rt_bytes *file, rt_memory *memory,
                        rt_error *error);
rt_status rt_ies_read(rt_scene_light_table *out, const char *path, rt_memory *memory,
                      rt_error *error);

#endif
