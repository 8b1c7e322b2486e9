/*
 * pbrt_medium.c - participating media of pbrt: what a name means, what fills a shape, and what the
 * camera is in, which fills all space outside of shapes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "dsl/import/pbrt.h"

enum { COUNT_MAX = 1 << 15 };

/* ---- Grids ------------------------------------------------------------------- */

/* The counts of the voxels that so many numbers are; 0: they are not. */
static int find_counts(pbrt_params *params, size_t numbers, uint32_t counts[3])
{
    static const char *const names[] = {"nx", "ny", "nz"};
    double voxels = 1;
    for (int i = 0; i < 3; i++) {
        const double count = rt_pbrt_number(params, names[i], 1);
        if (!(count >= 1 && count <= COUNT_MAX) || count != floor(count))
            return 0;
        counts[i] = (uint32_t)count;
        voxels *= count;
    }
    return voxels == (double)numbers;
}

/* The frame of a medium, in the world. */
static matrix frame_of(const pbrt *p)
{
    return rt_matrix_multiply(&p->mirror, &p->state.ctm);
}

/* Where a grid lies: from p0 to p1 in the frame of the medium. */
static matrix place_grid(pbrt *p, pbrt_params *params)
{
    double from[3] = {0, 0, 0}, to[3] = {1, 1, 1};
    rt_pbrt_point(params, "p0", from);
    rt_pbrt_point(params, "p1", to);
    const matrix move = rt_matrix_translate(from[0], from[1], from[2]),
                 size = rt_matrix_scale(to[0] - from[0], to[1] - from[1], to[2] - from[2]),
                 inside = rt_matrix_multiply(&move, &size), to_world = frame_of(p);
    return rt_matrix_multiply(&to_world, &inside);
}

/* Writes numbers as a grid of so many channels; returns its handle, or IMPORT_NONE. */
static int write_grid(pbrt *p, pbrt_params *params, const double *numbers, size_t count,
                      size_t channels)
{
    char file[512];
    uint32_t counts[3];
    int is_below = 0;
    if (!find_counts(params, count / channels, counts) || count % channels != 0) {
        rt_import_note_at(p->import, params->line,
                          "the grid of a medium is left out: nx, ny and nz are not its numbers");
        return IMPORT_NONE;
    }
    float *const voxels = malloc(count * sizeof *voxels);
    if (!voxels) {
        rt_import_fail_memory(p->import);
        return IMPORT_NONE;
    }
    for (size_t i = 0; i < count; i++) {
        is_below |= numbers[i] < 0;
        voxels[i] = (float)fmin(fmax(numbers[i], 0), 1e28);
    }
    if (is_below)
        rt_import_note_at(p->import, params->line, "the negative values of a grid became 0");
    const matrix to_world = place_grid(p, params);
    const int is_written = rt_import_write_grid(p->import, file, counts, channels, voxels);
    free(voxels);
    return is_written ? rt_import_add_grid(p->import, "grid", file, NULL, &to_world, 0)
                      : IMPORT_NONE;
}

/* The grids of both coefficients as those of their sum, and of the part of it that scatters. */
static void read_colour_grids(pbrt *p, pbrt_params *params, double scale, pbrt_medium *out)
{
    const pbrt_param *const a = rt_pbrt_find(params, "rgb", "sigma_a"), *const s = rt_pbrt_find(
                                                                            params, "rgb",
                                                                            "sigma_s");
    const size_t count = a ? a->number_count : s ? s->number_count : 0;
    double *const sums = malloc((2 * count + 1) * sizeof *sums), *const parts = sums + count;
    if (!sums)
        rt_import_fail_memory(p->import);
    if (!sums || count == 0 || (a && s && a->number_count != s->number_count)) {
        rt_import_note_at(p->import, params->line,
                          "the grids of a medium are left out: they are none, or unlike");
        free(sums);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const double absorbed = a ? a->numbers[i] : 1, scattered = s ? s->numbers[i] : 1;
        sums[i] = absorbed + scattered;
        parts[i] = sums[i] > 0 ? scattered / sums[i] : 0;
    }
    out->density = write_grid(p, params, sums, count, 3);
    out->albedo = write_grid(p, params, parts, count, 3);
    for (int c = 0; c < 3; c++) {
        out->absorption[c] = 0;
        out->scattering[c] = scale;
    }
    free(sums);
}

/* Whether the grid of a file can be read; where it cannot, tells why. */
static int check_nano(pbrt *p, int line, const char *name, const char *layer)
{
    rt_error error;
    rt_scene *scene = NULL;
    char *const path = rt_import_resolve(p->import, line, name);
    const rt_grid grid = {.path = path, .layer = layer};
    rt_status status = path ? rt_scene_create(&scene, &error) : RT_ERROR_INPUT;
    if (status == RT_OK) {
        rt_scene_set_vdb_module(scene, p->import->vdb_module);
        status = rt_scene_add_grid(scene, NULL, &grid, &error);
    }
    if (path && status != RT_OK)
        rt_import_note_at(p->import, line, "the medium '%.80s' is left out: %.300s", name,
                          error.message);
    rt_scene_destroy(scene);
    free(path);
    return status == RT_OK;
}

/* The grid of a file of NanoVDB, copied beside the scene; IMPORT_NONE: it is left out. */
static int copy_nano(pbrt *p, pbrt_params *params)
{
    char file[512];
    size_t size;
    const char *const name = rt_pbrt_string(params, "filename", "");
    const char *const end = strrchr(name, '.');
    const char *const layer = rt_pbrt_string(params, "gridname", "density");
    const matrix to_world = frame_of(p);
    if (!name[0])
        rt_import_note_at(p->import, params->line,
                          "a medium 'nanovdb' without a filename is left out");
    if (strpbrk(layer, "\"\\\n"))
        rt_import_note_at(
            p->import, params->line,
            "a medium whose gridname has quotes, backslashes or line ends is left out");
    if (!name[0] || strpbrk(layer, "\"\\\n") ||
        !rt_import_find(p->import, params->line, name, "the medium") ||
        !check_nano(p, params->line, name, layer))
        return IMPORT_NONE;
    char *const bytes = rt_import_read(p->import, params->line, name, &size);
    const int is_written =
        bytes &&
        rt_import_write(p->import, file, "grid",
                        end && strcasecmp(end, ".vdb") == 0 ? ".vdb" : ".nvdb", bytes, size);
    if (is_written)
        rt_import_keep_copy(p->import, file);
    free(bytes);
    return is_written ? rt_import_add_grid(p->import, "grid", file, layer, &to_world, 0)
                      : IMPORT_NONE;
}

/* ---- Media by name ----------------------------------------------------------- */

/* The factor of the coefficients of a medium, which is not negative. */
static double read_scale(pbrt *p, pbrt_params *params)
{
    const double scale = rt_pbrt_number(params, "scale", 1);
    if (scale < 0)
        rt_import_note_at(p->import, params->line, "a scale of %g is taken as 0", scale);
    return fmax(scale, 0);
}

static void note_emission(pbrt *p, pbrt_params *params)
{
    double emitted[3];
    if (rt_pbrt_colour(params, "Le", emitted) || rt_pbrt_find(params, "float", "temperature"))
        rt_import_note_at(p->import, params->line, "the light that a medium emits is left out");
    rt_pbrt_number(params, "Lescale", 1);
}

void rt_pbrt_preset(pbrt *p, pbrt_params *params, const char *name, double absorption[3],
                    double scattering[3])
{
    const char *const preset = rt_pbrt_string(params, name, "");
    import_preset found;
    if (preset[0] && !rt_import_preset(preset, &found))
        rt_import_note_at(p->import, params->line,
                          "there is no medium '%.40s' of pbrt's: whole milk stands in its place",
                          preset);
    if (!preset[0] || !rt_import_preset(preset, &found))
        rt_import_preset("Wholemilk", &found);
    memcpy(absorption, found.absorption, sizeof found.absorption);
    memcpy(scattering, found.reduced, sizeof found.reduced);
}

/* The coefficients of a medium, per metre. */
static void read_coefficients(pbrt *p, pbrt_params *params, int is_even, pbrt_medium *out)
{
    const double scale = read_scale(p, params), g = rt_pbrt_number(params, "g", 0);
    double a[3] = {1, 1, 1}, s[3] = {1, 1, 1};
    if (is_even)
        rt_pbrt_preset(p, params, "preset", a, s);
    rt_pbrt_colour(params, "sigma_a", a);
    rt_pbrt_colour(params, "sigma_s", s);
    for (int c = 0; c < 3; c++) {
        out->absorption[c] = fmax(a[c], 0) * scale;
        out->scattering[c] = fmax(s[c], 0) * scale;
    }
    if (fmin(fmin(a[0], fmin(a[1], a[2])), fmin(s[0], fmin(s[1], s[2]))) < 0)
        rt_import_note_at(p->import, params->line, "negative coefficients of a medium became 0");
    out->g = fmin(fmax(g, -0.99), 0.99);
    if (out->g != g)
        rt_import_note_at(p->import, params->line, "a g of %g is taken as %g", g, out->g);
    note_emission(p, params);
}

static void read_medium(pbrt *p, pbrt_params *params, const char *type, pbrt_medium *out)
{
    const int is_rgb = strcmp(type, "rgbgrid") == 0,
              is_grid = strcmp(type, "uniformgrid") == 0 || strcmp(type, "heterogeneous") == 0;
    if (is_rgb) {
        const double scale = read_scale(p, params);
        out->g = fmin(fmax(rt_pbrt_number(params, "g", 0), -0.99), 0.99);
        note_emission(p, params);
        read_colour_grids(p, params, scale, out);
    } else if (is_grid || strcmp(type, "homogeneous") == 0) {
        read_coefficients(p, params, !is_grid, out);
        const pbrt_param *const density = is_grid ? rt_pbrt_find(params, "float", "density") : NULL;
        if (is_grid && !density)
            rt_import_note_at(p->import, params->line,
                              "a grid of a medium without \"float density\" is even");
        if (density)
            out->density = write_grid(p, params, density->numbers, density->number_count, 1);
    } else if (strcmp(type, "nanovdb") == 0) {
        read_coefficients(p, params, 0, out);
        out->density = copy_nano(p, params);
        out->is_left_out = out->density == IMPORT_NONE;
    } else {
        rt_import_note_at(p->import, params->line, "a medium '%.40s' is left out", type);
        out->is_left_out = 1;
    }
}

void rt_pbrt_make_medium(pbrt *p, pbrt_params *params, const char *name)
{
    size_t at;
    const size_t before = p->medium_names.count;
    pbrt_medium medium = {.density = IMPORT_NONE, .albedo = IMPORT_NONE};
    const char *const type = rt_pbrt_string(params, "type", "");
    read_medium(p, params, type, &medium);
    if (!medium.is_left_out)
        rt_pbrt_note_unused(params, type);
    pbrt_medium *const moved =
        rt_pbrt_define(p->import, &p->medium_names, name, p->media, sizeof *p->media, &at);
    if (!moved)
        return;
    p->media = moved;
    if (at == before)
        p->media[at] = medium;
    else
        rt_import_note_at(p->import, params->line, "a second medium '%.40s' is left out", name);
}

/* ---- What they fill ---------------------------------------------------------- */

/* 1 + the index of a medium by its name, or 0. */
static size_t find_medium(pbrt *p, const char *name)
{
    const int at = name[0] ? rt_name_table_find(&p->medium_names, name) : -1;
    if (at < 0 && name[0])
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "there is no medium '%.40s': it is left out", name);
    return at >= 0 && !p->media[at].is_left_out ? (size_t)at + 1 : 0;
}

void rt_pbrt_read_interface(pbrt *p)
{
    char inside[PBRT_TEXT], outside[PBRT_TEXT];
    if (!rt_pbrt_take_string(p, "MediumInterface", inside))
        return;
    memcpy(outside, inside, sizeof outside);
    if (rt_pbrt_peek(&p->tokens)->kind == PBRT_STRING &&
        !rt_pbrt_take_string(p, "MediumInterface", outside))
        return;
    p->state.inside = find_medium(p, inside);
    p->state.outside = find_medium(p, outside);
}

static void put_inside(import_material *out, const pbrt_medium *medium)
{
    memcpy(out->absorption, medium->absorption, sizeof out->absorption);
    memcpy(out->scattering, medium->scattering, sizeof out->scattering);
    out->g = medium->g;
    out->density = medium->density;
    out->albedo = medium->albedo;
}

void rt_pbrt_fill(pbrt *p, int line, size_t index, import_material *out)
{
    pbrt_medium *const medium = &p->media[index - 1];
    medium->is_inside = 1;
    if (rt_import_takes_medium(p->import, line, out))
        put_inside(out, medium);
}

void rt_pbrt_fill_space(pbrt *p)
{
    const pbrt_medium *const medium = p->camera_medium ? &p->media[p->camera_medium - 1] : NULL;
    import_material space = rt_import_material_begin();
    if (!medium || medium->is_inside) /* the camera is in a shape then */
        return;
    put_inside(&space, medium);
    rt_import_add_medium(p->import, 0, &space);
}
