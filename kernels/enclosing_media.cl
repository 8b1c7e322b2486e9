/*
 * enclosing_media.cl - the media that paths start in: the solids around the camera and each light.
 */
#include "entry.h"
#include "light/emit.h"
#include "surface/enclosing_media.h"

static uint4 media_around_light(const struct scene *scene, global const rt_light_data *light)
{
    if (light->flags & RT_LIGHT_PARTLY_ENCLOSED)
        return RT_VACUUM; /* each path looks around itself */
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_ENVIRONMENT:
        return RT_VACUUM;
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
    case RT_LIGHT_BEAM: /* its middle stands for all of it */
        return media_around(scene, row3(light->a));
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        break;
    }
    /* One point stands for all of the light. */
    struct emission emission;
    emit_area(scene, &emission, light, (float2)(0.3f, 0.4f), (float2)(0.5f), 0.75f);
    return media_around(scene, leave_surface(&emission.at, emission.at.normal));
}

/* Item 0: the camera at `eye`; item i: light i - 1. Needed only where a material lets light in. */
KERNEL enclosing_media(const rt_params params, global rt_scene_header *header, const float4 eye)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    if (item == 0u) {
        vstore4(media_around(&scene, eye.xyz) + 1u, 0, header->eye_media);
        return;
    }
    global uchar *lights = (global uchar *)header + (size_t)header->lights * RT_SCENE_ROW;
    global rt_light_data *light = (global rt_light_data *)lights + (item - 1u);
    vstore3(media_around_light(&scene, light).xyz + 1u, 0, light->media);
}
