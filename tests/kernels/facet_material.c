/* facet_material.c - packs a scene of materials, and takes them out of the image. */
#include "kernels/facet_material.h"

#include <stdlib.h>
#include <string.h>

#include "pack/pack.h"

facet_material facet_material_of(const rt_material *materials, size_t count)
{
    rt_scene_image image = {0};
    rt_stage_progress progress;
    rt_scene *scene;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_texture(scene, NULL, &(rt_texture){.kind = RT_TEXTURE_GRADIENT}, &error),
              &error);
    for (size_t i = 0; i < count; i++)
        expect_ok(rt_scene_add_material(scene, NULL, NULL, materials + i, &error), &error);
    expect_ok(rt_stage_begin(&progress, NULL, RT_STAGE_BUILD), &error);
    expect_ok(rt_scene_pack(&image, scene, RT_ACCEL_NONE, 8, 1, &progress, &error), &error);
    const rt_scene_header *header = image.data;
    const size_t begin = (size_t)header->materials * RT_SCENE_ROW,
                 end = (size_t)header->lights * RT_SCENE_ROW;
    facet_material out = {malloc(end - begin), end - begin};
    memcpy(out.data, (const char *)image.data + begin, out.bytes);
    rt_scene_image_free(&image);
    rt_scene_destroy(scene);
    return out;
}
