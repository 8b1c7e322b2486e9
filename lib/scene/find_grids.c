/* find_grids.c - grids of densities whose box lies beside the solids of their medium. */
#include <math.h>

#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/shape_class.h"

/* The bounds of all shapes of a material, which may enclose its medium together. */
typedef struct enclosure {
    uint32_t shape; /* the first solid; RT_NONE: none */
    int is_unbounded;
    double lo[3], hi[3];
} enclosure;

static void enclose(enclosure *out, const rt_scene *scene, uint32_t material)
{
    *out =
        (enclosure){RT_NONE, 0, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->material != material)
            continue;
        out->is_unbounded |=
            rt_shape_class_of(shape->kind)->boundary(scene, shape) == RT_BOUNDARY_HALF_SPACE;
        if (out->shape == RT_NONE && !rt_inspection_is_open(scene, shape))
            out->shape = (uint32_t)i;
        for (int c = 0; c < 3; c++) {
            out->lo[c] = fmin(out->lo[c], shape->lo[c]);
            out->hi[c] = fmax(out->hi[c], shape->hi[c]);
        }
    }
}

/* Whether these bounds lie wholly beside the box, by their corners in the space of its voxels. */
static int is_apart(const rt_scene_grid *grid, const enclosure *bounds)
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int corner = 0; corner < 8; corner++) {
        double world[3], voxels[3];
        for (int c = 0; c < 3; c++)
            world[c] = corner >> c & 1 ? bounds->hi[c] : bounds->lo[c];
        rt_affine_point(voxels, &grid->to_voxels, world);
        for (int c = 0; c < 3; c++) {
            lo[c] = fmin(lo[c], voxels[c]);
            hi[c] = fmax(hi[c], voxels[c]);
        }
    }
    for (int c = 0; c < 3; c++)
        if (hi[c] <= 0 || lo[c] >= grid->size[c])
            return 1;
    return 0;
}

void rt_find_grids_apart(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    uint32_t checked = 0;
    for (uint32_t m = 0; m < scene->material_count && checked < RT_CHECKED_MAX; m++) {
        const rt_material *material = scene->materials + m;
        enclosure bounds;
        if (!material->density || !(material->interface || rt_material_is_transparent(material)))
            continue;
        checked++;
        enclose(&bounds, scene, m);
        if (bounds.shape == RT_NONE || bounds.is_unbounded ||
            !is_apart(scene->grids + material->density - 1, &bounds))
            continue;
        rt_finding apart = rt_finding_of(RT_FINDING_GRID_APART);
        apart.shape = bounds.shape;
        apart.grid = material->density - 1;
        rt_inspection_report(in, apart,
                             "this %s does not meet the box of the grid of its medium, which has "
                             "no density in it",
                             rt_inspection_name(scene->shapes + bounds.shape));
    }
}
