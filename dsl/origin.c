/* origin.c - remembers places by object, and reports findings there. */
#include "dsl/origin.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int add_origin(rt_origin_list *list, const rt_place *place, rt_budget *budget)
{
    if (list->count == list->capacity) {
        size_t capacity = list->capacity ? list->capacity + list->capacity / 2 : 64;
        uint64_t bytes = (uint64_t)(capacity - list->capacity) * sizeof *list->items;
        rt_origin *items = rt_budget_take(budget, bytes, "the list of places in the text")
                               ? realloc(list->items, capacity * sizeof *items)
                               : NULL;
        if (!items)
            return 0;
        list->items = items;
        list->capacity = capacity;
    }
    rt_origin *origin = &list->items[list->count++];
    origin->at = (uint32_t)(place->source->before + place->offset);
    origin->line = (uint32_t)place->line;
    origin->order = place->order < UINT32_MAX ? (uint32_t)place->order : UINT32_MAX;
    return 1;
}

static int is_space(char c)
{
    return c == ' ' || c == '\t';
}

/* Bytes of the word at text[at], or 0. */
static size_t word_length(const char *text, size_t at)
{
    size_t length = 0;
    while ((text[at + length] >= 'a' && text[at + length] <= 'z') || text[at + length] == '_')
        length++;
    return length;
}

/* The words that begin the block at an origin: one, or two as in `light point` on one line. */
static rt_place place_at(const rt_sources *sources, const rt_origin *origin)
{
    const rt_source *source = sources->latest;
    while (origin->at < source->before || origin->at >= source->before + source->size)
        source = source->next;
    rt_place place = {source, origin->order, origin->at - source->before, (int)origin->line, 1, 0};
    const char *text = source->text;
    size_t length = word_length(text, place.offset), next = place.offset + length;
    while (is_space(text[next]))
        next++;
    if (rt_text_equal((rt_text){text + place.offset, length}, "light"))
        length = next + word_length(text, next) - place.offset;
    place.length = (int)length;
    while (place.offset - (size_t)(place.column - 1) > 0 &&
           text[place.offset - (size_t)place.column] != '\n')
        place.column++;
    return place;
}

int rt_origins_add(rt_origins *origins, const rt_block *block, rt_place place)
{
    const rt_field *field;
    if (block->id == RT_BLOCK_CAMERA)
        origins->camera = place;
    if (strcmp(block->word, "light") == 0)
        return add_origin(&origins->lights, &place, origins->budget);
    if (block->id == RT_BLOCK_GRID)
        return add_origin(&origins->grids, &place, origins->budget);
    /* A shape is what has a material. */
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++)
        if (field->type == RT_FIELD_MATERIAL)
            return add_origin(&origins->shapes, &place, origins->budget);
    return 1;
}

/* Reports under way. */
typedef struct reporting {
    const rt_origins *origins;
    const rt_sources *sources;
    rt_reports *reports;
    rt_place last; /* of a light or open shape that was reported, line 0 before the first */
} reporting;

#define MOVE_TO_ORIGIN                                                                             \
    "move the scene to the origin: `translate` its meshes, its camera and its lights alike"

/* What helps against findings of this kind, whatever they are about; NULL: that depends. */
static const char *fixed_hint(rt_finding_kind kind)
{
    static const struct {
        rt_finding_kind kind;
        const char *text;
    } hints[] = {
        {RT_FINDING_INSIDE_OUT, "reverse the order of the vertices of its faces; normals that a "
                                "file gives to vertices turn nothing round"},
        {RT_FINDING_LEANING_NORMALS, "give sharp edges normals for each face (in Blender, Edge "
                                     "Split), finer faces, or the mesh `shading flat`"},
        {RT_FINDING_OPEN_GLASS, "glass is a closed shape, such as a sphere; with ior 1 it is a "
                                "sheet without refraction; plastic is a `coat` over `kd`"},
        {RT_FINDING_OPEN_INTERFACE, "an interface is a closed shape, such as a sphere"},
        {RT_FINDING_ROUNDED, MOVE_TO_ORIGIN},
        {RT_FINDING_CAMERA_ROUNDED, MOVE_TO_ORIGIN},
        {RT_FINDING_NO_COORDINATES, "export it with texture coordinates (in Blender, UV > Unwrap), "
                                    "or let the texture show an `attribute`"},
        {RT_FINDING_UNSEEN_COLOURS, "they multiply `kd` and `base_color`"},
        {RT_FINDING_NO_NORMALS,
         "a normal map has the tangent-space normal n as (1 + n) / 2 in red, "
         "green and blue; an image of heights is a `bump_texture`"},
        {RT_FINDING_VANISHED, "opacity is 1 where the surface is, and 0 where it is cut out"},
    };
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++)
        if (hints[i].kind == kind)
            return hints[i].text;
    return NULL;
}

/* Whether it is about a shape that the text can be pointed at for it. */
static int is_of_shape(const rt_finding *finding)
{
    return fixed_hint(finding->kind)
               ? finding->shape != RT_NONE
               : finding->other != RT_NONE || finding->grid != RT_NONE || finding->solid_count > 0;
}

static rt_place place_of_shape(const reporting *r, uint32_t shape)
{
    return place_at(r->sources, &r->origins->shapes.items[shape]);
}

static rt_place place_of(const reporting *r, const rt_finding *finding)
{
    const rt_origins *origins = r->origins;
    if (finding->light != RT_NONE)
        return place_at(r->sources, &origins->lights.items[finding->light]);
    if (finding->emitter != RT_NONE)
        return place_of_shape(r, finding->emitter);
    if (is_of_shape(finding))
        return place_of_shape(r, finding->shape);
    if (finding->kind == RT_FINDING_NOTHING_IN_VIEW ||
        finding->kind == RT_FINDING_CAMERA_IN_OPAQUE ||
        finding->kind == RT_FINDING_CAMERA_IN_MEDIUM || finding->kind == RT_FINDING_CAMERA_ROUNDED)
        return origins->camera;
    return (rt_place){origins->text, 0, 0, 0, 0, 0};
}

/* Where the solids are, one after the other; those of a repeat are at one place. */
static void hint_solids(const reporting *r, const rt_finding *finding)
{
    char places[256] = "";
    rt_place before = {NULL, 0, 0, 0, 0, 0};
    for (uint32_t i = 0; i < finding->solid_count; i++) {
        const rt_place place = place_of_shape(r, finding->solids[i]);
        const size_t used = strlen(places);
        if (finding->solids[i] == finding->shape ||
            (place.source == before.source && place.offset == before.offset))
            continue;
        snprintf(places + used, sizeof places - used, "%s%s:%d", used > 0 ? ", " : "",
                 place.source->path, place.line);
        before = place;
    }
    rt_report_hint(r->reports, "the others are at %s", places);
}

/* Where the grid is, and its name, the word after `grid`. */
static void hint_grid(const reporting *r, uint32_t index)
{
    static const char space[] = " \t\r\n";
    const rt_place place = place_at(r->sources, &r->origins->grids.items[index]);
    const char *name = place.source->text + place.offset + place.length;
    name += strspn(name, space);
    const size_t length = strcspn(name, " \t\r\n{#");
    if (length > 0)
        rt_report_hint(r->reports, "grid '%.*s' is at %s:%d", (int)length, name, place.source->path,
                       place.line);
    else /* a comment stands between */
        rt_report_hint(r->reports, "the grid is at %s:%d", place.source->path, place.line);
}

/* How a light is turned, and where what is behind it stands. */
static void hint_light(const reporting *r, const rt_finding *finding)
{
    const char *const turn =
        finding->emitter == RT_NONE ? "" : "turn it round, or set `two_sided` of its material";
    if (finding->shape == RT_NONE) {
        if (*turn)
            rt_report_hint(r->reports, "%s", turn);
        return;
    }
    const rt_place behind = place_of_shape(r, finding->shape);
    const rt_text word = rt_place_text(&behind);
    rt_report_hint(r->reports, "%s%sthe %.*s is at %s:%d", turn, *turn ? "; " : "",
                   (int)word.length, word.at, behind.source->path, behind.line);
}

static void hint(const reporting *r, const rt_finding *finding)
{
    const char *const fixed = fixed_hint(finding->kind);
    if (fixed) {
        rt_report_hint(r->reports, "%s", fixed);
    } else if (finding->kind == RT_FINDING_LIGHTS_NOTHING) {
        hint_light(r, finding);
    } else if (finding->kind == RT_FINDING_LIGHT_IN_SURFACE) {
        const rt_place surface = place_of_shape(r, finding->shape);
        const rt_text word = rt_place_text(&surface);
        rt_report_hint(r->reports, "move it off by a thousandth of its size; the %.*s is at %s:%d",
                       (int)word.length, word.at, surface.source->path, surface.line);
    } else if (finding->grid != RT_NONE) {
        hint_grid(r, finding->grid);
    } else if (finding->solid_count > 0) {
        hint_solids(r, finding);
    } else if (finding->other != RT_NONE) {
        const rt_place other = place_of_shape(r, finding->other);
        rt_report_hint(r->reports, "the other is at %s:%d; give the material of %s",
                       other.source->path, other.line,
                       finding->kind == RT_FINDING_HIDDEN ? "this one a priority as high"
                                                          : "one of them a higher priority");
    } else if (finding->shape != RT_NONE) {
        const rt_place solid = place_of_shape(r, finding->shape);
        rt_text word = rt_place_text(&solid);
        rt_report_hint(r->reports, "the %.*s is at %s:%d", (int)word.length, word.at,
                       solid.source->path, solid.line);
    }
}

static void report(void *user, const rt_finding *finding)
{
    reporting *r = user;
    rt_place place = place_of(r, finding);
    /* The iterations of a repeat are at one place: say once what is wrong there. */
    if (finding->kind == RT_FINDING_LIGHT_IN_OPAQUE || finding->kind == RT_FINDING_LIGHTS_NOTHING ||
        finding->kind == RT_FINDING_LIGHT_IN_SURFACE || is_of_shape(finding)) {
        if (place.source == r->last.source && place.offset == r->last.offset)
            return;
        r->last = place;
    }
    rt_report_finding(r->reports, place, finding);
    hint(r, finding);
}

void rt_origins_report(const rt_origins *origins, const rt_sources *sources, const rt_scene *scene,
                       rt_reports *reports)
{
    reporting r = {origins, sources, reports, {NULL, 0, 0, 0, 0, 0}};
    rt_scene_check(scene, report, &r);
}

void rt_origins_free(rt_origins *origins)
{
    free(origins->shapes.items);
    free(origins->lights.items);
    free(origins->grids.items);
    memset(origins, 0, sizeof *origins);
}
