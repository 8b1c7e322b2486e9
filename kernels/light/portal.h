/*
 * portal.h - portals: openings through which light from infinitely far enters a room. They are
 * hints: what is sampled through them is mixed with what is sampled by the environment alone, so
 * that the mean depends on neither.
 *
 * From a point, an even sky is sampled by the solid angle of the portals, as rectangular lights
 * are. The image of a sky is sampled by its radiance within them. Directions w are there told by
 * the two angles a = atan(w.b / |w.n|) and c = atan(w.c / |w.n|) about the axes b, c and n of the
 * portal, so that it fills a rectangle of them; one of the two tables of cells has the directions
 * along n, the other those against it. dw = da dc / (cos^2 a cos^2 c r^3), r^2 = 1 + tan^2 a +
 * tan^2 c.
 *
 * Reference:
 *   Bitterli, Novak, Jarosz: "Portal-Masked Environment Map Sampling", EGSR 2015.
 */
#ifndef RT_KERNELS_LIGHT_PORTAL_H
#define RT_KERNELS_LIGHT_PORTAL_H

#include "light/area.h"
#include "light/environment.h"

static inline bool has_portals(const struct scene *scene)
{
    return scene->header->portal_count != 0u;
}

static inline global const rt_light_data *portal_at(const struct scene *scene, uint i)
{
    return (global const rt_light_data *)((global const uchar *)scene->header +
                                          (size_t)scene->header->portals * RT_SCENE_ROW) +
           i;
}

/* Whether the line through a point in direction w goes through a portal, and at which t. */
static inline bool meets_portal(global const rt_light_data *portal, float3 from, float3 w, float *t)
{
    const float3 normal = row3(portal->normal), corner = row3(portal->a) - from;
    *t = dot(corner, normal) / dot(w, normal);
    if (!(fabs(*t) < INFINITY))
        return false;
    const float3 p = *t * w - corner;
    const float x = dot(p, row3(portal->b)), y = dot(p, row3(portal->c));
    return x >= 0.0f && x <= portal->width && y >= 0.0f && y <= portal->height;
}

/* ---- The image of the sky, seen through one ---------------------------------------- */

/* The rectangle of its table that a portal fills, in cells. */
struct portal_view {
    global const float *sums;  /* [cells + 1][cells + 1] of the cells below and to the left */
    global const float *cells; /* [cells][cells]; a runs along a row */
    uint count;                /* cells along an edge */
    float2 lo, hi;
    float side;          /* of the directions, along the normal */
    float before, light; /* sums to the left of it, and of it */
};

static inline float2 portal_cell(float2 tangent, uint count)
{
    return clamp((atan(tangent) * M_1_PI_F + 0.5f) * (float)count, 0.0f, (float)count);
}

/* False where the point is as good as in the portal's plane. */
static inline bool see_portal(struct portal_view *view, const struct scene *scene,
                              global const rt_light_data *portal, float3 from)
{
    const float3 corner = row3(portal->a) - from;
    const float z = dot(corner, row3(portal->normal)), inverse = 1.0f / fabs(z);
    const float2 lo = (float2)(dot(corner, row3(portal->b)), dot(corner, row3(portal->c)));
    const float2 hi = lo + (float2)(portal->width, portal->height);
    const uint count = scene->header->portal_cells;
    const size_t sums = (size_t)(count + 1u) * (count + 1u), cells = (size_t)count * count;
    view->sums = (global const float *)((global const uchar *)scene->header +
                                        (size_t)portal->texture * RT_SCENE_ROW) +
                 (z > 0.0f ? 0u : sums + cells);
    view->cells = view->sums + sums;
    view->count = count;
    view->side = z > 0.0f ? 1.0f : -1.0f;
    if (!(inverse < INFINITY))
        return false;
    view->lo = portal_cell(lo * inverse, count);
    view->hi = portal_cell(hi * inverse, count);
    return all(view->lo < view->hi);
}

/* The sums of a column of corners, from lo.y to hi.y. */
static inline float portal_column(const struct portal_view *view, uint column)
{
    const uint2 cell = min(convert_uint2((float2)(view->lo.y, view->hi.y)), view->count - 1u);
    const float2 part = (float2)(view->lo.y, view->hi.y) - convert_float2(cell);
    const uint stride = view->count + 1u;
    global const float *low = view->sums + (size_t)cell.x * stride + column;
    global const float *high = view->sums + (size_t)cell.y * stride + column;
    return mix(high[0], high[stride], part.y) - mix(low[0], low[stride], part.x);
}

/* The same at x between two of them. */
static inline float portal_column_at(const struct portal_view *view, float x)
{
    const uint i = min((uint)x, view->count - 1u);
    return mix(portal_column(view, i), portal_column(view, i + 1u), x - (float)i);
}

/* Below this, differences of the sums are noise: what is seen so small is left to the rest. */
#define RT_PORTAL_MASS 1e-5f

/* Finds the view of a portal, and what it holds of the sky's light; 0: as good as none. */
static inline float portal_light(struct portal_view *view, const struct scene *scene,
                                 global const rt_light_data *portal, float3 from)
{
    if (!see_portal(view, scene, portal, from))
        return 0.0f;
    view->before = portal_column_at(view, view->lo.x);
    view->light = portal_column_at(view, view->hi.x) - view->before;
    return view->light > RT_PORTAL_MASS ? view->light : 0.0f;
}

/* The cell of a column whose lower corner is the last of which the sums are at most this. */
static inline float find_portal_column(const struct portal_view *view, float sum)
{
    uint low = (uint)view->lo.x, high = (uint)ceil(view->hi.x);
    while (low + 1u < high) {
        const uint middle = (low + high) >> 1;
        if (portal_column(view, middle) <= sum)
            low = middle;
        else
            high = middle;
    }
    const float left = fmax((float)low, view->lo.x), right = fmin((float)low + 1.0f, view->hi.x);
    const float below = portal_column_at(view, left), all = portal_column_at(view, right) - below;
    return mix(left, right, all > 0.0f ? clamp((sum - below) / all, 0.0f, 1.0f) : 0.5f);
}

/* The height in a column of cells, by u in [0,1) of what it holds from lo.y to hi.y. */
static inline float find_portal_row(const struct portal_view *view, uint column, float u)
{
    const uint stride = view->count + 1u;
    global const float *sums = view->sums + column;
#define COLUMN_SUM(j) (sums[(size_t)(j)*stride + 1u] - sums[(size_t)(j)*stride])
    uint low = (uint)view->lo.y, high = (uint)ceil(view->hi.y);
    const uint last = high - 1u;
    const float first = mix(COLUMN_SUM(low), COLUMN_SUM(low + 1u), view->lo.y - (float)low);
    const float end = mix(COLUMN_SUM(last), COLUMN_SUM(last + 1u), view->hi.y - (float)last);
    const float sum = mix(first, end, u);
    while (low + 1u < high) {
        const uint middle = (low + high) >> 1;
        if (COLUMN_SUM(middle) <= sum)
            low = middle;
        else
            high = middle;
    }
    const float below = COLUMN_SUM(low), all = COLUMN_SUM(low + 1u) - below;
#undef COLUMN_SUM
    const float part = all > 0.0f ? clamp((sum - below) / all, 0.0f, 1.0f) : 0.5f;
    return clamp((float)low + part, view->lo.y, view->hi.y);
}

static inline float3 sample_portal_view(const struct portal_view *view,
                                        global const rt_light_data *portal, float2 u)
{
    const float x = find_portal_column(view, view->before + u.x * view->light);
    const float y = find_portal_row(view, min((uint)x, view->count - 1u), u.y);
    const float2 at = (float2)(x, y) / (float)view->count - 0.5f;
    return unit(tan(RT_PI * at.x) * row3(portal->b) + tan(RT_PI * at.y) * row3(portal->c) +
                view->side * row3(portal->normal));
}

/* The density of w, which lies within the view. */
static inline float portal_view_pdf_w(const struct portal_view *view,
                                      global const rt_light_data *portal, float3 w)
{
    const float2 tangent = (float2)(dot(w, row3(portal->b)), dot(w, row3(portal->c))) /
                           fabs(dot(w, row3(portal->normal)));
    const float2 at = portal_cell(tangent, view->count);
    const uint i = min((uint)at.x, view->count - 1u), j = min((uint)at.y, view->count - 1u);
    const float2 squares = 1.0f + tangent * tangent; /* 1 / cos^2 */
    const float r2 = squares.x + squares.y - 1.0f;
    const float cells = (float)view->count * M_1_PI_F; /* in a radian */
    return view->cells[(size_t)j * view->count + i] * cells * cells * r2 * sqrt(r2) /
           (squares.x * squares.y);
}

/* ---- One of them ------------------------------------------------------------------- */

/*
 * What it is chosen by, of this point, and its view where it has a table: the part of the sky's
 * light that is seen through it; of an even sky its solid angle over that of the sphere, or about
 * that where it is seen so small that it is sampled by area.
 */
static inline float portal_weight(struct portal_view *view, const struct scene *scene,
                                  global const rt_light_data *portal, float3 from)
{
    if (portal->texture != RT_NONE)
        return portal_light(view, scene, portal, from);
    struct seen_rectangle seen;
    if (see_rectangular_light(portal, from, &seen))
        return seen.solid_angle * sphere_pdf_w();
    const float3 middle = row3(portal->a) + 0.5f * (portal->width * row3(portal->b) +
                                                    portal->height * row3(portal->c));
    const float3 towards = middle - from;
    const float d2 = dot(towards, towards);
    return d2 > 0.0f ? sphere_pdf_w() * portal->area * fabs(dot(towards, row3(portal->normal))) /
                           (d2 * sqrt(d2))
                     : 0.0f;
}

/* The density, times its weight, of w, which meets it at t. */
static inline float portal_density(const struct scene *scene, global const rt_light_data *portal,
                                   float3 from, float3 w, float t)
{
    struct portal_view view;
    const float weight = portal_weight(&view, scene, portal, from);
    if (portal->texture != RT_NONE)
        return weight > 0.0f ? portal_view_pdf_w(&view, portal, w) : 0.0f;
    struct seen_rectangle seen;
    return see_rectangular_light(portal, from, &seen)
               ? sphere_pdf_w()
               : weight * t * t / (portal->area * fabs(dot(w, row3(portal->normal))));
}

/* ---- The environment, seen from a point -------------------------------------------- */

/* This part of what is sampled, and of the light paths that start, goes through portals. */
#define RT_PORTAL_PART 0.9f

/* One of the portals as it is seen from a point, and the sum of the weights of all. */
struct portal_choice {
    global const rt_light_data *portal;
    struct portal_view view; /* where it has a table */
    float sum;               /* 0: there is none to see */
};

/* Chooses one by its weight, and takes what it uses from *u, in [0,1). */
static inline void choose_portal(struct portal_choice *choice, const struct scene *scene,
                                 float3 from, float *u)
{
    choice->sum = 0.0f;
    choice->portal = 0;
    for (uint i = 0u; i < scene->header->portal_count; i++) {
        global const rt_light_data *portal = portal_at(scene, i);
        struct portal_view view;
        const float weight = portal_weight(&view, scene, portal, from);
        if (!(weight > 0.0f))
            continue;
        choice->sum += weight;
        const float part = weight / choice->sum;
        const bool is_chosen = *u < part;
        *u = fmin(is_chosen ? *u / part : (*u - part) / (1.0f - part), RT_BELOW_ONE);
        if (is_chosen) {
            choice->portal = portal;
            choice->view = view;
        }
    }
}

/*
 * The density of w from this point. through: the portal by which w was sampled, which at its edges
 * is met but for rounding; NULL: none.
 */
static inline float chosen_sky_pdf_w(const struct scene *scene, const struct portal_choice *choice,
                                     float3 from, float3 w, global const rt_light_data *through)
{
    const float pdf_w = environment_pdf_w(scene, w);
    if (!(choice->sum > 0.0f))
        return pdf_w;
    float density = 0.0f, t;
    for (uint i = 0u; i < scene->header->portal_count; i++) {
        global const rt_light_data *portal = portal_at(scene, i);
        const bool is_met = meets_portal(portal, from, w, &t) && t > 0.0f;
        if (!is_met && portal != through)
            continue;
        density += portal == choice->portal && portal->texture != RT_NONE
                       ? portal_view_pdf_w(&choice->view, portal, w)
                       : portal_density(scene, portal, from, w, t);
    }
    return mix(pdf_w, density / choice->sum, RT_PORTAL_PART);
}

/* The density of w by sample_sky, from this point. */
static inline float sky_pdf_w(const struct scene *scene, float3 from, float3 w)
{
    struct portal_choice choice;
    float u = 0.0f;
    choose_portal(&choice, scene, from, &u);
    return chosen_sky_pdf_w(scene, &choice, from, w, 0);
}

/* That density over that of sample_environment. */
static inline float portals_gain(const struct scene *scene, float3 from, float3 w)
{
    return has_portals(scene) ? sky_pdf_w(scene, from, w) / environment_pdf_w(scene, w) : 1.0f;
}

/* A direction through the chosen portal. */
static inline float3 sample_portal(const struct portal_choice *choice, float3 from, float2 u)
{
    if (choice->portal->texture != RT_NONE)
        return sample_portal_view(&choice->view, choice->portal, u);
    struct surface at;
    sample_area_light(&at, choice->portal, from, u);
    return unit(at.position - from);
}

/* As sample_environment, from a point, where there are portals. */
INLINE_NEVER float sample_through_portals(const struct scene *scene, float3 from, float2 u,
                                          float3 *w, float3 *radiance)
{
    struct portal_choice choice;
    const bool is_through = u.x < RT_PORTAL_PART;
    u.x = fmin(is_through ? u.x / RT_PORTAL_PART : (u.x - RT_PORTAL_PART) / (1.0f - RT_PORTAL_PART),
               RT_BELOW_ONE);
    float chance = u.x;
    choose_portal(&choice, scene, from, &chance);
    if (!(choice.sum > 0.0f))
        return sample_environment(scene, u, w, radiance);
    if (is_through) {
        *w = sample_portal(&choice, from, (float2)(chance, u.y));
        *radiance = environment_radiance(scene, *w);
    } else {
        sample_environment(scene, u, w, radiance);
    }
    const float pdf_w = chosen_sky_pdf_w(scene, &choice, from, *w, is_through ? choice.portal : 0);
    return pdf_w > 0.0f ? 1.0f / pdf_w : 0.0f;
}

/* As sample_environment, from a point. */
static inline float sample_sky(const struct scene *scene, float3 from, float2 u, float3 *w,
                               float3 *radiance)
{
    return has_portals(scene) ? sample_through_portals(scene, from, u, w, radiance)
                              : sample_environment(scene, u, w, radiance);
}

/* ---- Light paths that start at infinity -------------------------------------------- */

/* The area of all portals as light in direction w, or the opposite one, sees it. */
static inline float portals_across(const struct scene *scene, float3 w)
{
    float sum = 0.0f;
    for (uint i = 0u; i < scene->header->portal_count; i++) {
        global const rt_light_data *portal = portal_at(scene, i);
        sum += portal->area * fabs(dot(w, row3(portal->normal)));
    }
    return sum;
}

/* A point of them, uniform over that area, which is not 0. */
static inline float3 portals_point(const struct scene *scene, float3 w, float2 u, float across)
{
    const uint count = scene->header->portal_count;
    uint chosen = 0u;
    float before = 0.0f, part;
    for (;; before += part, chosen++) {
        global const rt_light_data *portal = portal_at(scene, chosen);
        part = portal->area * fabs(dot(w, row3(portal->normal)));
        if (u.x * across < before + part || chosen + 1u == count)
            break;
    }
    global const rt_light_data *portal = portal_at(scene, chosen);
    const float x = part > 0.0f ? clamp((u.x * across - before) / part, 0.0f, RT_BELOW_ONE) : 0.0f;
    return row3(portal->a) + x * portal->width * row3(portal->b) +
           u.y * portal->height * row3(portal->c);
}

/*
 * The density of the line through a point in direction w, over area that faces it. is_of_one: the
 * point is one of a portal, which at its edges is met but for rounding.
 */
static inline float portals_pdf_a(const struct scene *scene, float3 through, float3 w, float across,
                                  bool is_of_one)
{
    float t;
    uint met = 0u;
    for (uint i = 0u; i < scene->header->portal_count; i++)
        met += meets_portal(portal_at(scene, i), through, w, &t) ? 1u : 0u;
    return (float)(is_of_one ? max(met, 1u) : met) / across;
}

#endif
