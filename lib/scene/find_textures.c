/*
 * find_textures.c - textures without a sensible effect: on meshes without texture coordinates,
 * normal maps that hold no normals, opacity of 0 everywhere; and colours of meshes that no material
 * shows.
 */
#include <math.h>
#include <stdlib.h>

#include "scene/check.h"
#include "scene/inspection.h"
#include "scene/parts.h"

/* ---- Texture coordinates ------------------------------------------------------- */

/* Whether a texture, or one inside, is looked up by the mesh's own texture coordinates. */
static int asks_for_uv(const rt_scene *scene, uint32_t handle)
{
    if (!handle)
        return 0;
    const rt_scene_texture *const t = scene->textures + handle - 1;
    for (int i = 0; i < 3; i++)
        if (asks_for_uv(scene, t->parts[i]))
            return 1;
    return t->levels == 1 && !t->use.coordinates &&
           (t->data.kind == RT_TEXTURE_IMAGE || t->data.kind == RT_TEXTURE_CHECKER ||
            t->data.kind == RT_TEXTURE_GRADIENT);
}

typedef struct asked {
    const rt_scene *scene;
    int for_uv;
} asked;

static void ask(void *user, uint32_t handle)
{
    asked *a = user;
    a->for_uv |= asks_for_uv(a->scene, handle);
}

/* Whether a texture that a shape shows is looked up by texture coordinates. */
static int shape_asks_for_uv(const rt_scene *scene, const rt_scene_shape *shape)
{
    asked a = {scene, 0};
    ask(&a, shape->texture);
    ask(&a, rt_scene_emission_texture(scene, shape));
    rt_material_textures(scene, scene->materials + shape->material, ask, &a);
    return a.for_uv;
}

/* A single triangle may be meant to show the whole texture. */
static void find_unmapped(rt_inspection *in, uint32_t index)
{
    const rt_scene *scene = in->scene;
    const rt_scene_shape *shape = scene->shapes + index;
    const rt_scene_mesh *mesh = scene->meshes + shape->mesh;
    if ((mesh->uv && !mesh->has_bare_corners) || mesh->triangle_count == 1 ||
        !shape_asks_for_uv(scene, shape))
        return;
    rt_finding found = rt_finding_of(RT_FINDING_NO_COORDINATES);
    found.shape = index;
    rt_inspection_report(in, found, "%s",
                         mesh->uv ? "some corners of this mesh have no texture coordinates: they "
                                    "sample the textures at (0, 0)"
                                  : "this mesh has no texture coordinates: each of its triangles "
                                    "shows the whole texture");
}

/* ---- Colours ------------------------------------------------------------------- */

static int has_kd(const rt_material *m)
{
    return !rt_is_black(m->kd) || m->kd_texture; /* of principled materials base_color, too */
}

static void find_unseen_colours(rt_inspection *in, uint32_t index)
{
    const rt_scene *scene = in->scene;
    const rt_scene_shape *shape = scene->shapes + index;
    if (!scene->meshes[shape->mesh].colours ||
        rt_material_any(scene, scene->materials + shape->material, RT_SIDE_BOTH, has_kd))
        return;
    rt_finding found = rt_finding_of(RT_FINDING_UNSEEN_COLOURS);
    found.shape = index;
    rt_inspection_report(in, found,
                         "the colours of this mesh have no effect: its material has no `kd`");
}

/* ---- Materials ----------------------------------------------------------------- */

static void find_no_normals(rt_inspection *in, const rt_material *m, uint32_t shape)
{
    if (!m->normal_texture)
        return;
    const rt_scene_texture *t = in->scene->textures + m->normal_texture - 1;
    if (t->levels > 1 || t->normals >= 0.5f)
        return;
    rt_finding found = rt_finding_of(RT_FINDING_NO_NORMALS);
    found.shape = shape;
    rt_inspection_report(in, found,
                         "normal_texture does not look like a normal map: %.0f %% of its texels do "
                         "not decode (2 c - 1) to a unit vector with z > 0",
                         100 * (1 - (double)t->normals));
}

/* Of less than this nothing is to be seen in a picture. */
static const double least_opacity = 1e-3;

static void find_vanished(rt_inspection *in, const rt_material *m, uint32_t shape)
{
    double most = m->opacity;
    if (m->opacity_texture) {
        const float *largest = in->scene->textures[m->opacity_texture - 1].largest;
        most *= fmax(fmax(largest[0], largest[1]), largest[2]);
    }
    if (most >= least_opacity && most >= m->opacity_cutoff)
        return;
    rt_finding found = rt_finding_of(RT_FINDING_VANISHED);
    found.shape = shape;
    rt_inspection_report(in, found, "nothing of this %s is seen: its opacity is at most %g%s",
                         rt_inspection_name(in->scene->shapes + shape), most,
                         most >= least_opacity ? ", below opacity_cutoff" : "");
}

void rt_find_textures(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    unsigned char *seen = calloc(scene->material_count + 1, 1);
    uint32_t *placed = calloc(scene->mesh_count + 1, sizeof *placed); /* 1 + the last material */
    for (uint32_t i = 0; i < scene->shape_count && seen && placed; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        const rt_material *m = scene->materials + shape->material;
        if (!seen[shape->material]) {
            find_no_normals(in, m, i);
            find_vanished(in, m, i);
        }
        seen[shape->material] = 1;
        if (shape->kind != RT_SHAPE_TRIANGLES || placed[shape->mesh] == shape->material + 1)
            continue;
        placed[shape->mesh] = shape->material + 1;
        find_unmapped(in, i);
        find_unseen_colours(in, i);
    }
    free(placed);
    free(seen);
}
