/*
 * facet_tables.c - the tables of what the facets of materials lose, and of what those of coats
 * reflect, for the media that their boundaries may lie between.
 */
#include <math.h>
#include <string.h>

#include "scene/check.h"
#include "scene/inside.h"
#include "pack/facet_loss.h"
#include "pack/packing.h"

static const double pi = 3.14159265358979323846;

enum {
    row_floats = RT_LOSS_COSINES + 1,
    roughness_rows = 17, /* where a texture varies alpha */
    direction_rows = 9   /* where alpha depends on the direction */
};

/* ---- Which there are ------------------------------------------------------------------------- */

/* Whether its facets are those of a coat. */
static int is_coat(const rt_material *m)
{
    return m->coat > 0 && m->coat_roughness >= RT_SMOOTH_ALPHA;
}

static int has_table(const rt_material *m)
{
    return is_coat(m) || rt_material_scatters_often(m);
}

static float roughness_of(const rt_material *m)
{
    return is_coat(m) ? m->coat_roughness : m->roughness;
}

static int has_roughness_texture(const rt_material *m)
{
    return (is_coat(m) ? m->coat_roughness_texture : m->roughness_texture) != 0;
}

static float index_of(const rt_material *m)
{
    return is_coat(m) ? m->coat_ior : m->ior;
}

static int reflects_alone(const rt_material *m)
{
    return !is_coat(m) && rt_is_black(m->kt) && m->fresnel != RT_FRESNEL_DIELECTRIC;
}

static int is_anisotropic(const rt_material *m)
{
    return m->roughness_v > 0;
}

int rt_material_scatters_often(const rt_material *m)
{
    const int is_textured = m->roughness_texture || m->roughness_v_texture;
    return m->facet_scattering == RT_FACET_SCATTERING_MULTIPLE && !rt_material_is_principled(m) &&
           (!rt_is_black(m->ks) || !rt_is_black(m->kt)) && rt_material_is_rough(m) &&
           m->exponent == 0 && (reflects_alone(m) || m->fresnel == RT_FRESNEL_DIELECTRIC) &&
           !(is_anisotropic(m) && is_textured);
}

static float alpha_of(float roughness)
{
    return fmaxf(roughness, RT_SMOOTH_ALPHA);
}

static rt_u32 rows_of(const rt_material *m)
{
    if (is_anisotropic(m))
        return alpha_of(m->roughness) == alpha_of(m->roughness_v) ? 1 : direction_rows;
    return has_roughness_texture(m) ? roughness_rows : 1;
}

/* The index of solid i of the scene, or 0 where it is none, or has the index of one before it. */
static float new_index(const rt_scene *scene, size_t i)
{
    const rt_material *m = scene->materials + i;
    if (!rt_material_is_transparent(m) || m->ior == 1)
        return 0;
    for (size_t j = 0; j < i; j++)
        if (rt_material_is_transparent(scene->materials + j) && scene->materials[j].ior == m->ior)
            return 0;
    return m->ior;
}

/* Writes the indices of the inside over those of the outside if out is not NULL; how many. */
static rt_u32 list_pairs(const rt_scene *scene, const rt_material *m, float *out, size_t stride)
{
    rt_u32 count = 1;
    if (out)
        out[0] = reflects_alone(m) ? 0 : index_of(m);
    for (size_t i = 0; i < scene->material_count && !reflects_alone(m); i++) {
        const float outside = new_index(scene, i);
        if (outside > 0 && out)
            out[count * stride] = index_of(m) / outside;
        count += outside > 0;
    }
    return count;
}

static size_t side_floats(const rt_material *m)
{
    return (size_t)rows_of(m) * row_floats;
}

static size_t pair_floats(const rt_material *m)
{
    return 1 + 2 * side_floats(m);
}

static size_t table_bytes(const rt_scene *scene, const rt_material *m)
{
    if (!has_table(m))
        return 0;
    const size_t floats = list_pairs(scene, m, NULL, 0) * pair_floats(m);
    const size_t bytes = sizeof(rt_facet_losses) + floats * sizeof(float);
    return (bytes + RT_SCENE_ROW - 1) / RT_SCENE_ROW * RT_SCENE_ROW;
}

size_t rt_facet_tables_bytes(const rt_scene *scene)
{
    size_t bytes = 0;
    for (size_t i = 0; i < scene->material_count; i++)
        bytes += table_bytes(scene, scene->materials + i);
    return bytes;
}

/* ---- A side ---------------------------------------------------------------------------------- */

/* The cosine that lies at this place between the losses: RT_LOSS_PLACE, solved for it. */
static double cosine_at(double place, double along)
{
    return place * along / (1 + along - place);
}

/* Alpha along the view in a row, and the angle of the view to x. */
static double alpha_in_row(const rt_material *m, rt_u32 row, double *turn)
{
    const double u = alpha_of(roughness_of(m)), v = alpha_of(m->roughness_v);
    const rt_u32 rows = rows_of(m);
    *turn = 0;
    if (rows == 1)
        return u;
    const double part = (double)row / (rows - 1);
    if (!is_anisotropic(m))
        return fmax(part * u, RT_SMOOTH_ALPHA);
    const double along = fmin(u, v) + part * part * fabs(v - u);
    *turn = acos(sqrt(fmin(fmax((along * along - v * v) / (u * u - v * v), 0), 1)));
    return along;
}

/* Between the losses of a row, and between two rows, as kernels have it. */
static double loss_between(const float *losses, rt_u32 rows, double row, double place)
{
    const double x = fmin(fmax(place, 0), 1) * (RT_LOSS_COSINES - 1);
    const rt_u32 i = x < RT_LOSS_COSINES - 2 ? (rt_u32)x : RT_LOSS_COSINES - 2;
    const rt_u32 j = rows < 2 ? 0 : row < rows - 2 ? (rt_u32)row : rows - 2;
    const float *low = losses + (size_t)j * row_floats + i,
                *high = rows < 2 ? low : low + row_floats;
    const double from = low[0] + (x - i) * (low[1] - low[0]);
    return from + (row - j) * (high[0] + (x - i) * (high[1] - high[0]) - from);
}

/* Twice the integral of loss times cosine over the cosine, for this alpha along the view. */
static double mean_loss(const float *losses, rt_u32 rows, double row, double along)
{
    enum { steps = 512 };
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        const double place = (i + 0.5) / steps, cosine = cosine_at(place, along);
        const double slope = along * (1 + along) / ((1 + along - place) * (1 + along - place));
        sum += loss_between(losses, rows, row, place) * cosine * slope;
    }
    return 2 * sum / steps;
}

/* The same over all directions of anisotropic facets. */
static double mean_of_directions(const rt_material *m, const float *losses)
{
    enum { steps = 64 };
    const double u = alpha_of(m->roughness), v = alpha_of(m->roughness_v);
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        const double turn = (i + 0.5) / steps * pi / 2, along = hypot(u * cos(turn), v * sin(turn));
        const double row = sqrt(fmax(along - fmin(u, v), 0) / fabs(v - u)) * (direction_rows - 1);
        sum += mean_loss(losses, direction_rows, row, along);
    }
    return sum / steps;
}

static void fill_side(const rt_material *m, double eta, float *losses)
{
    const rt_u32 rows = rows_of(m);
    for (rt_u32 row = 0; row < rows; row++) {
        double turn;
        const double along = alpha_in_row(m, row, &turn);
        rt_facets facets = {along, along, m->distribution == RT_DISTRIBUTION_BECKMANN, eta, 0};
        if (is_anisotropic(m)) {
            facets.alpha_u = alpha_of(m->roughness);
            facets.alpha_v = alpha_of(m->roughness_v);
        }
        for (rt_u32 i = 0; i < RT_LOSS_COSINES; i++) {
            const double cosine = cosine_at((double)i / (RT_LOSS_COSINES - 1), along);
            losses[row * row_floats + i] = (float)rt_facet_loss(&facets, fmax(cosine, 1e-6), turn);
        }
    }
    const int has_directions = is_anisotropic(m) && rows > 1;
    const double mean = has_directions ? mean_of_directions(m, losses) : 0;
    for (rt_u32 row = 0; row < rows; row++) {
        double turn;
        const double along = alpha_in_row(m, row, &turn);
        losses[row * row_floats + RT_LOSS_COSINES] =
            (float)(has_directions ? mean : mean_loss(losses, rows, row, along));
    }
}

/* ---- A coat ---------------------------------------------------------------------------------- */

/* Twice the integral over the cosine of what facets reflect times it. */
static double mean_reflected(const rt_facets *facets)
{
    enum { steps = 64 };
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += rt_facet_reflected(facets, sqrt((i + 0.5) / steps));
    return sum / steps;
}

static double mean_smooth(double eta)
{
    enum { steps = 1024 };
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += rt_smooth_reflectance(sqrt((i + 0.5) / steps), eta);
    return sum / steps;
}

/*
 * What a coat of index m keeps out more than a smooth one, which its facets reflect, or do not
 * refract where they scatter light once; and what the mean Fi of bsdf/coated.h is more: what enters
 * leaves again, or facets inside reflect once.
 */
static void fill_coat(const rt_material *material, double m, float *excesses)
{
    const rt_u32 rows = rows_of(material);
    const int is_single = material->facet_scattering == RT_FACET_SCATTERING_SINGLE;
    for (rt_u32 row = 0; row < rows; row++) {
        double turn;
        const double along = alpha_in_row(material, row, &turn);
        const int is_beckmann = material->distribution == RT_DISTRIBUTION_BECKMANN;
        const rt_facets outer = {along, along, is_beckmann, 1 / m, is_single},
                        inner = {along, along, is_beckmann, m, is_single};
        float *excess = excesses + row * row_floats;
        for (rt_u32 i = 0; i < RT_LOSS_COSINES; i++) {
            const double cosine = fmax(cosine_at((double)i / (RT_LOSS_COSINES - 1), along), 1e-6);
            const double out = is_single ? 1 - rt_facet_refracted(&outer, cosine)
                                         : rt_facet_reflected(&outer, cosine);
            excess[i] = (float)(out - rt_smooth_reflectance(cosine, 1 / m));
        }
        excess[RT_LOSS_COSINES] = (float)(is_single ? mean_reflected(&inner) - mean_smooth(m)
                                                    : mean_loss(excess, 1, 0, along) / (m * m));
    }
}

/* ---- A table --------------------------------------------------------------------------------- */

/* Of a metal of index eta + i k; see kernels/bsdf/fresnel.h. */
static double metal_reflectance(double cosine, double eta, double k)
{
    const double cos2 = cosine * cosine, sin2 = 1 - cos2, real = eta * eta - k * k - sin2;
    const double size = hypot(real, 2 * eta * k), a = sqrt(fmax(0.5 * (size + real), 0));
    const double mixed = 2 * cosine * a, s = (size + cos2 - mixed) / (size + cos2 + mixed);
    const double far = cos2 * size + sin2 * sin2;
    return 0.5 * (s + s * (far - mixed * sin2) / (far + mixed * sin2));
}

static float mean_reflectance(const rt_material *m, int channel)
{
    enum { steps = 256 };
    double sum = 0;
    if (m->fresnel != RT_FRESNEL_CONDUCTOR)
        return 1;
    for (int i = 0; i < steps; i++)
        sum += metal_reflectance(sqrt((i + 0.5) / steps), m->eta[channel], m->k[channel]);
    return (float)(sum / steps);
}

/* Whether the facets of both lose the same. */
static int lose_the_same(const rt_material *a, const rt_material *b)
{
    return has_table(a) && is_coat(a) == is_coat(b) && roughness_of(a) == roughness_of(b) &&
           (!is_coat(a) || a->facet_scattering == b->facet_scattering) &&
           a->roughness_v == b->roughness_v && a->distribution == b->distribution &&
           rows_of(a) == rows_of(b) && reflects_alone(a) == reflects_alone(b) &&
           (reflects_alone(a) || index_of(a) == index_of(b));
}

static void fill_table(const rt_scene *scene, const rt_material *m, rt_facet_losses *out)
{
    float *floats = (float *)(out + 1);
    const size_t stride = pair_floats(m), side = side_floats(m);
    out->largest_alpha = alpha_of(roughness_of(m));
    out->rows = rows_of(m);
    const double u = alpha_of(roughness_of(m)),
                 v = is_anisotropic(m) ? alpha_of(m->roughness_v) : u;
    out->range = has_roughness_texture(m) ? 0 : (float)log1p(1 / (u * v));
    out->pairs = list_pairs(scene, m, floats, stride);
    for (rt_u32 i = 0; i < out->pairs; i++) {
        float *pair = floats + i * stride;
        if (is_coat(m)) {
            /* The base is on the same side, however close the two indices are. */
            fill_coat(m, pair[0], pair + 1);
            memcpy(pair + 1 + side, pair + 1, side * sizeof *pair);
            continue;
        }
        fill_side(m, pair[0] > 0 ? 1 / (double)pair[0] : 0, pair + 1);
        if (pair[0] > 0)
            fill_side(m, pair[0], pair + 1 + side);
    }
}

void rt_pack_facet_tables(const rt_packing *p)
{
    const rt_scene *scene = p->scene;
    rt_material_data *materials = rt_packing_table(p, p->header.materials);
    char *next = rt_packing_table(p, p->facet_losses);
    for (size_t i = 0; i < scene->material_count; i++) {
        const rt_material *m = scene->materials + i;
        const size_t bytes = table_bytes(scene, m);
        size_t same = 0;
        if (bytes == 0)
            continue;
        while (same < i && !lose_the_same(scene->materials + same, m))
            same++;
        if (same < i)
            memcpy(next, (char *)(materials + same) + materials[same].facet_losses, bytes);
        else
            fill_table(scene, m, (rt_facet_losses *)next);
        for (int c = 0; c < 3; c++)
            ((rt_facet_losses *)next)->mean_reflectance[c] = mean_reflectance(m, c);
        materials[i].facet_losses = (rt_u32)(next - (char *)(materials + i));
        next += bytes;
    }
}
