/*
 * mitsuba_medium.c - participating media of Mitsuba 3, which fill the shapes that name them as
 * `interior`: coefficients, phase functions and grids.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mitsuba.h"

/* A file of a grid: `VOL`, its version and kind, counts along x, y, z, channels, and a box. */
enum { VOL_HEAD = 48, VOL_VERSION = 3, VOL_FLOATS = 1, VOXELS_MAX = 1 << 28 };

/* ---- Grids ------------------------------------------------------------------- */

static uint32_t number(const char *bytes)
{
    uint32_t value = 0;
    for (int i = 4; i-- > 0;)
        value = value << 8 | (unsigned char)bytes[i];
    return value;
}

static float real(const char *bytes)
{
    const uint32_t bits = number(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Counts and channels of a file of a grid, and how many voxels it has; 0 after a failure. */
static size_t read_head(mitsuba *m, const xml_node *node, const char *name, const char *bytes,
                        size_t size, uint32_t counts[4])
{
    size_t voxels = 1;
    if (size < VOL_HEAD || memcmp(bytes, "VOL", 3) != 0 || bytes[3] != VOL_VERSION ||
        number(bytes + 4) != VOL_FLOATS) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line,
                       "'%.100s' is no grid of single precision, version 3", name);
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        counts[i] = number(bytes + 8 + 4 * i);
        voxels = counts[i] > 0 && counts[i] <= VOXELS_MAX / voxels ? voxels * counts[i] : 0;
        if (voxels == 0) {
            rt_import_fail(rt_mitsuba_at(m, node), node->line,
                           "'%.100s' is a grid of no voxel, or of too many", name);
            return 0;
        }
    }
    if ((size - VOL_HEAD) / 4 < voxels) {
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "'%.100s' ends before its last voxel",
                       name);
        return 0;
    }
    if (size - VOL_HEAD > 4 * voxels)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "what follows the last voxel of '%.100s' is left out", name);
    return voxels / counts[3];
}

/* What a grid of the language holds. */
typedef enum grid_use { USE_DENSITY, USE_ALBEDO } grid_use;

/* Tells what a grid does not keep. */
static void note_grid(mitsuba *m, const xml_node *node, uint32_t channels, int is_below,
                      int is_above)
{
    if (is_below)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the negative values of a grid became 0");
    if (is_above)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the albedos above 1 of a grid became 1");
    if (channels != 1 && channels != 3)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a grid of %lu channels became one of their mean",
                          (unsigned long)channels);
}

/* The numbers of a grid, in one channel or three: of other numbers the mean; to be freed. */
static float *convert_grid(mitsuba *m, const xml_node *node, const char *name, grid_use use,
                           uint32_t counts[4], double box[2][3])
{
    const double most = use == USE_ALBEDO ? 1 : 1e28;
    size_t size;
    char *bytes = rt_import_read(rt_mitsuba_at(m, node), node->line, name, &size);
    const size_t voxels = bytes ? read_head(m, node, name, bytes, size, counts) : 0;
    const size_t channels = voxels && counts[3] == 3 ? 3 : 1,
                 merged = voxels ? counts[3] / channels : 1; /* channels that become one */
    float *out = voxels ? malloc(voxels * channels * sizeof *out) : NULL;
    if (voxels && !out)
        rt_import_fail_memory(m->import);
    int is_below = 0, is_above = 0;
    for (int i = 0; out && i < 6; i++)
        box[i / 3][i % 3] = real(bytes + 24 + 4 * i);
    for (size_t i = 0; out && i < voxels * channels; i++) {
        double sum = 0;
        for (size_t c = 0; c < merged; c++)
            sum += real(bytes + VOL_HEAD + 4 * (i * merged + c));
        out[i] = (float)fmin(fmax(sum / (double)merged, 0), most);
        is_below |= sum < 0;
        is_above |= use == USE_ALBEDO && sum > (double)merged;
        if (!isfinite(sum) && !m->import->failed)
            rt_import_fail(rt_mitsuba_at(m, node), node->line,
                           "'%.100s' has a value that is not finite", name);
    }
    if (out) {
        note_grid(m, node, counts[3], is_below, is_above);
        counts[3] = (uint32_t)channels;
    }
    free(bytes);
    return out;
}

/* What a volume is: a grid, or a constant. */
typedef struct volume {
    int grid;         /* its handle, or IMPORT_NONE */
    double colour[3]; /* 1 of a grid */
} volume;

/*
 * From the unit cube to the box of the file, if that counts, and from there. In Mitsuba 0.x it does
 * unless min and max are given.
 */
static matrix place_grid(mitsuba *m, xml_node *node, double box[2][3])
{
    const matrix to_world = rt_mitsuba_transform(m, node, "to_world");
    if (!m->is_old && !rt_mitsuba_flag(m, node, "use_grid_bbox", 0))
        return to_world;
    if (m->is_old) {
        rt_mitsuba_vector(m, node, "min", box[0]);
        rt_mitsuba_vector(m, node, "max", box[1]);
    }
    const matrix move = rt_matrix_translate(box[0][0], box[0][1], box[0][2]),
                 size = rt_matrix_scale(box[1][0] - box[0][0], box[1][1] - box[0][1],
                                        box[1][2] - box[0][2]),
                 inside = rt_matrix_multiply(&move, &size);
    return rt_matrix_multiply(&to_world, &inside);
}

/* Whether an albedo is repeated outside of the box of its grid; a density ends with that. */
static int read_wrap(mitsuba *m, xml_node *node, grid_use use)
{
    const char *wrap = use == USE_ALBEDO ? rt_mitsuba_string(m, node, "wrap_mode") : NULL;
    if (!wrap || strcmp(wrap, "clamp") == 0)
        return 0;
    if (strcmp(wrap, "repeat") != 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a grid that goes on by '%.40s' is repeated", wrap);
    return 1;
}

static void read_grid(mitsuba *m, xml_node *node, grid_use use, volume *out)
{
    char file[512];
    uint32_t counts[4];
    double box[2][3];
    const char *name = rt_mitsuba_string(m, node, "filename");
    float *grid = name ? convert_grid(m, node, name, use, counts, box) : NULL;
    const int repeats = read_wrap(m, node, use);
    if (!name)
        rt_import_fail(rt_mitsuba_at(m, node), node->line, "a gridvolume without filename");
    const matrix to_world = grid ? place_grid(m, node, box) : rt_matrix_identity();
    if (grid && !m->import->failed &&
        rt_import_write_grid(rt_mitsuba_at(m, node), file, counts, counts[3], grid))
        out->grid = rt_import_add_grid(m->import, "grid", file, NULL, &to_world, repeats);
    for (int c = 0; c < 3; c++)
        out->colour[c] = 1;
    free(grid);
}

static volume read_volume(mitsuba *m, xml_node *node, const char *name, const double fallback[3],
                          grid_use use)
{
    volume out = {IMPORT_NONE, {fallback[0], fallback[1], fallback[2]}};
    xml_node *child = rt_mitsuba_child(node, name);
    if (!child || rt_mitsuba_colour(m, node, name, out.colour))
        return out;
    xml_node *const of = rt_mitsuba_follow(m, child);
    const char *type = of ? rt_mitsuba_text(m, of, "type") : "";
    if (!of || strcmp(of->tag, "volume") != 0)
        return out;
    rt_mitsuba_read(m, child, of);
    if (strcmp(type, "gridvolume") == 0) {
        read_grid(m, of, use, &out);
    } else if (strcmp(type, "constvolume") == 0) {
        rt_mitsuba_colour(m, of, "value", out.colour);
    } else {
        rt_import_note_at(rt_mitsuba_at(m, of), of->line, "a volume '%.40s' is left out", type);
        rt_mitsuba_leave(of);
    }
    return out;
}

/* ---- Media ------------------------------------------------------------------- */

static double read_phase(mitsuba *m, xml_node *node, double fallback)
{
    for (xml_node *child = node->first; child; child = child->next) {
        xml_node *const phase = strcmp(child->tag, "phase") == 0 || strcmp(child->tag, "ref") == 0
                                    ? rt_mitsuba_follow(m, child)
                                    : NULL;
        if (!phase || strcmp(phase->tag, "phase") != 0)
            continue;
        const char *type = rt_mitsuba_text(m, phase, "type");
        rt_mitsuba_read(m, child, phase);
        if (strcmp(type, "hg") == 0) {
            const double g = rt_mitsuba_number(m, phase, "g", 0.8);
            if (fabs(g) > 0.99)
                rt_import_note_at(rt_mitsuba_at(m, phase), phase->line, "a g of %g is taken as %g",
                                  g, g < 0 ? -0.99 : 0.99);
            return fmin(fmax(g, -0.99), 0.99);
        }
        if (strcmp(type, "isotropic") != 0) {
            rt_import_note_at(rt_mitsuba_at(m, phase), phase->line,
                              "a phase function '%.40s' became isotropic", type);
            rt_mitsuba_leave(phase);
        }
        return 0;
    }
    return fallback;
}

/*
 * What a medium has where nothing else is given: in Mitsuba 3 an extinction of 1 and an albedo of
 * 0.75, in 0.x what its preset has, or skin, a hundredfold. Returns the preset's name, or NULL.
 */
static const char *read_preset(mitsuba *m, xml_node *node, import_preset *out)
{
    const char *const written = rt_mitsuba_string(m, node, "material");
    const int is_even = strcmp(rt_mitsuba_text(m, node, "type"), "homogeneous") == 0;
    *out = (import_preset){.absorption = {0.25, 0.25, 0.25}, .scattering = {0.75, 0.75, 0.75}};
    if (!written && (!m->is_old || !is_even))
        return NULL;
    if (!rt_import_preset(written ? written : "Skin1", out)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "there is no medium '%.40s' of Mitsuba's: skin stands in its place",
                          written);
        rt_import_preset("Skin1", out);
    }
    for (int c = 0; c < 3; c++) {
        out->absorption[c] *= 100;
        out->scattering[c] *= 100;
    }
    return written;
}

/* Tells what is given twice, which Mitsuba refuses. */
static void note_both(mitsuba *m, xml_node *node, int has_parts, int has_sum, const char *preset)
{
    if (has_parts && has_sum)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "sigma_t and albedo are left out beside sigma_s or sigma_a, where "
                          "Mitsuba refuses both");
    if (preset && (has_parts || has_sum))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "of '%.40s' a medium has only what is not given beside it, where Mitsuba "
                          "refuses both",
                          preset);
}

/*
 * Scattering and absorption, from these or from the extinction and the albedo. Returns the g of a
 * phase function that is not given.
 */
static double read_coefficients(mitsuba *m, xml_node *node, import_material *out)
{
    import_preset preset;
    double sum[3], part[3];
    const char *const name = read_preset(m, node, &preset);
    const double scale = rt_mitsuba_number(m, node, "scale", 1);
    const char *const density =
        m->is_old && rt_mitsuba_child(node, "density") ? "density" : "sigma_t";
    const int has_sum = rt_mitsuba_child(node, density) || rt_mitsuba_child(node, "albedo");
    for (int c = 0; c < 3; c++) {
        sum[c] = preset.scattering[c] + preset.absorption[c];
        part[c] = preset.scattering[c] / sum[c];
    }
    const volume extinction = read_volume(m, node, density, sum, USE_DENSITY),
                 albedo = read_volume(m, node, "albedo", part, USE_ALBEDO);
    double sigma_s[3] = {0, 0, 0}, sigma_a[3] = {0, 0, 0};
    if (name || m->is_old) {
        memcpy(sigma_s, preset.scattering, sizeof sigma_s);
        memcpy(sigma_a, preset.absorption, sizeof sigma_a);
    }
    const int has_s = rt_mitsuba_colour(m, node, "sigma_s", sigma_s),
              has_a = rt_mitsuba_colour(m, node, "sigma_a", sigma_a), has_parts = has_s || has_a;
    note_both(m, node, has_parts, has_sum, name);
    out->density = has_parts ? IMPORT_NONE : extinction.grid;
    out->albedo = has_parts ? IMPORT_NONE : albedo.grid;
    if (albedo.colour[0] > 1 || albedo.colour[1] > 1 || albedo.colour[2] > 1)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line, "an albedo above 1 became 1");
    for (int c = 0; c < 3; c++) {
        const double t = extinction.colour[c], a = fmin(fmax(albedo.colour[c], 0), 1);
        out->scattering[c] = scale * (has_parts ? sigma_s[c] : t * a);
        out->absorption[c] = scale * (has_parts ? sigma_a[c] : t * (1 - a));
    }
    return preset.g;
}

/* Words that say how the same picture is made. */
static void skip_sampling(mitsuba *m, xml_node *node)
{
    rt_mitsuba_flag(m, node, "has_spectral_extinction", 1);
    rt_mitsuba_flag(m, node, "sample_emitters", 1);
}

xml_node *rt_mitsuba_find_medium(mitsuba *m, xml_node *shape)
{
    xml_node *found = NULL;
    for (xml_node *child = shape->first; child; child = child->next) {
        const char *name = rt_xml_attribute(child, "name");
        xml_node *const medium = strcmp(child->tag, "medium") == 0 || strcmp(child->tag, "ref") == 0
                                     ? rt_mitsuba_follow(m, child)
                                     : NULL;
        if (!medium || strcmp(medium->tag, "medium") != 0)
            continue;
        rt_mitsuba_read(m, child, medium);
        if (name && strcmp(name, "interior") == 0)
            found = medium;
        else
            rt_import_note_at(rt_mitsuba_at(m, child), child->line,
                              "a medium outside of a shape is left out");
    }
    return found;
}

void rt_mitsuba_fill(mitsuba *m, xml_node *medium, import_material *out)
{
    static const char *const types[] = {"homogeneous", "heterogeneous", NULL};
    if (!rt_import_takes_medium(rt_mitsuba_at(m, medium), medium->line, out)) {
        rt_mitsuba_leave(medium);
        return;
    }
    rt_mitsuba_note_type(m, medium, types);
    m->medium = m->medium ? m->medium : medium;
    const double g = read_coefficients(m, medium, out);
    out->g = read_phase(m, medium, m->is_old ? rt_mitsuba_number(m, medium, "g", g) : g);
    skip_sampling(m, medium);
}
