/*
 * find_turned.c - meshes of glass that are open, or whose faces are turned inwards or against each
 * other.
 */
#include <math.h>
#include <stdlib.h>

#include "base/vec.h"
#include "scene/check.h"
#include "scene/face.h"
#include "scene/inside.h"
#include "scene/inspection.h"

/* Faces of a mesh that are looked at, and the solid angles that these take. */
enum { TURNED_FACES = 8, ANGLES_MAX = 4000000 };

/* Six times the volume that the faces of a mesh enclose, negative where they have it in front. */
static double signed_volume(const rt_scene *scene, const rt_scene_shape *mesh)
{
    const size_t count = rt_face_count(scene, mesh);
    const rt_face first = rt_face_of(scene, mesh, 0);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const rt_face face = rt_face_of(scene, mesh, i);
        double off[3];
        for (int k = 0; k < 3; k++)
            off[k] = face.centre[k] - first.centre[k];
        sum += face.area > 0 ? 2 * face.area * rt_vec_dot(off, face.normal) : 0;
    }
    return sum;
}

/* Whether a closed mesh has its inside in front of its faces: those that are looked at do. */
static int is_inside_out(const rt_scene *scene, const rt_scene_shape *mesh)
{
    const size_t count = rt_face_count(scene, mesh),
                 step = count > TURNED_FACES ? count / TURNED_FACES : 1;
    int turned = 0;
    if (count > ANGLES_MAX / TURNED_FACES || signed_volume(scene, mesh) >= 0)
        return 0;
    for (size_t i = 0; i < count; i += step) {
        const rt_face face = rt_face_of(scene, mesh, i);
        double p[3];
        if (!(face.area > 0))
            continue;
        for (int k = 0; k < 3; k++)
            p[k] = face.centre[k] + 1e-3 * sqrt(face.area) * face.normal[k];
        if (rt_shape_contains(scene, mesh, p) >= 0)
            return 0;
        turned++;
    }
    return turned > 0;
}

/* ---- Edges ------------------------------------------------------------------- */

/* Triangles of a mesh whose edges are looked at. */
enum { EDGES_MAX = 400000 };

/* A vertex by its place: those of one place are one, whatever their texture coordinates. */
typedef struct place {
    float at[3];
    uint32_t vertex;
} place;

static int compare_places(const void *a, const void *b)
{
    const place *x = a, *y = b;
    for (int i = 0; i < 3; i++)
        if (x->at[i] != y->at[i])
            return x->at[i] < y->at[i] ? -1 : 1;
    return 0;
}

/* An edge of a face, from the lower to the higher of its ends, or back. */
typedef struct edge {
    uint32_t low, high;
    int sense; /* 1 or -1 */
} edge;

static int compare_edges(const void *a, const void *b)
{
    const edge *x = a, *y = b;
    return x->low != y->low ? (x->low > y->low) - (x->low < y->low)
                            : (x->high > y->high) - (x->high < y->high);
}

/* Numbers the vertices by their places; 0 without memory. */
static int number_places(const rt_scene_mesh *mesh, uint32_t *numbers)
{
    place *places = malloc(mesh->vertex_count * sizeof *places);
    uint32_t number = 0;
    if (!places)
        return 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (int c = 0; c < 3; c++) /* + 0 makes -0 0 */
            places[i].at[c] = mesh->positions[3 * i + (size_t)c] + 0.0f;
        places[i].vertex = (uint32_t)i;
    }
    qsort(places, mesh->vertex_count, sizeof *places, compare_places);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        number += i > 0 && compare_places(places + i - 1, places + i) != 0;
        numbers[places[i].vertex] = number;
    }
    free(places);
    return 1;
}

/* The edges of all faces that are no point or line, sorted. */
static size_t list_edges(const rt_scene_mesh *mesh, const uint32_t *numbers, edge *edges)
{
    size_t count = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        uint32_t v[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = numbers[mesh->indices[3 * i + k]];
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
            continue;
        for (int k = 0; k < 3; k++) {
            const uint32_t from = v[k], to = v[(k + 1) % 3];
            edges[count++] = from < to ? (edge){from, to, 1} : (edge){to, from, -1};
        }
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    return count;
}

/*
 * Edges with faces that do not go along them as often forward as back: of an open mesh there is
 * one too few, where two are turned against each other their number is even.
 */
static void count_edges(const edge *edges, size_t count, size_t *open, size_t *turned)
{
    *open = *turned = 0;
    for (size_t i = 0, end; i < count; i = end) {
        int sum = 0;
        for (end = i; end < count && compare_edges(edges + i, edges + end) == 0; end++)
            sum += edges[end].sense;
        if (sum != 0)
            ++*((end - i) % 2 ? open : turned);
    }
}

/* How many edges of a mesh are open, and how many part faces turned against each other. */
static void find_edges(const rt_scene_mesh *mesh, size_t *open, size_t *turned)
{
    uint32_t *numbers = malloc((mesh->vertex_count + 1) * sizeof *numbers);
    edge *edges = malloc((3 * mesh->triangle_count + 1) * sizeof *edges);
    *open = *turned = 0;
    if (numbers && edges && number_places(mesh, numbers))
        count_edges(edges, list_edges(mesh, numbers, edges), open, turned);
    free(numbers);
    free(edges);
}

/* Whether others of its material may close it. */
static int is_alone(const rt_scene *scene, const rt_scene_shape *mesh)
{
    for (size_t i = 0; i < scene->shape_count; i++)
        if (scene->shapes + i != mesh && scene->shapes[i].material == mesh->material)
            return 0;
    return 1;
}

/* Whether light asks which medium is inside: not where the face alone says how it is refracted. */
static int has_medium(const rt_material *m)
{
    return !m->relative_ior || !rt_is_black(m->absorption) || !rt_is_black(m->scattering);
}

/* ---- All ----------------------------------------------------------------------- */

static void find_turned(rt_inspection *in, const rt_scene_shape *shape)
{
    rt_finding turned = rt_finding_of(RT_FINDING_INSIDE_OUT);
    const int is_filled = has_medium(in->scene->materials + shape->material);
    size_t open, against;
    turned.shape = (uint32_t)(shape - in->scene->shapes);
    find_edges(in->scene->meshes + shape->mesh, &open, &against);
    if (against > 0)
        rt_inspection_report(in, turned,
                             "faces of this transparent mesh are turned against each other at %lu "
                             "edges: on which side its inside is differs from face to face",
                             (unsigned long)against);
    else if (open == 0 && is_filled && is_inside_out(in->scene, shape))
        rt_inspection_report(in, turned,
                             "this transparent mesh is inside out: its faces are turned inwards, "
                             "so that its inside is outside of it");
    turned.kind = RT_FINDING_OPEN_GLASS;
    if (open > 0 && is_filled && is_alone(in->scene, shape))
        rt_inspection_report(in, turned,
                             "this transparent mesh is open at %lu edges: light that has crossed "
                             "it there goes on as inside of it",
                             (unsigned long)open);
}

void rt_find_inside_out(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    size_t checked = 0, work = 0;
    for (size_t i = 0; i < scene->shape_count && checked < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->kind != RT_SHAPE_TRIANGLES ||
            !rt_inspection_is_glass(scene->materials + shape->material))
            continue;
        checked++;
        work += rt_face_count(scene, shape);
        if (work <= EDGES_MAX && rt_face_count(scene, shape) > 1)
            find_turned(in, shape);
    }
}
