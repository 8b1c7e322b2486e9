/* attributes.c - names the attributes that textures ask for, and checks that meshes have them. */
#include "scene/attributes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "scene/parts.h"

rt_status rt_scene_name_attribute(rt_scene *scene, uint32_t *number, const char *name,
                                  rt_error *error)
{
    const size_t length = strlen(name);
    uint32_t i = 0;
    if (length == 0 || length >= RT_ATTRIBUTE_NAME)
        return rt_fail_field(error, RT_ERROR_INPUT, "attribute",
                             "texture: the name of an attribute has %zu bytes; it must have 1 to "
                             "%d",
                             length, RT_ATTRIBUTE_NAME - 1);
    while (i < scene->attribute_count && strcmp(scene->attributes[i], name) != 0)
        i++;
    if (i == RT_ATTRIBUTES_MOST)
        return rt_fail_field(error, RT_ERROR_INPUT, "attribute",
                             "texture: a scene shows at most %d attributes of meshes",
                             RT_ATTRIBUTES_MOST);
    if (i == scene->attribute_count)
        memcpy(scene->attributes[scene->attribute_count++], name, length + 1);
    *number = i;
    return RT_OK;
}

static void add_use(rt_attribute_use *to, rt_attribute_use use)
{
    to->coordinates |= use.coordinates;
    to->shown |= use.shown;
}

typedef struct asked {
    const rt_scene *scene;
    rt_attribute_use use;
} asked;

static void add_texture(void *user, uint32_t handle)
{
    asked *a = user;
    add_use(&a->use, a->scene->textures[handle - 1].use);
}

rt_attribute_use rt_material_attributes(const rt_scene *scene, const rt_material *m)
{
    asked a = {scene, {0, 0}};
    rt_material_textures(scene, m, add_texture, &a);
    if (m->emission_texture)
        add_texture(&a, m->emission_texture);
    return a.use;
}

const rt_attribute *rt_mesh_attribute_of(const rt_attributes **of, const rt_scene *scene,
                                         const rt_scene_mesh *mesh, uint32_t number)
{
    const rt_attribute *found;
    *of = &mesh->of_vertices;
    found = rt_attributes_find(*of, scene->attributes[number]);
    if (found)
        return found;
    *of = &mesh->of_triangles;
    return rt_attributes_find(*of, scene->attributes[number]);
}

/* The names that a mesh has, as many as fit. */
static void list_names(char *out, size_t size, const rt_scene_mesh *mesh)
{
    const rt_attributes *const all[] = {&mesh->of_vertices, &mesh->of_triangles};
    size_t used = 0;
    for (int k = 0; k < 2; k++)
        for (uint32_t i = 0; i < all[k]->count && used + RT_ATTRIBUTE_NAME + 4 < size; i++)
            used += (size_t)snprintf(out + used, size - used, "%s'%s'", used ? ", " : "",
                                     all[k]->list[i].name);
    if (used == 0)
        snprintf(out, size, "none");
}

static rt_status check_one(const rt_scene *scene, const rt_scene_mesh *mesh, uint32_t number,
                           int is_shown, const char *field, const char *who, rt_error *error)
{
    const char *const name = scene->attributes[number];
    const rt_attributes *of;
    char names[200];
    if (!mesh)
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: a texture asks for the attribute '%s', which only meshes have",
                             who, name);
    const rt_attribute *const a = rt_mesh_attribute_of(&of, scene, mesh, number);
    if (!a) {
        list_names(names, sizeof names, mesh);
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: a texture asks for the attribute '%s', which its mesh does not "
                             "have; it has %s",
                             who, name, names);
    }
    if (is_shown ? a->width == 2 : a->width != 2)
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: the attribute '%s' of its mesh is of %u number%s; %s", who, name,
                             a->width, a->width == 1 ? "" : "s",
                             is_shown ? "a pattern shows one or three" : "coordinates are two");
    const float worst = a->least >= 0 ? a->largest : a->least;
    if (is_shown ? !(a->least >= 0 && a->largest <= RT_ATTRIBUTE_MOST) : !isfinite(worst))
        return rt_fail_field(
            error, RT_ERROR_INPUT, field, "%s: the attribute '%s' of its mesh has the value %g; %s",
            who, name, worst,
            is_shown ? "what a pattern shows lies between 0 and 1" : "coordinates are finite");
    return RT_OK;
}

static rt_status check_use(const rt_scene *scene, const rt_scene_mesh *mesh, rt_attribute_use use,
                           const char *field, const char *who, rt_error *error)
{
    rt_status status = RT_OK;
    for (uint32_t i = 0; i < scene->attribute_count && status == RT_OK; i++) {
        if (use.coordinates >> i & 1)
            status = check_one(scene, mesh, i, 0, field, who, error);
        if (status == RT_OK && use.shown >> i & 1)
            status = check_one(scene, mesh, i, 1, field, who, error);
    }
    return status;
}

rt_status rt_attributes_check(const rt_scene *scene, const rt_scene_mesh *mesh,
                              const rt_surface *surface, const char *who, rt_error *error)
{
    asked own = {scene, {0, 0}};
    if (scene->attribute_count == 0)
        return RT_OK;
    if (surface->texture)
        add_texture(&own, surface->texture);
    const rt_status status = check_use(scene, mesh, own.use, "texture", who, error);
    return status == RT_OK
               ? check_use(scene, mesh,
                           rt_material_attributes(scene, scene->materials + surface->material),
                           "material", who, error)
               : status;
}
