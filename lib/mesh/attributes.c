/* attributes.c - lists of the attributes of meshes. */
#include "mesh/attributes.h"

#include <math.h>
#include <string.h>

rt_status rt_attributes_add(rt_attributes *to, const char *name, size_t length, uint32_t width,
                            rt_memory *memory, rt_error *error)
{
    rt_attribute *const list = rt_memory_resize(memory, to->list, (size_t)to->count + 1,
                                                sizeof *list, "attributes of a mesh", error);
    if (!list)
        return RT_ERROR_MEMORY;
    to->list = list;
    rt_attribute *const added = list + to->count++;
    memset(added, 0, sizeof *added);
    memcpy(added->name, name, length < sizeof added->name ? length : sizeof added->name - 1);
    added->first = to->width;
    added->width = width;
    to->width += width;
    return RT_OK;
}

const rt_attribute *rt_attributes_find(const rt_attributes *of, const char *name)
{
    for (uint32_t i = 0; i < of->count; i++)
        if (strcmp(of->list[i].name, name) == 0)
            return of->list + i;
    return NULL;
}

static void measure(rt_attribute *attribute, const rt_attributes *of, const uint32_t *rows,
                    size_t count)
{
    attribute->least = INFINITY;
    attribute->largest = -INFINITY;
    for (size_t i = 0; i < count * attribute->width; i++) {
        const size_t at = i / attribute->width, row = rows ? rows[at] : at;
        const float value = of->values[row * of->width + attribute->first + i % attribute->width];
        if (!isfinite(value)) {
            attribute->least = attribute->largest = value;
            return;
        }
        attribute->least = fminf(attribute->least, value);
        attribute->largest = fmaxf(attribute->largest, value);
    }
}

void rt_attributes_measure(rt_attributes *of, const uint32_t *rows, size_t count)
{
    for (uint32_t i = 0; i < of->count; i++)
        measure(of->list + i, of, rows, count);
}

void rt_attributes_free(rt_attributes *of)
{
    rt_memory_free(of->list);
    rt_memory_free(of->values);
    memset(of, 0, sizeof *of);
}
