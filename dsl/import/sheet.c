/* sheet.c - glass of meshes that do not close. */
#include "dsl/import/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the area of what is joined, by how much it faces more to one side: holes in solids, sheets. */
static const double most_closed = 0.02, least_sheet = 0.7;

/* A corner of a triangle, and where it is. */
typedef struct corner {
    float at[3];
    uint32_t index;
} corner;

/* What faces of one piece sum up to. */
typedef struct piece {
    double normal[3], area;
} piece;

static int compare_corners(const void *a, const void *b)
{
    const corner *const p = a, *const q = b;
    for (int c = 0; c < 3; c++)
        if (p->at[c] != q->at[c])
            return p->at[c] < q->at[c] ? -1 : 1;
    return 0;
}

/* The triangle that stands for the piece of one, to which those on the way are moved up. */
static uint32_t find_root(uint32_t *joined, uint32_t triangle)
{
    while (joined[triangle] != triangle) {
        joined[triangle] = joined[joined[triangle]];
        triangle = joined[triangle];
    }
    return triangle;
}

/* Joins the triangles whose corners are at one place. */
static void join(corner *corners, const float *positions, const uint32_t *indices, size_t count,
                 uint32_t *joined)
{
    for (size_t i = 0; i < 3 * count; i++) {
        memcpy(corners[i].at, positions + 3 * (size_t)indices[i], sizeof corners[i].at);
        corners[i].index = (uint32_t)i;
    }
    qsort(corners, 3 * count, sizeof *corners, compare_corners);
    for (size_t i = 0; i < count; i++)
        joined[i] = (uint32_t)i;
    for (size_t i = 1; i < 3 * count; i++)
        if (compare_corners(corners + i - 1, corners + i) == 0)
            joined[find_root(joined, corners[i].index / 3)] =
                find_root(joined, corners[i - 1].index / 3);
}

static void add_face(piece *to, const float *positions, const uint32_t *triangle)
{
    double corners[9], normal[3];
    for (size_t k = 0; k < 9; k++)
        corners[k] = positions[3 * (size_t)triangle[k / 3] + k % 3];
    rt_vector_normal(normal, corners);
    for (int c = 0; c < 3; c++)
        to->normal[c] += normal[c];
    to->area += rt_vector_length(normal);
}

int rt_import_find_sheets(importer *import, const float *positions, const uint32_t *indices,
                          size_t triangle_count, unsigned char *out)
{
    corner *const corners = malloc((3 * triangle_count + 1) * sizeof *corners);
    uint32_t *const joined = malloc((triangle_count + 1) * sizeof *joined);
    piece *const pieces = calloc(triangle_count + 1, sizeof *pieces);
    const int is_good = corners && joined && pieces && triangle_count <= UINT32_MAX / 3;
    if (is_good) {
        join(corners, positions, indices, triangle_count, joined);
        for (size_t i = 0; i < triangle_count; i++)
            add_face(&pieces[find_root(joined, (uint32_t)i)], positions, indices + 3 * i);
        for (size_t i = 0; i < triangle_count; i++) {
            const piece *const whole = &pieces[find_root(joined, (uint32_t)i)];
            const double side = rt_vector_length(whole->normal);
            out[i] = (unsigned char)(side > least_sheet * whole->area   ? IMPORT_PIECE_SHEET
                                     : side > most_closed * whole->area ? IMPORT_PIECE_OPEN
                                                                        : IMPORT_PIECE_CLOSED);
        }
    }
    free(corners);
    free(joined);
    free(pieces);
    return is_good || rt_import_fail_memory(import);
}

size_t rt_import_part_sheets(importer *import, import_mesh *mesh, const unsigned char *pieces)
{
    const size_t count = mesh->triangle_count;
    uint32_t *const ordered = malloc((3 * count + 1) * sizeof *ordered);
    size_t solids = 0, next;
    int is_open = 0;
    if (!ordered) {
        rt_import_fail_memory(import);
        return count;
    }
    for (size_t i = 0; i < count; i++) {
        solids += pieces[i] != IMPORT_PIECE_SHEET;
        is_open |= pieces[i] == IMPORT_PIECE_OPEN;
    }
    next = solids;
    for (size_t i = 0, solid = 0; i < count; i++)
        memcpy(ordered + 3 * (pieces[i] == IMPORT_PIECE_SHEET ? next++ : solid++),
               mesh->indices + 3 * i, 3 * sizeof *ordered);
    free(mesh->indices);
    mesh->indices = ordered;
    if (is_open)
        rt_import_note_at(import, 0,
                          "a mesh of glass does not close: what is seen through one side of it "
                          "alone is too bright or too dark, by the square of its index");
    return solids;
}

/* What is glass by itself. */
static void make_thin(import_material *m)
{
    if (m->is_principled) {
        for (int c = 0; c < 3; c++)
            m->base_color[c] = sqrt(m->base_color[c]); /* of one face, which has that */
    } else {
        double through = 0, whole = 0;
        for (int c = 0; c < 3; c++) {
            m->base_color[c] = m->kd[c] + m->kt[c];
            through += m->kt[c];
            whole += m->base_color[c];
        }
        m->base_color_texture = m->kt_texture;
        m->spec_trans = whole > 0 ? through / whole : 1;
        m->roughness = sqrt(m->roughness);
        m->roughness_v = 0;
    }
    memset(m->kd, 0, sizeof m->kd);
    memset(m->ks, 0, sizeof m->ks);
    memset(m->kt, 0, sizeof m->kt);
    memset(m->absorption, 0, sizeof m->absorption);
    memset(m->scattering, 0, sizeof m->scattering);
    m->kd_texture = m->ks_texture = m->kt_texture = IMPORT_NONE;
    m->metallic = m->clearcoat = m->clearcoat_gloss = m->coat = m->abbe = 0;
    m->metallic_texture = m->clearcoat_texture = m->clearcoat_gloss_texture = IMPORT_NONE;
    m->coat_texture = m->coat_roughness_texture = m->coat_absorption_texture = IMPORT_NONE;
    m->fresnel = IMPORT_FRESNEL_OFF;
    m->is_principled = m->is_thin = 1;
}

/* What is glass in part: a blend of what is none, whose colour counts once, with glass. */
static void part_glass(importer *import, int line, import_material *m)
{
    import_part parts[2] = {{.base = "opaque", .material = *m}, {.base = "sheet", .material = *m}};
    const import_material whole = *m;
    for (int i = 0; i < 2; i++) {
        import_material *const part = &parts[i].material;
        memset(part->emission, 0, sizeof part->emission);
        part->emission_texture = IMPORT_NONE;
        part->spec_trans = i;
    }
    make_thin(&parts[1].material);
    rt_import_blend(import, line, m, parts, whole.spec_trans, IMPORT_NONE);
    memcpy(m->emission, whole.emission, sizeof m->emission);
    m->emission_texture = whole.emission_texture;
    m->is_two_sided = whole.is_two_sided;
}

void rt_import_make_sheet(importer *import, int line, const char *name, import_material *m)
{
    if (m->is_principled && m->spec_trans < 1)
        part_glass(import, line, m);
    else
        make_thin(m);
    rt_import_note_at(
        import, line,
        "%s%.60s%swhere its mesh has one side it became a thin sheet, "
        "through which light goes straight: give it a thickness for glass that bends it",
        name ? "material " : "", name ? name : "", name ? ": " : "");
}
