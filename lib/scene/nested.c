/*
 * nested.c - textures with others inside: their rows for kernels/material/texture.h, and the bounds
 * of their colours.
 *
 * The rows of what is inside are copied, so that a texture is one run of rows, whatever else holds
 * the same ones. The map of a checker or gradient places its own pattern; that of a product or
 * mixture comes before the maps of all that is inside, and is multiplied to theirs here.
 */
#include "scene/nested.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "scene/attributes.h"
#include "scene/check.h"

enum {
    rows_most = 256,    /* of one texture */
    pattern_steps = 128 /* of the slopes of a pattern in a square: TEXTURE_PATTERN_STEP */
};

/* A texture inside, multiplied by a colour; handle 0: the colour alone. */
typedef struct part {
    uint32_t handle;
    float colour[3];
    double mean[3], least[3], largest[3];
} part;

/* A texture that is being made. */
typedef struct nest {
    rt_scene *scene;
    rt_scene_texture *texture;
    const rt_texture *from;
    rt_texture_data own; /* as it would be with colours in place of textures */
    size_t first;        /* its first row in scene->texture_rows ... */
    size_t count;        /* ... and how many it has so far */
    int moves_parts;     /* its map is that of all that is inside */
} nest;

int rt_texture_is_nested(const rt_texture *texture)
{
    switch (texture->kind) {
    case RT_TEXTURE_IMAGE:
        return texture->attribute != NULL;
    case RT_TEXTURE_CONSTANT:
        return 0;
    case RT_TEXTURE_ATTRIBUTE:
        return 1;
    case RT_TEXTURE_CHECKER:
    case RT_TEXTURE_GRADIENT:
        return texture->a_texture || texture->b_texture || texture->attribute;
    case RT_TEXTURE_MULTIPLY:
    case RT_TEXTURE_MIX:
        return 1;
    }
    return 0;
}

/* ---- Rows -------------------------------------------------------------------- */

static rt_status put_row(nest *n, const rt_texture_data *row, rt_error *error)
{
    rt_scene *scene = n->scene;
    const char *name = n->texture->name;
    if (n->count == rows_most)
        return rt_fail(error, RT_ERROR_INPUT,
                       "texture%s%.80s%s: more than %d images, patterns and products lie inside "
                       "of it",
                       name ? " '" : "", name ? name : "", name ? "'" : "", rows_most);
    const rt_status status =
        rt_grow(scene->memory, (void **)&scene->texture_rows, &scene->texture_row_room,
                n->first + n->count, sizeof *row, "the list of textures", error);
    if (status == RT_OK)
        scene->texture_rows[n->first + n->count++] = *row;
    return status;
}

static rt_status put_simple(nest *n, rt_u32 kind, const float colour[3], rt_error *error)
{
    rt_texture_data row;
    memset(&row, 0, sizeof row);
    row.kind = kind;
    row.scale[0] = row.scale[1] = row.turn[0] = 1;
    memcpy(row.a, colour, sizeof row.a);
    memcpy(row.b, colour, sizeof row.b);
    return put_row(n, &row, error);
}

/*
 * A row of the texture's own: behind one that gives it the coordinates of an attribute, if it has
 * those.
 */
static rt_status put_own(nest *n, const rt_texture_data *row, rt_error *error)
{
    rt_texture_data coordinates;
    uint32_t number;
    rt_status status = RT_OK;
    if (n->from->attribute) {
        status = rt_scene_name_attribute(n->scene, &number, n->from->attribute, error);
        memset(&coordinates, 0, sizeof coordinates);
        coordinates.kind = RT_TEXTURE_COORDINATES;
        coordinates.texels = number;
        n->texture->use.coordinates |= status == RT_OK ? (uint64_t)1 << number : 0;
        status = status == RT_OK ? put_row(n, &coordinates, error) : status;
    }
    return status == RT_OK ? put_row(n, row, error) : status;
}

/* The map of a row, after another one. */
static void map_after(rt_texture_data *row, const rt_texture_data *first)
{
    const double a[2][2] = {{row->scale[0], row->shear[0]}, {row->shear[1], row->scale[1]}},
                 b[2][2] = {{first->scale[0], first->shear[0]}, {first->shear[1], first->scale[1]}},
                 turn[2] = {row->turn[0], row->turn[1]};
    for (int i = 0; i < 2; i++) {
        row->scale[i] = (float)(a[i][0] * b[0][i] + a[i][1] * b[1][i]);
        row->shear[i] = (float)(a[i][0] * b[0][1 - i] + a[i][1] * b[1][1 - i]);
        row->offset[i] = (float)(a[i][0] * first->offset[0] + a[i][1] * first->offset[1] +
                                 (double)row->offset[i]);
    }
    row->turn[0] = (float)(turn[0] * first->turn[0] - turn[1] * first->turn[1]);
    row->turn[1] = (float)(turn[1] * first->turn[0] + turn[0] * first->turn[1]);
}

/* The rows of a texture inside, or the colour in its place. */
static rt_status put_part(nest *n, const part *p, rt_error *error)
{
    if (!p->handle)
        return put_simple(n, RT_TEXTURE_CONSTANT, p->colour, error);
    const rt_scene_texture *inside = n->scene->textures + p->handle - 1;
    const int is_nested = inside->data.kind == RT_TEXTURE_NESTED;
    const size_t count = is_nested ? inside->data.rows : 1;
    rt_status status = RT_OK;
    for (size_t i = 0; i < count && status == RT_OK; i++) {
        rt_texture_data row =
            is_nested ? n->scene->texture_rows[inside->data.texels + i] : inside->data;
        if (n->moves_parts && row.kind != RT_TEXTURE_COORDINATES)
            map_after(&row, &n->own);
        status = put_row(n, &row, error);
    }
    if (status == RT_OK && !(p->colour[0] == 1 && p->colour[1] == 1 && p->colour[2] == 1))
        status = put_simple(n, RT_TEXTURE_SCALE, p->colour, error);
    return status;
}

/* The first square of a checker, or else the other. */
static rt_status put_choice(nest *n, const part parts[2], rt_error *error)
{
    rt_texture_data row = n->own;
    row.kind = RT_TEXTURE_CHOICE;
    rt_status status = put_own(n, &row, error);
    const size_t choice = n->first + n->count - 1;
    if (status == RT_OK)
        status = put_part(n, &parts[0], error);
    const size_t skip = n->first + n->count;
    row.kind = RT_TEXTURE_SKIP;
    if (status == RT_OK)
        status = put_row(n, &row, error);
    if (status == RT_OK)
        status = put_part(n, &parts[1], error);
    if (status != RT_OK)
        return status;
    n->scene->texture_rows[choice].rows = (rt_u32)(skip - choice);
    n->scene->texture_rows[skip].rows = (rt_u32)(n->first + n->count - skip - 1);
    return RT_OK;
}

static rt_status put_product(nest *n, const part parts[2], rt_error *error)
{
    rt_status status = put_part(n, &parts[0], error);
    if (status != RT_OK)
        return status;
    if (!parts[1].handle)
        return put_simple(n, RT_TEXTURE_SCALE, parts[1].colour, error);
    status = put_part(n, &parts[1], error);
    return status == RT_OK ? put_simple(n, RT_TEXTURE_MULTIPLY, parts[1].colour, error) : status;
}

/* A mixture by a texture or number; of a gradient by where on it the point is. */
static rt_status put_mixture(nest *n, const part parts[2], const part *weight, rt_error *error)
{
    rt_status status = put_part(n, &parts[0], error);
    if (status == RT_OK)
        status = put_part(n, &parts[1], error);
    if (status == RT_OK && n->from->kind == RT_TEXTURE_GRADIENT) {
        rt_texture_data row = n->own;
        for (int c = 0; c < 3; c++) {
            row.a[c] = 0;
            row.b[c] = 1;
        }
        status = put_own(n, &row, error);
    } else if (status == RT_OK) {
        status = put_part(n, weight, error);
    }
    return status == RT_OK ? put_simple(n, RT_TEXTURE_MIX, (const float[]){1, 1, 1}, error)
                           : status;
}

/* What a mesh has, as the colour. */
static rt_status put_attribute(nest *n, rt_error *error)
{
    rt_texture_data row = n->own;
    if (!n->from->attribute)
        return rt_fail_field(error, RT_ERROR_INPUT, "attribute",
                             "texture: the pattern needs the name of an attribute");
    const rt_status status =
        rt_scene_name_attribute(n->scene, &row.texels, n->from->attribute, error);
    if (status != RT_OK)
        return status;
    n->texture->use.shown |= (uint64_t)1 << row.texels;
    return put_row(n, &row, error);
}

/* ---- Bounds ------------------------------------------------------------------ */

/* The least and largest product; the mean as if the two had nothing to do with each other. */
static void bound_product(rt_scene_texture *texture, const part parts[2])
{
    const part *a = &parts[0], *b = &parts[1];
    for (int c = 0; c < 3; c++) {
        const double products[] = {a->least[c] * b->least[c], a->least[c] * b->largest[c],
                                   a->largest[c] * b->least[c], a->largest[c] * b->largest[c]};
        double least = products[0], largest = products[0];
        for (int i = 1; i < 4; i++) {
            least = fmin(least, products[i]);
            largest = fmax(largest, products[i]);
        }
        texture->mean[c] = (float)(a->mean[c] * b->mean[c]);
        texture->largest[c] = (float)largest;
        texture->least = fminf(texture->least, (float)least);
    }
}

/* Between the two; the mean by that of the weight. */
static void bound_mixture(rt_scene_texture *texture, const part parts[2], double weight)
{
    const part *a = &parts[0], *b = &parts[1];
    for (int c = 0; c < 3; c++) {
        texture->mean[c] = (float)((1 - weight) * a->mean[c] + weight * b->mean[c]);
        texture->largest[c] = (float)fmax(a->largest[c], b->largest[c]);
        texture->least = fminf(texture->least, (float)fmin(a->least[c], b->least[c]));
    }
}

/* The steps in u and v of the slopes: the least of what is inside. */
static void find_steps(const nest *n, float steps[2])
{
    double least[2] = {1.0 / pattern_steps, 1.0 / pattern_steps};
    for (size_t i = 0; i < n->count; i++) {
        const rt_texture_data *row = n->scene->texture_rows + n->first + i;
        const int is_image = row->kind == RT_TEXTURE_IMAGE;
        const double s = is_image ? 0.5 / row->width : 1.0 / pattern_steps,
                     t = is_image ? 0.5 / row->height : 1.0 / pattern_steps;
        if (!is_image && row->kind != RT_TEXTURE_CHECKER && row->kind != RT_TEXTURE_GRADIENT &&
            row->kind != RT_TEXTURE_CHOICE)
            continue;
        least[0] =
            fmin(least[0], fmin(s / fabs((double)row->scale[0]), t / fabs((double)row->shear[1])));
        least[1] =
            fmin(least[1], fmin(s / fabs((double)row->shear[0]), t / fabs((double)row->scale[1])));
    }
    for (int i = 0; i < 2; i++)
        steps[i] = (float)fmax(least[i], 1e-9);
}

/* ---- Parts ------------------------------------------------------------------- */

/* Adds a texture to a list, by its name or handle; both may be missing. */
static void add_name(char *list, size_t size, const char *name, uint32_t handle)
{
    const size_t used = strlen(list);
    const char *const separator = used > 0 ? ", in it " : "";
    if (name)
        snprintf(list + used, size - used, "%s'%.24s'", separator, name);
    else if (handle)
        snprintf(list + used, size - used, "%stexture %u", separator, handle);
    else
        snprintf(list + used, size - used, "%sthis one", separator);
}

/* The texture inside of another that lies the deepest, or 0. */
static uint32_t deepest(const rt_scene *scene, uint32_t handle)
{
    const rt_scene_texture *texture = scene->textures + handle - 1;
    for (int i = 0; i < 3; i++) {
        const uint32_t part = texture->parts[i];
        if (part && scene->textures[part - 1].levels + 1 == texture->levels)
            return part;
    }
    return 0;
}

static rt_status check_levels(nest *n, uint32_t handle, const char *field, rt_error *error)
{
    const int levels = handle ? n->scene->textures[handle - 1].levels + 1 : 1;
    char list[380] = "";
    if (levels > n->texture->levels)
        n->texture->levels = levels;
    if (levels <= RT_TEXTURE_LEVELS)
        return RT_OK;
    add_name(list, sizeof list, n->texture->name, 0);
    for (; handle; handle = deepest(n->scene, handle))
        add_name(list, sizeof list, n->scene->textures[handle - 1].name, handle);
    return rt_fail_field(error, RT_ERROR_INPUT, field,
                         "texture: more than %d textures lie in each other: %s", RT_TEXTURE_LEVELS,
                         list);
}

/* Checks one of the two colours with its texture. */
static rt_status make_part(nest *n, part *out, const float colour[3], uint32_t handle,
                           const char *colour_field, const char *field, rt_error *error)
{
    rt_status status = rt_check_colour(colour, "texture", colour_field, error);
    if (status == RT_OK)
        status = rt_texture_check(n->scene, handle, "texture", field, error);
    if (status == RT_OK)
        status = check_levels(n, handle, field, error);
    if (status != RT_OK)
        return status;
    const rt_scene_texture *inside = handle ? n->scene->textures + handle - 1 : NULL;
    out->handle = handle;
    for (int c = 0; c < 3; c++) {
        const float factor = inside && rt_is_black(colour) ? 1 : colour[c];
        out->colour[c] = factor;
        out->mean[c] = (double)factor * (inside ? inside->mean[c] : 1);
        out->largest[c] = (double)factor * (inside ? inside->largest[c] : 1);
        out->least[c] = inside ? (double)factor * inside->least : factor;
    }
    if (inside) {
        n->texture->use.coordinates |= inside->use.coordinates;
        n->texture->use.shown |= inside->use.shown;
        n->texture->is_srgb |= inside->is_srgb;
        n->texture->is_turned |= inside->is_turned;
        if (inside->least < 0)
            n->texture->least_of = inside->least_of ? inside->least_of : handle;
    }
    return RT_OK;
}

/* The weight of a mixture: a number, with a texture or without. */
static rt_status make_weight(nest *n, part *out, rt_error *error)
{
    const rt_texture *from = n->from;
    const uint32_t handle = from->weight_texture;
    const float weight = from->weight != 0 ? from->weight : handle ? 1 : 0.5f;
    const float grey[3] = {weight, weight, weight};
    const int is_srgb = n->texture->is_srgb, is_turned = n->texture->is_turned;
    if (!(weight > 0 && weight <= 1))
        return rt_fail_field(error, RT_ERROR_INPUT, "weight",
                             "texture: weight is %g; it must lie above 0, and be at most 1",
                             from->weight);
    rt_status status =
        rt_texture_check_colours(n->scene, handle, "texture", "weight_texture", error);
    if (status == RT_OK)
        status = rt_texture_check_number(n->scene, weight, handle, 1, "texture", "weight_texture",
                                         error);
    if (status == RT_OK)
        status = make_part(n, out, grey, handle, "weight", "weight_texture", error);
    /* It is no direction of a normal map. */
    n->texture->is_srgb = is_srgb;
    n->texture->is_turned = is_turned;
    return status;
}

static rt_status make_parts(nest *n, part parts[2], part *weight, rt_error *error)
{
    const rt_texture *from = n->from;
    rt_status status = make_part(n, &parts[0], from->a, from->a_texture, "a", "a_texture", error);
    if (status == RT_OK)
        status = make_part(n, &parts[1], from->b, from->b_texture, "b", "b_texture", error);
    if (status == RT_OK && from->kind == RT_TEXTURE_MIX)
        status = make_weight(n, weight, error);
    for (int i = 0; i < 2 && status == RT_OK && from->kind == RT_TEXTURE_MULTIPLY; i++)
        if (!parts[i].handle && rt_is_black(parts[i].colour))
            status = rt_fail_field(error, RT_ERROR_INPUT, i ? "b" : "a",
                                   "texture: a product with a black %s is black: it needs %s or "
                                   "%s_texture",
                                   i ? "b" : "a", i ? "b" : "a", i ? "b" : "a");
    n->texture->parts[0] = from->a_texture;
    n->texture->parts[1] = from->b_texture;
    n->texture->parts[2] = from->kind == RT_TEXTURE_MIX ? from->weight_texture : 0;
    return status;
}

/* ---- Textures ---------------------------------------------------------------- */

static rt_status put_rows(nest *n, const part parts[2], const part *weight, rt_error *error)
{
    switch (n->from->kind) {
    case RT_TEXTURE_CHECKER:
        return put_choice(n, parts, error);
    case RT_TEXTURE_MULTIPLY:
        return put_product(n, parts, error);
    case RT_TEXTURE_GRADIENT:
    case RT_TEXTURE_MIX:
        return put_mixture(n, parts, weight, error);
    case RT_TEXTURE_ATTRIBUTE:
        return put_attribute(n, error);
    case RT_TEXTURE_IMAGE:
    case RT_TEXTURE_CONSTANT:
        break;
    }
    return put_own(n, &n->own, error);
}

/* The bounds of what is made of two, or of any attribute; an image has its own already. */
static void find_bounds(const nest *n, const part parts[2], const part *weight)
{
    switch (n->from->kind) {
    case RT_TEXTURE_MULTIPLY:
        bound_product(n->texture, parts);
        return;
    case RT_TEXTURE_MIX:
        bound_mixture(n->texture, parts, (weight->mean[0] + weight->mean[1] + weight->mean[2]) / 3);
        return;
    case RT_TEXTURE_CHECKER:
    case RT_TEXTURE_GRADIENT:
        bound_mixture(n->texture, parts, 0.5);
        return;
    case RT_TEXTURE_ATTRIBUTE:
        for (int c = 0; c < 3; c++) {
            n->texture->mean[c] = 0.5f;
            n->texture->largest[c] = 1;
        }
        return;
    case RT_TEXTURE_IMAGE:
    case RT_TEXTURE_CONSTANT:
        return;
    }
}

rt_status rt_texture_nest(rt_scene *scene, rt_scene_texture *texture, const rt_texture *from,
                          rt_error *error)
{
    part parts[2] = {{0}}, weight = {0};
    const int is_image = from->kind == RT_TEXTURE_IMAGE;
    nest n = {scene, texture, from, texture->data, scene->texture_row_count, 0, 0};
    n.moves_parts = from->kind == RT_TEXTURE_MULTIPLY || from->kind == RT_TEXTURE_MIX;
    n.own.kind = from->kind;
    n.own.axis = 1;
    if ((n.moves_parts || is_image) && (n.own.turn[0] != 1 || n.own.turn[1] != 0))
        texture->is_turned = 1;
    rt_status status = is_image ? RT_OK : make_parts(&n, parts, &weight, error);
    if (status == RT_OK)
        status = put_rows(&n, parts, &weight, error);
    if (status != RT_OK)
        return status;
    find_bounds(&n, parts, &weight);

    memset(&texture->data, 0, sizeof texture->data);
    texture->data.kind = RT_TEXTURE_NESTED;
    texture->data.scale[0] = texture->data.scale[1] = texture->data.turn[0] = 1;
    if (is_image)
        memcpy(texture->data.turn, n.own.turn, sizeof n.own.turn);
    texture->data.format = texture->use.coordinates || texture->use.shown;
    texture->data.texels = (rt_u32)n.first;
    texture->data.rows = (rt_u32)n.count;
    find_steps(&n, texture->data.a);
    return RT_OK;
}
