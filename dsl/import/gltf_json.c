/* gltf_json.c - values of a glTF file, checked. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/gltf.h"

enum { FREE_MEMBERS = 16, MEMBERS_MAX = 4000000 };

static const char *const names[GLTF_ARRAY_COUNT] = {
    "scenes",    "nodes",       "meshes",  "materials", "textures", "images", "samplers",
    "accessors", "bufferViews", "buffers", "cameras",   "skins",    "lights"};

const cJSON *rt_gltf_extension(const cJSON *object, const char *name)
{
    return gltf_get(gltf_get(object, "extensions"), name);
}

void rt_gltf_count(gltf *g, const cJSON *object)
{
    const size_t members = object ? (size_t)cJSON_GetArraySize(object) : 0;
    g->members += members > FREE_MEMBERS ? members - FREE_MEMBERS : 0;
    if (g->members > MEMBERS_MAX)
        rt_import_fail(g->import, 0,
                       "objects of more than %d members that are named again come to more than %d",
                       FREE_MEMBERS, MEMBERS_MAX);
}

const cJSON *rt_gltf_item(gltf *g, gltf_array array, size_t index, const char *what)
{
    if (index < g->lists[array].count && cJSON_IsObject(g->lists[array].items[index])) {
        rt_gltf_count(g, g->lists[array].items[index]);
        return g->import->failed ? NULL : g->lists[array].items[index];
    }
    rt_import_fail(g->import, 0, "%s names %s[%lu]; the file has %lu of them", what, names[array],
                   (unsigned long)index, (unsigned long)g->lists[array].count);
    return NULL;
}

import_place rt_gltf_enter(gltf *g, gltf_array array, size_t index)
{
    const import_place before = g->import->place;
    const gltf_list *const list = &g->lists[array];
    const char *const name =
        index < list->count ? rt_gltf_string(list->items[index], "name") : NULL;
    g->import->place = (import_place){.list = names[array],
                                      .index = index,
                                      .name = name && *name ? name : NULL,
                                      .concern = array == GLTF_MATERIALS ? IMPORT_MATERIAL
                                                 : array == GLTF_MESHES  ? IMPORT_SHAPE
                                                                         : IMPORT_PICTURE};
    return before;
}

int rt_gltf_whole(gltf *g, const cJSON *object, const char *name, uint64_t *out)
{
    const cJSON *item = gltf_get(object, name);
    if (!item)
        return 0;
    double value = cJSON_IsNumber(item) ? item->valuedouble : -1;
    if (!(value >= 0 && value <= 9007199254740992.0) || floor(value) != value)
        return rt_import_fail(g->import, 0, "'%s' must be a whole number from 0", name);
    *out = (uint64_t)value;
    return 1;
}

const cJSON *rt_gltf_array_of(gltf *g, const cJSON *object, const char *name)
{
    const cJSON *list = gltf_get(object, name);
    if (!list || cJSON_IsArray(list))
        return list;
    rt_import_fail(g->import, 0, "'%s' must be a list", name);
    return NULL;
}

/* Whether an item is a number in the range of single precision. */
static int is_number(const cJSON *item)
{
    return cJSON_IsNumber(item) && fabs(item->valuedouble) <= FLT_MAX;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Tells the members of an object that stand in it twice. */
static void note_twice(gltf *g, const cJSON *object)
{
    const size_t members = (size_t)cJSON_GetArraySize(object);
    const char **const names = malloc((members + 1) * sizeof *names);
    size_t count = 0;
    if (!names) {
        rt_import_fail_memory(g->import);
        return;
    }
    for (const cJSON *item = object->child; item; item = item->next)
        names[count++] = item->string;
    qsort(names, count, sizeof *names, compare_names);
    for (size_t i = 1; i < count; i++)
        if (strcmp(names[i - 1], names[i]) == 0 && (i < 2 || strcmp(names[i - 2], names[i]) != 0))
            rt_import_note_at(g->import, 0,
                              "an object has the member '%.40s' more than once: the first is taken",
                              names[i]);
    free(names);
}

void rt_gltf_note_twice(gltf *g, const cJSON *item)
{
    for (; item && !g->import->failed; item = item->next) {
        if (item->string && strcmp(item->string, "extras") == 0)
            continue;
        if (cJSON_IsObject(item))
            note_twice(g, item);
        rt_gltf_note_twice(g, item->child); /* as deep as cJSON reads, at most */
    }
}

/* Of the members that lie from 0 to 1; others are told, and taken as the nearer of the two. */
static double within_range(gltf *g, const char *name, double value)
{
    static const char *const parts[] = {"baseColorFactor",
                                        "metallicFactor",
                                        "roughnessFactor",

                                        "clearcoatFactor",
                                        "clearcoatRoughnessFactor",
                                        "sheenColorFactor",
                                        "sheenRoughnessFactor",
                                        "specularFactor",
                                        "transmissionFactor",
                                        "diffuseTransmissionFactor",
                                        "diffuseTransmissionColorFactor",
                                        "anisotropyStrength",
                                        "attenuationColor"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (strcmp(name, parts[i]) == 0 && !(value >= 0 && value <= 1)) {
            rt_import_note_at(g->import, 0, "%s %g is taken as %d: it lies from 0 to 1", name,
                              value, value > 0);
            return value > 0;
        }
    return value;
}

double rt_gltf_number(gltf *g, const cJSON *object, const char *name, double fallback)
{
    const cJSON *item = gltf_get(object, name);
    if (!item)
        return fallback;
    if (is_number(item))
        return within_range(g, name, item->valuedouble);
    rt_import_note_at(g->import, 0, "'%s' is no finite number: it counts as %g", name, fallback);
    return fallback;
}

int rt_gltf_numbers(gltf *g, const cJSON *object, const char *name, double *out, int count)
{
    const cJSON *const list = gltf_get(object, name), *item;
    double values[GLTF_NUMBERS_MAX];
    int found = 0;
    if (!list)
        return 0;
    if (cJSON_IsArray(list))
        cJSON_ArrayForEach(item, list)
        {
            if (!is_number(item) || found == count)
                break;
            values[found++] = item->valuedouble;
        }
    if (found != count || cJSON_GetArraySize(list) != count) {
        rt_import_note_at(g->import, 0, "'%s' is left out: it is not %d finite numbers", name,
                          count);
        return 0;
    }
    for (int i = 0; i < count; i++)
        out[i] = within_range(g, name, values[i]);
    return 1;
}

int rt_gltf_flag(gltf *g, const cJSON *object, const char *name, int fallback)
{
    const cJSON *const item = gltf_get(object, name);
    if (cJSON_IsBool(item))
        return cJSON_IsTrue(item);
    if (item)
        rt_import_note_at(g->import, 0, "'%s' is neither true nor false: it counts as %s", name,
                          fallback ? "true" : "false");
    return fallback;
}

const char *rt_gltf_string(const cJSON *object, const char *name)
{
    const cJSON *item = gltf_get(object, name);
    return cJSON_IsString(item) ? item->valuestring : NULL;
}
