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

/* What a table is of: facets; or those of a coat, those below it, and those beside it. */
enum { FACETS, COAT, COVERED, BARE, KINDS };

typedef struct facet_table {
    const rt_material *m;
    int kind;
    float u, v; /* alpha along u and along v, the largest where a texture varies it */
    int is_anisotropic, is_textured;
    int is_by_coat; /* below a coat: its rows are for alphas of the coat, which a texture varies */
} facet_table;

static int has_rough_coat(const rt_material *m)
{
    return m->coat > 0 && m->coat_roughness >= RT_SMOOTH_ALPHA;
}

static int reflects_alone(const facet_table *t)
{
    return t->kind == BARE ||
           (t->kind == FACETS && rt_is_black(t->m->kt) && t->m->fresnel != RT_FRESNEL_DIELECTRIC);
}

/* Whether it is of a coat or below one. */
static int is_coat(const facet_table *t)
{
    return t->kind == COAT || t->kind == COVERED;
}

static int has_even_facets(const rt_material *m)
{
    return m->roughness_v == 0 || (!m->roughness_texture && !m->roughness_v_texture);
}

static int scatters_once(const rt_material *m)
{
    return m->facet_scattering != RT_FACET_SCATTERING_MULTIPLE;
}

int rt_material_scatters_often(const rt_material *m)
{
    const int is_opaque = rt_is_black(m->kt) && m->fresnel != RT_FRESNEL_DIELECTRIC;
    return !scatters_once(m) && !rt_material_is_principled(m) &&
           (!rt_is_black(m->ks) || !rt_is_black(m->kt)) && rt_material_is_rough(m) &&
           m->exponent == 0 && (is_opaque || m->fresnel == RT_FRESNEL_DIELECTRIC) &&
           has_even_facets(m);
}

static int has_table(const rt_material *m, int kind)
{
    const int is_covered =
        rt_material_is_lacquer(m) && rt_material_scatters_often(m) &&
        !(m->coat_roughness_texture && (m->roughness_texture || m->roughness_v > 0));
    const int is_here[KINDS] = {m->coat == 0 && rt_material_scatters_often(m),
                                is_covered || has_rough_coat(m), is_covered,
                                is_covered && (m->coat < 1 || m->coat_texture)};
    return is_here[kind];
}

static float alpha_of(float roughness)
{
    return fmaxf(roughness, RT_SMOOTH_ALPHA);
}

static facet_table table_of(const rt_material *m, int kind)
{
    const float coat = has_rough_coat(m) ? m->coat_roughness : 0;
    const float blur = kind == COVERED ? RT_COAT_BLUR(coat, 1 / m->coat_ior) : 0;
    const int is_varied = m->coat_roughness_texture != 0;
    facet_table t = {
        m, kind, alpha_of(coat), alpha_of(coat), 0, is_varied, kind == COVERED && is_varied};
    if (kind == COAT || t.is_by_coat)
        return t;
    t.is_anisotropic = m->roughness_v > 0;
    t.is_textured = m->roughness_texture != 0;
    const float v = t.is_anisotropic ? m->roughness_v : m->roughness;
    const int is_smooth = fmaxf(m->roughness, v) < RT_SMOOTH_ALPHA;
    t.u = alpha_of(hypotf(is_smooth ? 0 : alpha_of(m->roughness), blur));
    t.v = alpha_of(hypotf(is_smooth ? 0 : alpha_of(v), blur));
    return t;
}

static float index_of(const facet_table *t)
{
    return is_coat(t) ? t->m->coat_ior : t->m->ior;
}

static rt_u32 rows_of(const facet_table *t)
{
    if (t->is_anisotropic)
        return t->u == t->v ? 1 : direction_rows;
    return t->is_textured ? roughness_rows : 1;
}

/* The index of solid i of the scene, or 0 where it is none, or has the index of one before it. */
static float new_index(const rt_scene *scene, size_t i)
{
    const rt_material *m = scene->materials + i;
    const float ior = rt_material_inner_ior(m);
    if (!rt_material_is_transparent(m) || ior == 1)
        return 0;
    for (size_t j = 0; j < i; j++)
        if (rt_material_is_transparent(scene->materials + j) &&
            rt_material_inner_ior(scene->materials + j) == ior)
            return 0;
    return ior;
}

/* Writes the indices of the inside over those of the outside if out is not NULL; how many. */
static rt_u32 list_pairs(const rt_scene *scene, const facet_table *t, float *out, size_t stride)
{
    rt_u32 count = 1;
    if (out)
        out[0] = reflects_alone(t) ? 0 : index_of(t);
    const int is_alone = reflects_alone(t) || t->m->relative_ior;
    for (size_t i = 0; i < scene->material_count && !is_alone; i++) {
        const float outside = new_index(scene, i);
        if (outside > 0 && out)
            out[count * stride] = index_of(t) / outside;
        count += outside > 0;
    }
    return count;
}

static size_t side_floats(const facet_table *t)
{
    return (size_t)rows_of(t) * row_floats;
}

static size_t pair_floats(const facet_table *t)
{
    return 1 + 2 * side_floats(t);
}

static size_t table_bytes(const rt_scene *scene, const rt_material *m, int kind)
{
    if (!has_table(m, kind))
        return 0;
    const facet_table t = table_of(m, kind);
    const size_t floats = list_pairs(scene, &t, NULL, 0) * pair_floats(&t);
    const size_t bytes = sizeof(rt_facet_losses) + floats * sizeof(float);
    return (bytes + RT_SCENE_ROW - 1) / RT_SCENE_ROW * RT_SCENE_ROW;
}

/* Of all tables of a material. */
static size_t tables_bytes(const rt_scene *scene, const rt_material *m)
{
    size_t bytes = 0;
    for (int kind = 0; kind < KINDS; kind++)
        bytes += table_bytes(scene, m, kind);
    return bytes;
}

size_t rt_facet_tables_bytes(const rt_scene *scene)
{
    size_t bytes = 0;
    for (size_t i = 0; i < scene->material_count; i++)
        bytes += tables_bytes(scene, scene->materials + i);
    return bytes;
}

/* ---- A side ---------------------------------------------------------------------------------- */

/* The cosine that lies at this place between the losses: RT_LOSS_PLACE, solved for it. */
static double cosine_at(double place, double along)
{
    return place * along / (1 + along - place);
}

/* Alpha along the view in a row, and the angle of the view to x. */
static double alpha_in_row(const facet_table *t, rt_u32 row, double *turn)
{
    const double u = t->u, v = t->v;
    const rt_u32 rows = rows_of(t);
    *turn = 0;
    if (rows == 1)
        return u;
    const double part = (double)row / (rows - 1);
    if (!t->is_anisotropic)
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

/* How the losses of a table are spread over cosines, for this alpha along the view. */
static double spread_of(const facet_table *t, double along)
{
    return is_coat(t) ? fmax(along, RT_COAT_SPREAD) : along;
}

/* Twice the integral of loss times cosine over the cosine; along: the spread. */
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
static double mean_of_directions(const facet_table *t, const float *losses)
{
    enum { steps = 64 };
    const double u = t->u, v = t->v;
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        const double turn = (i + 0.5) / steps * pi / 2, along = hypot(u * cos(turn), v * sin(turn));
        const double row = sqrt(fmax(along - fmin(u, v), 0) / fabs(v - u)) * (direction_rows - 1);
        sum += mean_loss(losses, direction_rows, row, spread_of(t, along));
    }
    return sum / steps;
}

/* A coat as light meets it that enters or leaves. */
typedef struct coat_side {
    double eta, spread;
    const float *excess; /* a row of its table; NULL: it is smooth */
} coat_side;

static double passes(const void *coat, double cosine)
{
    const coat_side *c = coat;
    const double more =
        c->excess ? loss_between(c->excess, 1, 0, RT_LOSS_PLACE(cosine, c->spread)) : 0;
    return fmax(1 - rt_smooth_reflectance(cosine, c->eta) - more, 0);
}

/* What is lost at this cosine, from what reaches the facets; coat: over them, or NULL. */
static double loss_at(const rt_facets *facets, const coat_side *coat, double cosine, double turn)
{
    return coat ? fmax(passes(coat, cosine) -
                           rt_facet_covered(facets, coat->eta, cosine, turn, passes, coat),
                       0)
                : rt_facet_loss(facets, cosine, turn);
}

/* The facets of a row, for this alpha along the view. */
static rt_facets facets_in_row(const facet_table *t, double along, double eta)
{
    rt_facets facets = {along, along, t->m->distribution == RT_DISTRIBUTION_BECKMANN, eta, 0};
    if (t->is_anisotropic) {
        facets.alpha_u = t->u;
        facets.alpha_v = t->v;
    }
    if (t->is_by_coat) {
        const double own = t->m->roughness < RT_SMOOTH_ALPHA ? 0 : t->m->roughness;
        const double blur = RT_COAT_BLUR(along, 1 / (double)t->m->coat_ior);
        facets.alpha_u = facets.alpha_v = fmax(hypot(own, blur), RT_SMOOTH_ALPHA);
    }
    return facets;
}

/* coat: over the facets of the first row, or NULL. */
static void fill_side(const facet_table *t, double eta, const coat_side *coat, float *losses)
{
    const rt_u32 rows = rows_of(t);
    for (rt_u32 row = 0; row < rows; row++) {
        double turn;
        const double along = alpha_in_row(t, row, &turn), spread = spread_of(t, along);
        const rt_facets facets = facets_in_row(t, along, eta);
        coat_side over = coat ? *coat : (coat_side){0, 0, NULL};
        if (coat && t->is_by_coat) {
            over.spread = spread;
            over.excess += (size_t)row * row_floats;
        }
        for (rt_u32 i = 0; i < RT_LOSS_COSINES; i++) {
            const double cosine = fmax(cosine_at((double)i / (RT_LOSS_COSINES - 1), spread), 1e-6);
            losses[row * row_floats + i] =
                (float)loss_at(&facets, coat ? &over : NULL, cosine, turn);
        }
    }
    const int has_directions = t->is_anisotropic && rows > 1;
    const double mean = has_directions ? mean_of_directions(t, losses) : 0;
    for (rt_u32 row = 0; row < rows; row++) {
        double turn;
        const double along = alpha_in_row(t, row, &turn);
        losses[row * row_floats + RT_LOSS_COSINES] =
            (float)(has_directions ? mean : mean_loss(losses, rows, row, spread_of(t, along)));
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
static void fill_coat(const facet_table *t, double m, float *excesses)
{
    const rt_u32 rows = rows_of(t);
    const int is_single = scatters_once(t->m);
    for (rt_u32 row = 0; row < rows && has_rough_coat(t->m); row++) {
        double turn;
        const double along = alpha_in_row(t, row, &turn);
        const int is_beckmann = t->m->distribution == RT_DISTRIBUTION_BECKMANN;
        const rt_facets outer = {along, along, is_beckmann, 1 / m, is_single},
                        inner = {along, along, is_beckmann, m, is_single};
        const double spread = spread_of(t, along);
        float *excess = excesses + row * row_floats;
        for (rt_u32 i = 0; i < RT_LOSS_COSINES; i++) {
            const double cosine = fmax(cosine_at((double)i / (RT_LOSS_COSINES - 1), spread), 1e-6);
            const double out = is_single ? 1 - rt_facet_refracted(&outer, cosine)
                                         : rt_facet_reflected(&outer, cosine);
            excess[i] = (float)(out - rt_smooth_reflectance(cosine, 1 / m));
        }
        excess[RT_LOSS_COSINES] = (float)(is_single ? mean_reflected(&inner) - mean_smooth(m)
                                                    : mean_loss(excess, 1, 0, spread) / (m * m));
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

/* before: the index of the medium that it is met in */
static float mean_reflectance(const rt_material *m, double before, int channel)
{
    enum { steps = 256 };
    double sum = 0;
    if (m->fresnel == RT_FRESNEL_SCHLICK)
        return 20 / 21.0f;
    if (m->fresnel != RT_FRESNEL_CONDUCTOR)
        return 1;
    for (int i = 0; i < steps; i++)
        sum += metal_reflectance(sqrt((i + 0.5) / steps), m->eta[channel] / before,
                                 m->k[channel] / before);
    return (float)(sum / steps);
}

/* Whether the tables of both are the same. */
static int have_the_same(const rt_material *a, const rt_material *b)
{
    for (int kind = 0; kind < KINDS; kind++) {
        if (has_table(a, kind) != has_table(b, kind))
            return 0;
        if (!has_table(a, kind))
            continue;
        const facet_table s = table_of(a, kind), t = table_of(b, kind);
        if (s.u != t.u || s.v != t.v || a->distribution != b->distribution ||
            (kind == COVERED &&
             (a->coat_roughness != b->coat_roughness || a->roughness != b->roughness)) ||
            s.is_by_coat != t.is_by_coat ||
            (kind == COAT && scatters_once(a) != scatters_once(b)) || rows_of(&s) != rows_of(&t) ||
            reflects_alone(&s) != reflects_alone(&t) ||
            (!reflects_alone(&s) && index_of(&s) != index_of(&t)))
            return 0;
    }
    return 1;
}

/* coat: the table of the coat over these facets, or NULL. */
static void fill_table(const rt_scene *scene, const facet_table *t, const rt_facet_losses *coat,
                       rt_facet_losses *out)
{
    float *floats = (float *)(out + 1);
    const size_t stride = pair_floats(t), side = side_floats(t);
    out->largest_alpha = t->u;
    out->rows = rows_of(t);
    out->range = t->is_textured ? 0 : (float)log1p(1 / ((double)t->u * t->v));
    out->pairs = list_pairs(scene, t, floats, stride);
    for (rt_u32 i = 0; i < out->pairs; i++) {
        float *pair = floats + i * stride;
        if (!is_coat(t)) {
            fill_side(t, pair[0] > 0 ? 1 / (double)pair[0] : 0, NULL, pair + 1);
            if (pair[0] > 0)
                fill_side(t, pair[0], NULL, pair + 1 + side);
            continue;
        }
        /* The base is on the same side, however close the two indices are. */
        if (coat) {
            const size_t coat_stride = 1 + 2 * (size_t)coat->rows * row_floats;
            const float *row = (const float *)(coat + 1) + i * coat_stride + 1;
            const coat_side over = {1 / (double)pair[0], fmax(coat->largest_alpha, RT_COAT_SPREAD),
                                    has_rough_coat(t->m) ? row : NULL};
            fill_side(t, 0, &over, pair + 1);
        } else {
            fill_coat(t, pair[0], pair + 1);
        }
        memcpy(pair + 1 + side, pair + 1, side * sizeof *pair);
    }
}

/* Fills all tables of a material, one behind the other. */
static void fill_tables(const rt_scene *scene, const rt_material *m, char *out)
{
    rt_facet_losses *coat = NULL, *before = NULL;
    for (int kind = 0; kind < KINDS; kind++) {
        if (!has_table(m, kind))
            continue;
        const facet_table t = table_of(m, kind);
        fill_table(scene, &t, coat, (rt_facet_losses *)out);
        if (before)
            before->next = (rt_u32)(out - (char *)before);
        before = (rt_facet_losses *)out;
        coat = kind == COAT ? before : coat;
        out += table_bytes(scene, m, kind);
    }
}

/*
 * The colours of a metal, which the tables of others do not share. Schlick's reflectance is 20 / 21
 * of ks and 1 / 21 on the average, as 2 int (1 - u)^5 u du is 1 / 21.
 */
static void colour_tables(const rt_material *m, char *tables)
{
    for (int kind = 0; kind < KINDS; kind++) {
        if (!has_table(m, kind))
            continue;
        rt_facet_losses *table = (rt_facet_losses *)tables;
        for (int c = 0; c < 3; c++)
            table->mean_reflectance[c] = mean_reflectance(m, kind == COVERED ? m->coat_ior : 1, c);
        table->black_reflectance = m->fresnel == RT_FRESNEL_SCHLICK ? 1 / 21.0f : 0;
        tables += table->next;
    }
}

void rt_pack_facet_tables(const rt_packing *p)
{
    const rt_scene *scene = p->scene;
    rt_material_data *materials = rt_packing_table(p, p->header.materials);
    char *next = rt_packing_table(p, p->facet_losses);
    for (size_t i = 0; i < scene->material_count; i++) {
        const rt_material *m = scene->materials + i;
        const size_t bytes = tables_bytes(scene, m);
        size_t same = 0;
        if (bytes == 0)
            continue;
        while (same < i && !have_the_same(scene->materials + same, m))
            same++;
        if (same < i)
            memcpy(next, (char *)(materials + same) + materials[same].facet_losses, bytes);
        else
            fill_tables(scene, m, next);
        colour_tables(m, next);
        materials[i].facet_losses = (rt_u32)(next - (char *)(materials + i));
        next += bytes;
    }
}
