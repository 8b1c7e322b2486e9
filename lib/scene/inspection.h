/* inspection.h - the state of rt_scene_check, for the files that look for its findings. */
#ifndef RT_LIB_SCENE_INSPECTION_H
#define RT_LIB_SCENE_INSPECTION_H

#include "base/error.h"
#include "scene/scene.h"

/*
 * The number of lights, of open shapes of glass and of solids that are checked: of many copies the
 * first show the mistake.
 */
enum { RT_CHECKED_MAX = 256 };

/* Solids around one point that a path keeps in mind; see kernels/material/medium.h. */
enum { RT_NESTED_MAX = 4 };

/* The state of one check. */
typedef struct rt_inspection {
    const rt_scene *scene;
    void (*found)(void *user, const rt_finding *finding);
    void *user;
    size_t warnings;
} rt_inspection;

/* A finding about nothing so far. */
rt_finding rt_finding_of(rt_finding_kind kind);

/* Passes a finding on with a message of this form. */
void rt_inspection_report(rt_inspection *in, rt_finding finding, const char *format, ...)
    RT_PRINTF(3, 4);

/* What messages call a shape. */
const char *rt_inspection_name(const rt_scene_shape *shape);

/* Whether a shape has no inside of its own, but that others may close it. */
int rt_inspection_is_open(const rt_scene *scene, const rt_scene_shape *shape);

/*
 * Whether what enters the material is bent or absorbed; where not, a sheet of it is a mere filter.
 */
int rt_inspection_is_glass(const rt_material *material);

/* Solids that are checked, in the order of the scene. */
typedef struct rt_solids {
    uint32_t shape[RT_CHECKED_MAX];
    uint32_t count;
} rt_solids;

/*
 * Lights inside opaque solids (find_lights.c); lights that light nothing (find_dark.c), and that
 * lie in a surface (find_contacts.c); grids beside their solids (find_grids.c); transparent solids
 * that meet or hide each other (find_solids.c); too many of them around a point (find_nests.c);
 * meshes of glass turned inside out (find_turned.c), and with sharp edges that are shaded smooth
 * (find_leaning.c); meshes that lose by rounding (find_rounding.c); textures without a sensible
 * effect (find_textures.c).
 */
void rt_find_lights_inside(rt_inspection *in);
void rt_find_dark_lights(rt_inspection *in);
void rt_find_lights_in_surfaces(rt_inspection *in);
void rt_find_grids_apart(rt_inspection *in);
void rt_find_solids(rt_inspection *in);
void rt_find_inside_out(rt_inspection *in);
void rt_find_leaning_normals(rt_inspection *in);
void rt_find_rounding(rt_inspection *in);
void rt_find_textures(rt_inspection *in);
void rt_find_nests(rt_inspection *in, const rt_solids *solids);

#endif
