/*
 * pbrt.c - scenes of pbrt-v4. Its world is left-handed as the camera sees it, unless a Scale -1 1 1
 * before LookAt mirrors it; where there is none, the new scene is mirrored in x.
 */
#include "dsl/import/pbrt.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Arguments of directives ------------------------------------------------- */

int rt_pbrt_take_string(pbrt *p, const char *directive, char out[PBRT_TEXT])
{
    pbrt_token token = rt_pbrt_take(&p->tokens);
    if (token.kind != PBRT_STRING)
        return rt_import_fail(p->import, token.line, "%s takes a string", directive);
    memcpy(out, token.text, PBRT_TEXT);
    return 1;
}

/* `count` numbers, in brackets or not. */
static int take_numbers(pbrt *p, const char *directive, double *out, int count)
{
    const int is_open = rt_pbrt_peek(&p->tokens)->kind == PBRT_OPEN,
              line = rt_pbrt_line(&p->tokens);
    if (is_open)
        rt_pbrt_take(&p->tokens);
    for (int i = 0; i < count; i++) {
        pbrt_token token = rt_pbrt_take(&p->tokens);
        if (token.kind != PBRT_NUMBER)
            return rt_import_fail(p->import, line, "%s takes %d numbers", directive, count);
        out[i] = token.number;
    }
    if (is_open && rt_pbrt_take(&p->tokens).kind != PBRT_CLOSE)
        return rt_import_fail(p->import, line, "%s takes %d numbers in brackets", directive, count);
    return 1;
}

/* ---- Transforms -------------------------------------------------------------- */

static matrix rotation(pbrt *p, const double v[4])
{
    if (v[0] != 0 && v[1] == 0 && v[2] == 0 && v[3] == 0)
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "a rotation about no axis turns nothing");
    return rt_matrix_rotate(v[0], v + 1);
}

/* From the world to the camera; leaves *out where it is none. */
static void look_at(pbrt *p, const double v[9], matrix *out)
{
    double direction[3] = {v[3] - v[0], v[4] - v[1], v[5] - v[2]}, up[3] = {v[6], v[7], v[8]},
           right[3];
    matrix camera = rt_matrix_identity();
    const int has_direction = rt_vector_normalize(direction) && rt_vector_normalize(up);
    rt_vector_cross(right, up, direction);
    if (!has_direction || !rt_vector_normalize(right)) {
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "LookAt is left out: it has no direction, or its up is along it");
        return;
    }
    rt_vector_cross(up, direction, right);
    for (int c = 0; c < 3; c++) {
        camera.m[c][0] = right[c];
        camera.m[c][1] = up[c];
        camera.m[c][2] = direction[c];
        camera.m[c][3] = v[c];
    }
    rt_matrix_invert(out, &camera);
}

/* Reads a transform; returns whether the word is one. */
static int read_transform(pbrt *p, const char *word)
{
    static const struct {
        const char *word;
        int count;
    } transforms[] = {{"Translate", 3}, {"Scale", 3},      {"Rotate", 4},
                      {"LookAt", 9},    {"Transform", 16}, {"ConcatTransform", 16}};
    double v[16];
    size_t i = 0;
    matrix step = rt_matrix_identity();
    while (i < 6 && strcmp(transforms[i].word, word) != 0)
        i++;
    if (i == 6)
        return 0;
    if (!take_numbers(p, word, v, transforms[i].count))
        return 1;
    if (i == 0)
        step = rt_matrix_translate(v[0], v[1], v[2]);
    else if (i == 1)
        step = rt_matrix_scale(v[0], v[1], v[2]);
    else if (i == 2)
        step = rotation(p, v);
    else if (i == 3)
        look_at(p, v, &step);
    else
        step = rt_matrix_from_columns(v);
    p->state.ctm = i == 4 ? step : rt_matrix_multiply(&p->state.ctm, &step);
    if (!rt_matrix_is_finite(&p->state.ctm))
        rt_import_fail(p->import, rt_pbrt_line(&p->tokens), "a transform is not finite");
    return 1;
}

void rt_pbrt_keep_frame(pbrt *p, const char *name, const matrix *frame)
{
    size_t at;
    matrix *moved =
        rt_pbrt_define(p->import, &p->frame_names, name, p->frames, sizeof *p->frames, &at);
    if (!moved)
        return;
    p->frames = moved;
    p->frames[at] = *frame;
}

static void use_frame(pbrt *p, const char *name)
{
    const int at = rt_name_table_find(&p->frame_names, name);
    if (at < 0)
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "there is no coordinate system '%.60s': CoordSysTransform is left out",
                          name);
    else
        p->state.ctm = p->frames[at];
}

/* ---- The world --------------------------------------------------------------- */

static void push(pbrt *p)
{
    if (p->saved_count == IMPORT_DEPTH_MAX) {
        rt_import_fail(p->import, rt_pbrt_line(&p->tokens), "attributes are nested deeper than %d",
                       IMPORT_DEPTH_MAX);
        return;
    }
    p->saved[p->saved_count] = p->state;
    p->saved[p->saved_count++].opened = rt_pbrt_here(&p->tokens);
}

static void pop(pbrt *p)
{
    if (p->saved_count == 0)
        rt_import_fail(p->import, rt_pbrt_line(&p->tokens), "this end has no beginning");
    else
        p->state = p->saved[--p->saved_count];
}

static void begin_object(pbrt *p)
{
    char name[PBRT_TEXT];
    rt_pbrt_flush_curves(p);
    push(p);
    if (!rt_pbrt_take_string(p, "ObjectBegin", name))
        return;
    if (p->in_object)
        rt_import_fail(p->import, rt_pbrt_line(&p->tokens), "an object inside of an object");
    size_t at;
    const size_t before = p->object_names.count;
    pbrt_object *moved =
        rt_pbrt_define(p->import, &p->object_names, name, p->objects, sizeof *p->objects, &at);
    if (!moved)
        return;
    p->objects = moved;
    p->object = at == before ? (int)at : IMPORT_NONE;
    if (at != before)
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "a second object '%.60s' is left out", name);
    p->in_object = 1;
}

static void use_named_material(pbrt *p)
{
    char name[PBRT_TEXT];
    if (!rt_pbrt_take_string(p, "NamedMaterial", name))
        return;
    const int at = rt_name_table_find(&p->material_names, name);
    if (at < 0)
        rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                          "there is no material '%.60s': the one before goes on", name);
    else
        p->state.material = p->latest[at];
}

/* From now on the name is that of this material. */
static void make_named_material(pbrt *p, pbrt_params *params, const char *name)
{
    const char *const type = rt_pbrt_string(params, "type", NULL);
    if (!type)
        rt_import_note_at(p->import, params->line,
                          "a named material without a type became diffuse");
    rt_pbrt_make_material(p, params, name, type ? type : "diffuse");
}

/* What takes a kind, or a name, and parameters. Returns whether the word is one. */
static int read_thing(pbrt *p, const char *word)
{
    static const char *const words[] = {"Shape",          "LightSource",       "AreaLightSource",
                                        "Material",       "MakeNamedMaterial", "Texture",
                                        "MakeNamedMedium"};
    static const import_concern concerns[] = {IMPORT_SHAPE,    IMPORT_PICTURE,  IMPORT_PICTURE,
                                              IMPORT_MATERIAL, IMPORT_MATERIAL, IMPORT_TEXTURE,
                                              IMPORT_MATERIAL};
    pbrt_params params;
    char name[PBRT_TEXT], type[PBRT_TEXT] = "", kind[PBRT_TEXT] = "";
    size_t i = 0;
    while (i < 7 && strcmp(words[i], word) != 0)
        i++;
    if (i == 7)
        return 0;
    if (!rt_pbrt_take_string(p, word, name))
        return 1;
    if (i == 5 && (!rt_pbrt_take_string(p, word, type) || !rt_pbrt_take_string(p, word, kind)))
        return 1;
    p->import->place.concern = concerns[i];
    rt_pbrt_read_params(&params, &p->tokens);
    rt_pbrt_add_attributes(p, &params, word);
    if (p->import->failed)
        i = 7;
    if (i == 0)
        rt_pbrt_shape(p, &params, name);
    else if (i == 1)
        rt_pbrt_light(p, &params, name);
    else if (i == 2)
        rt_pbrt_area_light(p, &params, name);
    else if (i == 3)
        p->state.material = rt_pbrt_make_material(p, &params, "", name);
    else if (i == 4)
        make_named_material(p, &params, name);
    else if (i == 5)
        rt_pbrt_make_texture(p, &params, name, type, kind);
    else if (i == 6)
        rt_pbrt_make_medium(p, &params, name);
    p->import->place.concern = IMPORT_PICTURE;
    rt_pbrt_free_params(&params);
    return 1;
}

static int read_state(pbrt *p, const char *word)
{
    char name[PBRT_TEXT];
    if (strcmp(word, "AttributeBegin") == 0 || strcmp(word, "TransformBegin") == 0) {
        push(p);
    } else if (strcmp(word, "AttributeEnd") == 0 || strcmp(word, "TransformEnd") == 0) {
        pop(p);
    } else if (strcmp(word, "Attribute") == 0) {
        rt_pbrt_read_attribute(p);
    } else if (strcmp(word, "Identity") == 0) {
        p->state.ctm = rt_matrix_identity();
    } else if (strcmp(word, "ReverseOrientation") == 0) {
        p->state.is_reversed = !p->state.is_reversed;
    } else if (strcmp(word, "CoordinateSystem") == 0) {
        if (rt_pbrt_take_string(p, word, name))
            rt_pbrt_keep_frame(p, name, &p->state.ctm);
    } else if (strcmp(word, "CoordSysTransform") == 0) {
        if (rt_pbrt_take_string(p, word, name))
            use_frame(p, name);
    } else if (strcmp(word, "NamedMaterial") == 0) {
        use_named_material(p);
    } else if (strcmp(word, "MediumInterface") == 0) {
        rt_pbrt_read_interface(p);
    } else if (strcmp(word, "ObjectBegin") == 0) {
        begin_object(p);
    } else if (strcmp(word, "ObjectEnd") == 0) {
        rt_pbrt_flush_curves(p);
        p->in_object = 0;
        pop(p);
    } else if (strcmp(word, "ObjectInstance") == 0) {
        if (rt_pbrt_take_string(p, word, name))
            rt_pbrt_instance(p, name);
    } else {
        return 0;
    }
    return 1;
}

/* Leaves out a directive, known or not, with all that stands behind it up to the next. */
static void skip_directive(pbrt *p, const char *word)
{
    const int is_time = strcmp(word, "ActiveTransform") == 0;
    rt_import_note_at(p->import, rt_pbrt_line(&p->tokens),
                      is_time || strcmp(word, "TransformTimes") == 0
                          ? "%.40s is left out"
                          : "the unknown directive '%.40s' is left out",
                      word);
    const pbrt_token *next = rt_pbrt_peek(&p->tokens);
    while (next->kind != PBRT_END &&
           (next->kind != PBRT_WORD || rt_pbrt_is_among(next->text, "true false"))) {
        rt_pbrt_take(&p->tokens);
        next = rt_pbrt_peek(&p->tokens);
    }
    if (is_time)
        rt_pbrt_take(&p->tokens);
}

/* pbrt takes settings before WorldBegin alone, and shapes and lights behind it; told once. */
static void note_place(pbrt *p, const pbrt_token *token)
{
    static const char *const words[] = {"Camera",     "Film",  "PixelFilter", "Sampler",
                                        "Integrator", "Shape", "LightSource", "AreaLightSource"};
    size_t i = 0;
    while (i < 8 && strcmp(words[i], token->text) != 0)
        i++;
    if (i == 8 || (i < 5) != p->is_in_world || p->is_misplaced)
        return;
    p->is_misplaced = 1;
    rt_import_note_at(p->import, token->line, "%s stands %s WorldBegin, where pbrt refuses it",
                      token->text, p->is_in_world ? "behind" : "before");
}

static void read_directive(pbrt *p, const pbrt_token *token)
{
    char name[PBRT_TEXT];
    const char *word = token->text;
    note_place(p, token);
    if (token->kind != PBRT_WORD) {
        rt_import_fail(p->import, token->line, "a directive is expected, as Shape");
    } else if (strcmp(word, "WorldBegin") == 0) {
        if (p->is_in_world)
            rt_import_note_at(p->import, token->line,
                              "a second WorldBegin: the transform begins anew");
        p->state.ctm = rt_matrix_identity();
        p->is_in_world = 1;
        rt_pbrt_keep_frame(p, "world", &p->state.ctm);
    } else if (strcmp(word, "Include") == 0 || strcmp(word, "Import") == 0) {
        if (rt_pbrt_take_string(p, word, name))
            rt_pbrt_include(&p->tokens, name);
    } else if (strcmp(word, "WorldEnd") != 0 && !read_transform(p, word) && !read_state(p, word) &&
               !rt_pbrt_setting(p, word) && !read_thing(p, word)) {
        skip_directive(p, word);
    }
}

static void close(pbrt *p)
{
    for (size_t i = 0; i < p->object_names.count; i++) {
        for (size_t k = 0; k < p->objects[i].count; k++)
            free(p->objects[i].items[k].block);
        free(p->objects[i].items);
    }
    name_table *const tables[] = {&p->texture_names, &p->material_names, &p->object_names,
                                  &p->frame_names, &p->medium_names};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        rt_name_table_free(tables[i]);
    free(p->objects);
    free(p->textures);
    free(p->images);
    free(p->materials);
    free(p->latest);
    free(p->frames);
    free(p->media);
    rt_pbrt_free_attributes(p);
    rt_pbrt_free_tokens(&p->tokens);
    free(p);
}

void rt_import_pbrt(importer *import, const char *text, size_t size)
{
    pbrt *p = calloc(1, sizeof *p);
    pbrt_params none = {.import = import};
    if (!p) {
        rt_import_fail_memory(import);
        return;
    }
    p->import = p->tokens.import = import;
    import->is_relative = 1;
    p->tokens.sources[p->tokens.depth++] = (pbrt_source){NULL, NULL, text, text + size, 1};
    p->state.ctm = p->mirror = rt_matrix_identity();
    p->width = 1280;
    p->height = 720;
    p->crop[1] = 1280;
    p->crop[3] = 720;
    p->shutter = p->gain = 1;
    p->max_depth = 6;
    p->samples = 16;
    p->state.material = rt_pbrt_make_material(p, &none, "", "diffuse");
    while (!import->failed) {
        pbrt_token token = rt_pbrt_take(&p->tokens);
        if (token.kind == PBRT_END)
            break;
        read_directive(p, &token);
    }
    if (!import->failed && p->saved_count > 0)
        rt_import_fail(import, rt_pbrt_at(import, p->saved[p->saved_count - 1].opened),
                       "what begins here is not closed");
    rt_pbrt_flush_curves(p);
    rt_pbrt_note_attributes(p);
    if (!import->failed)
        rt_pbrt_fill_space(p);
    if (!import->failed)
        rt_pbrt_finish_camera(p);
    close(p);
}
