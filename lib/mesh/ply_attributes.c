/* ply_attributes.c - finds the attributes among the properties of a PLY file. */
#include "mesh/ply_attributes.h"

#include <string.h>

/* The last letters of the names of neighbours that are one attribute. */
static const char *const ends[] = {"xyzw", "rgba", "0123", "1234", "uv", "st"};

/* The largest number of a type that is a part of one, or 0: another type. */
static double largest(const rt_ply_property *property)
{
    if (property->is_list)
        return 0;
    if (rt_ply_is_float(property->type))
        return 1;
    const double greatest = (double)rt_ply_greatest(property->type);
    return greatest <= UINT16_MAX ? greatest : 0;
}

double rt_ply_attribute_scale(const rt_ply_property *property)
{
    return 1 / largest(property);
}

/* Whether a name is that of a neighbour: what comes before its last two letters, and the last. */
static int is_neighbour(rt_token name, rt_token first, char end)
{
    return name.length == first.length && name.at[name.length - 1] == end &&
           memcmp(name.at, first.at, first.length - 1) == 0;
}

/* The properties from this one on that are one attribute. */
static size_t find_group(const rt_ply_element *element, size_t first, rt_token *name)
{
    const rt_ply_property *const all = element->properties;
    const rt_token own = all[first].name;
    const char *group = NULL;
    *name = own;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        if (own.length > 2 && own.at[own.length - 2] == '_' && own.at[own.length - 1] == *ends[i])
            group = ends[i];
    if (!group)
        return 1;
    size_t count = 1;
    name->length -= 2;
    while (group[count] && first + count < element->property_count &&
           largest(all + first + count) > 0 &&
           is_neighbour(all[first + count].name, own, group[count]))
        count++;
    return count;
}

static int is_known(const rt_ply_attributes *out, rt_token name)
{
    for (uint32_t i = 0; i < out->count; i++)
        if (out->list[i].name.length == name.length &&
            memcmp(out->list[i].name.at, name.at, name.length) == 0)
            return 1;
    return 0;
}

void rt_ply_attributes_find(rt_ply_attributes *out, const rt_ply_element *element,
                            rt_ply_is_taken *is_taken, const void *user)
{
    rt_token name;
    out->count = out->width = 0;
    for (size_t i = 0, count; i < element->property_count && out->count < RT_PLY_ATTRIBUTES;
         i += count) {
        count = 1;
        if (!(largest(element->properties + i) > 0) || is_taken(user, element->properties + i))
            continue;
        count = find_group(element, i, &name);
        if (name.length >= RT_ATTRIBUTE_NAME || is_known(out, name))
            continue;
        const uint32_t width = count < RT_ATTRIBUTE_WIDTH ? (uint32_t)count : RT_ATTRIBUTE_WIDTH;
        out->list[out->count++] = (rt_ply_attribute){name, i, width, out->width};
        out->width += width;
    }
}

int rt_ply_attributes_place(const rt_ply_attributes *of, size_t property)
{
    for (uint32_t i = 0; i < of->count; i++) {
        const rt_ply_attribute *a = of->list + i;
        if (property >= a->property && property < a->property + a->width)
            return (int)(a->first + (property - a->property));
    }
    return -1;
}

rt_status rt_ply_attributes_add(rt_attributes *to, const rt_ply_attributes *found,
                                rt_memory *memory, rt_error *error)
{
    rt_status status = RT_OK;
    for (uint32_t i = 0; i < found->count && status == RT_OK; i++)
        status = rt_attributes_add(to, found->list[i].name.at, found->list[i].name.length,
                                   found->list[i].width, memory, error);
    return status;
}
