/* obj_data.c - the vertices and faces of an OBJ file. */
#include "dsl/import/obj_data.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void push(importer *import, obj_array *array, const double *values, int count)
{
    if (array->count + (size_t)count > array->capacity) {
        size_t grown = 2 * array->capacity + 1024;
        float *moved = realloc(array->values, grown * sizeof *moved);
        if (!moved) {
            rt_import_fail_memory(import);
            return;
        }
        array->values = moved;
        array->capacity = grown;
    }
    for (int i = 0; i < count; i++)
        array->values[array->count++] = (float)values[i];
}

/* Why a line is not what it should be. */
typedef struct fault {
    char text[96]; /* empty: it is */
} fault;

/* Up to `width` numbers of a line, `least` at least; returns how many, 0 with a fault. */
static int read_numbers(double *values, char *line, int least, int width, fault *out)
{
    char *word;
    int count = 0;
    out->text[0] = '\0';
    for (; count < width && (word = rt_mtl_next_word(&line)) != NULL; count++) {
        const char *at = word;
        if (!rt_import_number(&values[count], &at) || *at)
            snprintf(out->text, sizeof out->text, "'%.40s' is not a finite number", word);
        else if (fabs(values[count]) > IMPORT_COORDINATE_MAX)
            snprintf(out->text, sizeof out->text, "'%.40s' does not lie within %g", word,
                     IMPORT_COORDINATE_MAX);
        if (out->text[0])
            return 0;
    }
    if (count < least)
        snprintf(out->text, sizeof out->text, "%d numbers, expected %d", count, least);
    return count < least ? 0 : count;
}

/*
 * A texture coordinate or a normal; in place of one that is none, of which the first is told,
 * stands one of zeros.
 */
static void read_vector(importer *import, obj_array *array, int line_number, char *line, int least,
                        int width, int *is_told)
{
    double values[3] = {0, 0, 0};
    fault fault;
    int is_read = read_numbers(values, line, least, width, &fault) != 0;
    if (is_read && width == 3 && !(rt_vector_length(values) > 0)) {
        snprintf(fault.text, sizeof fault.text, "a normal of length 0");
        is_read = 0;
    }
    if (!is_read) {
        if (!*is_told)
            rt_import_note_at(import, line_number, "%s: %s stands in its place", fault.text,
                              width == 3 ? "the normal of the faces there" : "0 0");
        *is_told = 1;
        memset(values, 0, sizeof values);
    }
    push(import, array, values, width);
}

static void push_position(importer *import, obj_data *data, const double values[3])
{
    double low[3] = {0, 0, 0};
    push(import, &data->positions, values, 3);
    for (size_t i = 0; i < 3 && !import->failed; i++)
        low[i] = values[i] - data->positions.values[data->positions.count - 3 + i];
    push(import, &data->low, low, 3);
}

/* Vertices without a colour, up to the first `count` numbers of positions: cut to 1 in the end. */
static void push_white(importer *import, obj_data *data, size_t count)
{
    static const double white[3] = {INFINITY, INFINITY, INFINITY};
    while (!import->failed && data->colours.count < count)
        push(import, &data->colours, white, 3);
}

/* Colours that go to 255. Those of vertices without one are white. */
static void scale_colours(obj_data *data)
{
    for (size_t i = 0; i < data->colours.count; i++) {
        float *const c = data->colours.values + i;
        *c = fminf(data->is_bytes ? *c / 255 : *c, 1);
    }
}

/*
 * The colour of a vertex. One above 1 makes all of them whole numbers to 255; where one is negative
 * it is 0.
 */
static void read_colour(importer *import, obj_data *data, int line_number, double v[3])
{
    for (int c = 0; c < 3; c++) {
        if (v[c] < 0 && !data->is_colour_told) {
            rt_import_note_at(import, line_number, "v: the colour %.9g is negative: it became 0",
                              v[c]);
            data->is_colour_told = 1;
        }
        if (v[c] > 1 + 1e-4 && !data->is_bytes) {
            rt_import_note_at(import, line_number,
                              "v: the colour %.9g is above 1: the colours of all vertices are read "
                              "as numbers to 255",
                              v[c]);
            data->is_bytes = 1;
        }
        v[c] = fmax(v[c], 0);
    }
    push_white(import, data, data->positions.count);
    push(import, &data->colours, v, 3);
}

/*
 * x y z, or x y z r g b as in lib/mesh/obj.c; a single value more is a weight. No more than `width`
 * values are looked at.
 */
static void read_vertex(importer *import, obj_data *data, int line_number, char *line, int width)
{
    double v[7];
    fault fault;
    const int count = read_numbers(v, line, 3, width, &fault);
    if (!count) {
        rt_import_fail(import, line_number, "%s", fault.text);
        return;
    }
    if (count >= 6)
        read_colour(import, data, line_number, v + 3);
    if (count == 5 || count == 7)
        rt_import_note_at(import, line_number,
                          count == 5 ? "the last two of the 5 numbers of a vertex are left out"
                                     : "of the 7 numbers of a vertex the last is left out, and the "
                                       "three before it are its colour");
    push_position(import, data, v);
}

/* A number that is not 0; or 0, which is told. */
static long read_number(importer *import, int line, const char **text, const char *what)
{
    char *end;
    const long number = strtol(*text, &end, 10);
    if (end == *text || number == 0) {
        rt_import_note_at(import, line, "a face is left out: '%.40s' names no %s", *text, what);
        return 0;
    }
    *text = end;
    return number;
}

/* An index from 1, or from the end by a negative one, as one from 0; OBJ_NONE: there is none. */
static uint32_t index_of(long number, size_t count)
{
    const size_t size = number > 0 ? (size_t)number : (size_t) - (number + 1) + 1;
    if (size > count)
        return OBJ_NONE;
    return (uint32_t)(number > 0 ? size - 1 : count - size);
}

/* A texture coordinate or a normal; of those that are not there the first is told. */
static int read_attribute(importer *import, int line, const char **text, const char *what,
                          size_t count, int *is_told, uint32_t *out)
{
    const long number = read_number(import, line, text, what);
    *out = number ? index_of(number, count) : OBJ_NONE;
    if (number && *out == OBJ_NONE && !*is_told) {
        rt_import_note_at(import, line, "%s %ld of %lu so far is left out", what, number,
                          (unsigned long)count);
        *is_told = 1;
    }
    return number != 0;
}

/* v, v/vt, v//vn or v/vt/vn; some write v// and v/vt/ for what has no normal. 0: it is told. */
static int read_corner(importer *import, obj_data *data, int line, const char *word,
                       obj_corner *out)
{
    const char *first = word;
    const size_t count = data->positions.count / 3;
    const long number = read_number(import, line, &word, "vertex");
    if (!number)
        return 0;
    out->uv = out->normal = OBJ_NONE;
    out->position = index_of(number, count);
    if (out->position == OBJ_NONE) {
        rt_import_note_at(import, line, "a face is left out: it names vertex %.40s of %lu so far",
                          first, (unsigned long)count);
        return 0;
    }
    if (*word == '/') {
        word++;
        if (*word && *word != '/' &&
            !read_attribute(import, line, &word, "texture coordinate", data->uv.count / 2,
                            &data->is_uv_told, &out->uv))
            return 0;
    }
    if (*word == '/') {
        word++;
        if (*word && !read_attribute(import, line, &word, "normal", data->normals.count / 3,
                                     &data->is_normal_told, &out->normal))
            return 0;
    }
    if (*word)
        rt_import_note_at(import, line, "a face is left out: '%.40s' has more than indices", first);
    return !*word;
}

static void read_face(importer *import, obj_data *data, int line_number, char *line)
{
    obj_polygon *polygon = &data->polygon;
    char *word;
    polygon->count = 0;
    while (!import->failed && (word = rt_mtl_next_word(&line)) != NULL) {
        if (!rt_obj_polygon_grow(import, polygon) ||
            !read_corner(import, data, line_number, word, polygon->corners + polygon->count))
            return;
        polygon->count++;
    }
    if (polygon->count >= 3 && !import->failed)
        rt_obj_polygon_cut(import, data, line_number);
    else if (!import->failed)
        rt_import_note_at(import, line_number, "a face of fewer than three corners is left out");
}

/* The group of a material's name, a new one where it is new. */
static void use_material(importer *import, obj_data *data, int line_number, const char *name)
{
    const int known = rt_name_table_find(&data->materials, name);
    if (known >= 0) {
        data->group = known;
        return;
    }
    /* The first is of faces without a material. */
    if (data->materials.count == MTL_MATERIALS_MAX + 1) {
        rt_import_fail(import, line_number, "more than %d materials", MTL_MATERIALS_MAX);
        return;
    }
    int *const moved =
        rt_import_grow(import, data->lines, data->materials.count, sizeof *data->lines);
    if (!moved)
        return;
    data->lines = moved;
    data->lines[data->materials.count] = line_number;
    data->group = rt_name_table_add(&data->materials, name);
    if (data->group < 0)
        rt_import_fail_memory(import);
}

/* Whether a library is none of those that were read, where it is put now; or 0 after a failure. */
static int is_new_library(importer *import, mtl_list *list, int line_number, const char *name)
{
    if (rt_name_table_find(&list->libraries, name) >= 0)
        return 0;
    if (list->libraries.count == MTL_LIBRARIES_MAX)
        return rt_import_fail(import, line_number, "more than %d libraries of materials",
                              MTL_LIBRARIES_MAX);
    return rt_name_table_add(&list->libraries, name) >= 0 || rt_import_fail_memory(import);
}

static void read_library(importer *import, mtl_list *list, int line_number, const char *name)
{
    size_t size;
    if (!is_new_library(import, list, line_number, name) ||
        !rt_import_find(import, line_number, name, "the library of materials"))
        return;
    char *text = rt_import_read_text(import, line_number, name, &size);
    if (text)
        rt_mtl_read(import, list, name, text);
    free(text);
}

/* One file, or several where there is none of the whole name. */
static void read_libraries(importer *import, mtl_list *list, int line_number, char *line)
{
    char *rest = rt_mtl_rest(line), *name;
    if (rt_name_table_find(&list->libraries, rest) >= 0)
        return;
    rest = rt_mtl_file(import, rest);
    if (rt_import_has_file(import, rest)) {
        read_library(import, list, line_number, rest);
        return;
    }
    while (!import->failed && (name = rt_mtl_next_library(import, &rest)) != NULL) {
        if (++list->split > MTL_SPLIT_MAX)
            rt_import_fail(import, line_number, "more than %d libraries of materials beside others",
                           MTL_SPLIT_MAX);
        else
            read_library(import, list, line_number, name);
    }
}

/* A group of smoothing by its number; 0 or off: none. */
static void read_smoothing(importer *import, obj_data *data, int line_number, char *line)
{
    const char *const word = rt_mtl_next_word(&line);
    char *end = NULL;
    const long number = word ? strtol(word, &end, 10) : 0;
    const int is_number = word && end != word && !*end && number >= 0;
    data->smoothing = is_number ? (uint32_t)number : word && strcmp(word, "on") == 0;
    if (!is_number && !(word && (strcmp(word, "on") == 0 || strcmp(word, "off") == 0)))
        rt_import_note_at(import, line_number, "'s %.30s' is taken as off", word ? word : "");
}

static void read_line(importer *import, obj_data *data, mtl_list *list, int line_number,
                      const char *word, char *line)
{
    static const char *const silent[] = {"o", "g", "usemap"};
    if (strcmp(word, "v") == 0)
        read_vertex(import, data, line_number, line, list ? 7 : 3);
    else if (strcmp(word, "vt") == 0)
        read_vector(import, &data->uv, line_number, line, 1, 2, &data->is_vt_told);
    else if (strcmp(word, "vn") == 0)
        read_vector(import, &data->normals, line_number, line, 3, 3, &data->is_vn_told);
    else if (strcmp(word, "f") == 0)
        read_face(import, data, line_number, line);
    else if (strcmp(word, "s") == 0)
        read_smoothing(import, data, line_number, line);
    else if (strcmp(word, "usemtl") == 0 && list)
        use_material(import, data, line_number, rt_mtl_rest(line));
    else if (strcmp(word, "mtllib") == 0 && list)
        read_libraries(import, list, line_number, line);
    else if (list || (strcmp(word, "usemtl") != 0 && strcmp(word, "mtllib") != 0)) {
        for (size_t i = 0; i < sizeof silent / sizeof *silent; i++)
            if (strcmp(word, silent[i]) == 0)
                return;
        rt_import_note_at(import, line_number, "'%.30s' is left out", word);
    }
}

/* Lists the triangles group by group, in their order, so that each group finds its own. */
static void sort_groups(importer *import, obj_data *data)
{
    data->order = malloc((data->triangle_count + 1) * sizeof *data->order);
    data->starts = calloc(data->materials.count + 1, sizeof *data->starts);
    size_t *const ends = calloc(data->materials.count + 1, sizeof *ends);
    if (!data->order || !data->starts || !ends) {
        rt_import_fail_memory(import);
        free(ends);
        return;
    }
    for (size_t i = 0; i < data->triangle_count; i++)
        data->starts[data->groups[i] + 1]++;
    for (size_t i = 0; i < data->materials.count; i++) {
        data->starts[i + 1] += data->starts[i];
        ends[i] = data->starts[i];
    }
    for (size_t i = 0; i < data->triangle_count; i++)
        data->order[ends[data->groups[i]]++] = (uint32_t)i;
    free(ends);
}

void rt_import_obj_read(importer *import, obj_data *data, mtl_list *list, char *text)
{
    int line_number = 0;
    char *line;
    use_material(import, data, 1, "");
    while (!import->failed && (line = rt_mtl_next_line(&text, &line_number)) != NULL) {
        char *word = rt_mtl_next_word(&line);
        if (word)
            read_line(import, data, list, line_number, word, line);
    }
    if (data->colours.count)
        push_white(import, data, data->positions.count);
    scale_colours(data);
    if (list && !import->failed)
        rt_obj_fill_normals(import, data);
    if (!import->failed)
        sort_groups(import, data);
}

/* ---- Meshes ------------------------------------------------------------------ */

/*
 * Corners that are alike become one vertex: a hash table of open addressing. The address of the
 * slots goes into the hash, so that a file cannot choose corners that all belong into one slot.
 */
typedef struct corner_table {
    uint32_t *slots; /* vertex plus 1, or 0 */
    size_t mask;
    obj_corner *corners; /* by vertex */
    size_t count;
} corner_table;

static uint32_t find_corner(corner_table *table, const obj_corner *corner)
{
    const uint32_t key[] = {corner->position, corner->uv, corner->normal};
    uint64_t hash = (uint64_t)(uintptr_t)table->slots;
    for (size_t i = 0; i < 3; i++) {
        hash = (hash ^ key[i]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    size_t at = (size_t)hash & table->mask;
    for (; table->slots[at]; at = (at + 1) & table->mask)
        if (memcmp(&table->corners[table->slots[at] - 1], corner, sizeof *corner) == 0)
            return table->slots[at] - 1;
    table->corners[table->count] = *corner;
    table->slots[at] = (uint32_t)++table->count;
    return table->slots[at] - 1;
}

/* Values by vertex, of an array of the file; NULL where a vertex has none. */
static float *gather(const corner_table *table, const obj_array *array, size_t width, size_t member)
{
    float *out = calloc(table->count * width + 1, sizeof *out);
    for (size_t i = 0; out && i < table->count; i++) {
        uint32_t index;
        memcpy(&index, (const char *)&table->corners[i] + member, sizeof index);
        if (index != OBJ_NONE)
            memcpy(out + width * i, array->values + width * index, width * sizeof *out);
    }
    return out;
}

/*
 * Whether the mesh has texture coordinates, which are 0 0 where a corner has none, and normals,
 * which are of use only where every corner has one, as rt_obj_fill_normals sees to.
 */
static void look_at_corners(importer *import, const corner_table *table, int *has_uv,
                            int *has_normals)
{
    size_t uv = 0, normals = 0;
    for (size_t i = 0; i < table->count; i++) {
        uv += table->corners[i].uv != OBJ_NONE;
        normals += table->corners[i].normal != OBJ_NONE;
    }
    *has_uv = uv > 0;
    *has_normals = normals == table->count;
    if (uv > 0 && uv < table->count)
        rt_import_note_at(import, 0, "corners of a mesh without a texture coordinate get 0 0");
    if (normals > 0 && normals < table->count)
        rt_import_note_at(import, 0, "some corners of a mesh have no normal: all are left out");
}

/* Whether a mesh is so far from the origin, beside its size, that rounding may move it. */
static int is_far(const import_mesh *mesh)
{
    double size = 0, distance = 0;
    for (size_t c = 0; c < 3; c++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t i = 0; i < mesh->vertex_count; i++) {
            lo = fmin(lo, mesh->positions[3 * i + c]);
            hi = fmax(hi, mesh->positions[3 * i + c]);
        }
        size = fmax(size, hi - lo);
        distance = fmax(distance, fmax(fabs(lo), fabs(hi)));
    }
    return distance > 4 * size;
}

static int fill(importer *import, import_mesh *out, const obj_data *data, const corner_table *table)
{
    int has_uv, has_normals;
    look_at_corners(import, table, &has_uv, &has_normals);
    out->vertex_count = table->count;
    out->positions = gather(table, &data->positions, 3, offsetof(obj_corner, position));
    out->low = gather(table, &data->low, 3, offsetof(obj_corner, position));
    if (data->colours.count)
        out->colours = gather(table, &data->colours, 3, offsetof(obj_corner, position));
    if (has_uv)
        out->uv = gather(table, &data->uv, 2, offsetof(obj_corner, uv));
    if (has_normals)
        out->normals = gather(table, &data->normals, 3, offsetof(obj_corner, normal));
    const int is_made = out->positions && out->low && (!data->colours.count || out->colours) &&
                        (!has_uv || out->uv) && (!has_normals || out->normals);
    if (is_made && !is_far(out)) {
        free(out->low);
        out->low = NULL;
    }
    return is_made;
}

int rt_import_obj_mesh(importer *import, import_mesh *out, const obj_data *data, int group)
{
    const uint32_t *const own = data->order + data->starts[group];
    const size_t triangles = data->starts[group + 1] - data->starts[group];
    size_t slots = 16;
    memset(out, 0, sizeof *out);
    while (slots < 6 * triangles)
        slots *= 2;
    corner_table table = {calloc(slots, sizeof *table.slots), slots - 1,
                          malloc((3 * triangles + 1) * sizeof *table.corners), 0};
    out->indices = malloc((3 * triangles + 1) * sizeof *out->indices);
    int is_made = table.slots && table.corners && out->indices;
    for (size_t i = 0; is_made && i < 3 * triangles; i++)
        out->indices[i] = find_corner(&table, &data->corners[3 * (size_t)own[i / 3] + i % 3]);
    out->triangle_count = is_made ? triangles : 0;
    is_made = is_made && fill(import, out, data, &table);
    free(table.slots);
    free(table.corners);
    if (is_made)
        return 1;
    rt_import_mesh_free(out);
    return rt_import_fail_memory(import);
}

void rt_obj_push_normal(importer *import, obj_data *data, const double normal[3])
{
    push(import, &data->normals, normal, 3);
}

void rt_import_obj_free(obj_data *data)
{
    rt_name_table_free(&data->materials);
    free(data->lines);
    free(data->positions.values);
    free(data->low.values);
    free(data->colours.values);
    free(data->uv.values);
    free(data->normals.values);
    rt_obj_polygon_free(&data->polygon);
    free(data->corners);
    free(data->groups);
    free(data->smooth);
    free(data->order);
    free(data->starts);
}
