/*
 * gltf.c - glTF 2.0 scenes, .gltf and .glb: nodes, cameras and lights.
 *
 * Both have y up and right-handed coordinates; a camera looks along its -z. Lights are photometric:
 * candela and lux become W/sr and W/m^2 by a luminous efficacy of 683 lm/W, as in the exporters
 * that make them from watts.
 */
#include "dsl/import/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VISITS_MAX = 1000000, LIGHTS_MAX = 100000, GLB_HEADER = 12, CHUNK_HEADER = 8 };

static const double lumens_per_watt = 683, degrees = 180 / IMPORT_PI;

/* ---- Meshes of nodes ---------------------------------------------------------- */

static void place_primitives(gltf *g, const gltf_mesh *mesh, const matrix *to_world)
{
    for (size_t i = 0; i < mesh->count && !g->import->failed; i++) {
        const gltf_primitive *p = &mesh->primitives[i];
        import_surface surface = {
            .material = p->material, .texture = IMPORT_NONE, .to_world = *to_world};
        if (rt_import_add_instance(g->import, 0, p->mesh, &surface))
            rt_import_bound(g->import, to_world, p->lo, p->hi);
    }
}

/* The numbers of one instance each of EXT_mesh_gpu_instancing, or NULL. */
static float *read_instances(gltf *g, const cJSON *extension, const char *name, int components,
                             size_t *count)
{
    uint64_t accessor;
    return !g->import->failed &&
                   rt_gltf_whole(g, gltf_get(extension, "attributes"), name, &accessor)
               ? rt_gltf_floats(g, accessor, components, count)
               : NULL;
}

/* How many there are: as many as any attribute has values, those of others too. */
static size_t count_instances(gltf *g, const cJSON *extension)
{
    const cJSON *const attributes = gltf_get(extension, "attributes");
    const char *const first = attributes && attributes->child ? attributes->child->string : NULL;
    uint64_t accessor, count = 0;
    if (first && rt_gltf_whole(g, attributes, first, &accessor) &&
        rt_gltf_whole(g, rt_gltf_item(g, GLTF_ACCESSORS, accessor, "a node"), "count", &count) &&
        count <= VISITS_MAX && rt_gltf_count_read(g, (size_t)count))
        return (size_t)count;
    return 0;
}

static void place_instances(gltf *g, const gltf_mesh *mesh, const cJSON *extension,
                            const matrix *to_world)
{
    size_t count = count_instances(g, extension);
    float *const moves = read_instances(g, extension, "TRANSLATION", 3, &count),
                 *const turns = read_instances(g, extension, "ROTATION", 4, &count),
                 *const scales = read_instances(g, extension, "SCALE", 3, &count);
    for (size_t i = 0; i < count && !g->import->failed; i++) {
        double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
        for (size_t c = 0; c < 4; c++) {
            if (c < 3 && moves)
                t[c] = moves[3 * i + c];
            if (c < 3 && scales)
                s[c] = scales[3 * i + c];
            if (turns)
                q[c] = turns[4 * i + c];
        }
        const matrix own = rt_gltf_placed(t, q, s), placed = rt_matrix_multiply(to_world, &own);
        place_primitives(g, mesh, &placed);
    }
    free(moves);
    free(turns);
    free(scales);
}

/* The mesh of a node; a skin places its corners in the world by itself. */
static void place_mesh(gltf *g, uint64_t index, const cJSON *node, const matrix *to_world)
{
    const cJSON *const instances = rt_gltf_extension(node, "EXT_mesh_gpu_instancing");
    const matrix world = rt_matrix_identity();
    const gltf_mesh *const mesh = rt_gltf_read_mesh(g, index, node);
    if (!mesh)
        return;
    if (gltf_get(node, "skin"))
        to_world = &world;
    if (instances)
        place_instances(g, mesh, instances, to_world);
    else
        place_primitives(g, mesh, to_world);
}

/* ---- Cameras and lights ------------------------------------------------------ */

static void set_film(gltf *g, double aspect)
{
    double height = aspect > 0 ? floor(640 / aspect + 0.5) : 480;
    rt_import_set_film(g->import, 640,
                       height < 1       ? 1
                       : height > 16384 ? 16384
                                        : (uint32_t)height,
                       NULL, 0);
}

/* Half a width or height of a view, which is above 0: others are told. */
static double magnification(gltf *g, const cJSON *view, const char *name)
{
    const double value = rt_gltf_number(g, view, name, 1), taken = value != 0 ? fabs(value) : 1;
    if (taken != value)
        rt_import_note_at(g->import, 0, "its %s of %g counts as %g", name, value, taken);
    return taken;
}

/* Tells what a camera lacks. */
static void note_camera(gltf *g, const cJSON *entry)
{
    const char *const type = rt_gltf_string(entry, "type");
    const int is_orthographic = gltf_get(entry, "orthographic") != NULL;
    const char *const taken = is_orthographic ? "orthographic" : "perspective";
    if (!type || strcmp(type, taken) != 0)
        rt_import_note_at(g->import, 0, "its type is '%.40s': it is taken as %s", type ? type : "",
                          taken);
    if (!is_orthographic && !gltf_get(gltf_get(entry, "perspective"), "yfov"))
        rt_import_note_at(g->import, 0, "it has no yfov, the angle of view: 0.7 radians are taken");
}

static void place_camera(gltf *g, uint64_t index, const char *node, const matrix *to_world)
{
    static const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const cJSON *entry = rt_gltf_item(g, GLTF_CAMERAS, index, "a node");
    const cJSON *perspective = gltf_get(entry, "perspective"),
                *orthographic = gltf_get(entry, "orthographic");
    import_camera camera = {0};
    if (!entry)
        return;
    rt_gltf_enter(g, GLTF_CAMERAS, (size_t)index);
    const char *const name = rt_gltf_string(entry, "name");
    if (!rt_import_takes_camera(g->import, 0, node ? node : name, name))
        return;
    rt_matrix_point(camera.eye, to_world, origin);
    rt_matrix_vector(camera.direction, to_world, forward);
    rt_matrix_vector(camera.up, to_world, up);
    camera.is_mirrored = rt_matrix_determinant(to_world) < 0;
    note_camera(g, entry);
    double yfov = rt_gltf_number(g, perspective, "yfov", 0.7),
           aspect = rt_gltf_number(g, perspective, "aspectRatio", 4 / 3.0);
    if (orthographic) {
        const double x = magnification(g, orthographic, "xmag"),
                     y = magnification(g, orthographic, "ymag");
        camera.is_orthographic = 1;
        const double across = rt_matrix_axis_length(to_world, 0),
                     upright = rt_matrix_axis_length(to_world, 1);
        camera.width = 2 * x * across;
        aspect = upright > 0 ? x * across / (y * upright) : 1;
    }
    if (!(yfov > 0 && yfov < 3.1415) || !(aspect > 1e-4 && aspect < 1e4)) {
        rt_import_note_at(g->import, 0,
                          "its angle of %g radians or aspect ratio of %g is out of range: they "
                          "became 0.7 and 4/3",
                          yfov, aspect);
        yfov = 0.7;
        aspect = 4 / 3.0;
    }
    const cJSON *const lens = orthographic ? orthographic : perspective;
    const import_plane planes[2] = {{"znear", rt_gltf_number(g, lens, "znear", 0)},
                                    {"zfar", rt_gltf_number(g, lens, "zfar", HUGE_VAL)}};
    rt_import_keep_clip(g->import, 0, planes, &camera);
    camera.fov = 2 * atan(aspect * tan(yfov / 2)) * degrees;
    set_film(g, aspect);
    rt_import_set_camera(g->import, 0, &camera);
}

/*
 * Blender's inner angle, degrees. It writes (1 - blend) outer; but in Cycles the light falls, by
 * the smoothstep of the cosine, from cos outer + blend (1 - cos outer) on.
 */
static double inner_angle_of_blend(const import_spot *spot)
{
    const double blend = spot->outer > 0 ? 1 - spot->inner / spot->outer : 0,
                 outer = cos(spot->outer / degrees);
    return acos(fmin(outer + (1 - outer) * fmin(fmax(blend, 0), 1), 1)) * degrees;
}

static void place_spot(gltf *g, const cJSON *light, const double position[3],
                       const double direction[3], const double intensity[3])
{
    const cJSON *from = gltf_get(light, "spot");
    import_spot spot = {.falloff = g->is_blender ? "smooth" : "square"};
    rt_gltf_count(g, from);
    spot.inner = rt_gltf_number(g, from, "innerConeAngle", 0) * degrees;
    spot.outer = rt_gltf_number(g, from, "outerConeAngle", 45 / degrees) * degrees;
    memcpy(spot.position, position, sizeof spot.position);
    memcpy(spot.direction, direction, sizeof spot.direction);
    memcpy(spot.intensity, intensity, sizeof spot.intensity);
    if (g->is_blender)
        spot.inner = inner_angle_of_blend(&spot);
    rt_import_add_spot_light(g->import, 0, &spot);
}

static void place_light(gltf *g, uint64_t index, const matrix *to_world)
{
    static const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, -1};
    const cJSON *light = rt_gltf_item(g, GLTF_LIGHTS, index, "a node");
    double colour[3] = {1, 1, 1}, position[3], direction[3];
    const char *type = rt_gltf_string(light, "type");
    if (!light)
        return;
    rt_gltf_enter(g, GLTF_LIGHTS, (size_t)index);
    rt_gltf_note_unread(g, GLTF_IS_LIGHT, light);
    if (++g->lights > LIGHTS_MAX) {
        rt_import_fail(g->import, 0, "the scene has more than %d lights", LIGHTS_MAX);
        return;
    }
    double intensity = rt_gltf_number(g, light, "intensity", 1) / lumens_per_watt;
    rt_gltf_numbers(g, light, "color", colour, 3);
    for (int c = 0; c < 3; c++)
        colour[c] *= intensity;
    if (gltf_get(light, "range"))
        rt_import_note_at(g->import, 0,
                          "the range of a light is left out: it falls by the square of "
                          "the distance");
    rt_matrix_point(position, to_world, origin);
    rt_matrix_vector(direction, to_world, forward);
    if (type && strcmp(type, "point") == 0)
        rt_import_add_point_light(g->import, 0, position, colour);
    else if (type && strcmp(type, "spot") == 0)
        place_spot(g, light, position, direction, colour);
    else if (type && strcmp(type, "directional") == 0)
        rt_import_add_directional_light(g->import, 0, direction, colour);
    else
        rt_import_note_at(g->import, 0, "a light of type '%.40s' is left out", type ? type : "");
}

/* ---- The tree ---------------------------------------------------------------- */

static void place_nodes(gltf *g, const cJSON *list, const matrix *around, int depth);

static void place_node(gltf *g, size_t number, const matrix *around, int depth)
{
    uint64_t index;
    const cJSON *node = rt_gltf_item(g, GLTF_NODES, number, "a scene or node");
    if (!node)
        return;
    const import_place before = rt_gltf_enter(g, GLTF_NODES, number);
    if (depth > GLTF_DEPTH_MAX || g->on_path[number] || ++g->visits > VISITS_MAX) {
        if (depth > GLTF_DEPTH_MAX)
            rt_import_fail(g->import, 0, "nodes are nested deeper than %d", GLTF_DEPTH_MAX);
        else
            rt_import_fail(g->import, 0, "%s",
                           g->on_path[number] ? "it is a child of itself"
                                              : "the scene has more than 10^6 nodes");
        return;
    }
    rt_gltf_note_unread(g, GLTF_IS_NODE, node);
    if (!rt_gltf_flag(g, rt_gltf_extension(node, "KHR_node_visibility"), "visible", 1)) {
        g->import->place = before; /* nor are its children seen */
        return;
    }
    g->on_path[number] = 1;
    const cJSON *lights = rt_gltf_extension(node, "KHR_lights_punctual");
    rt_gltf_count(g, gltf_get(node, "extensions"));
    rt_gltf_count(g, lights);
    matrix own = rt_gltf_node_matrix(g, node), to_world = rt_matrix_multiply(around, &own);
    if (rt_gltf_whole(g, node, "mesh", &index))
        place_mesh(g, index, node, &to_world);
    if (rt_gltf_whole(g, node, "camera", &index))
        place_camera(g, index, rt_gltf_string(node, "name"), &to_world);
    rt_gltf_enter(g, GLTF_NODES, number);
    if (rt_gltf_whole(g, lights, "light", &index))
        place_light(g, index, &to_world);
    place_nodes(g, rt_gltf_array_of(g, node, "children"), &to_world, depth + 1);
    g->on_path[number] = 0;
    g->import->place = before;
}

static void place_nodes(gltf *g, const cJSON *list, const matrix *around, int depth)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        const double number = cJSON_IsNumber(item) ? item->valuedouble : -1;
        if (g->import->failed)
            return;
        if (!(number >= 0) || number != floor(number)) {
            rt_import_fail(g->import, 0, "a list of nodes holds what is no index");
            return;
        }
        place_node(g, number < 1e15 ? (size_t)number : SIZE_MAX, around, depth);
    }
}

/* A file of the kind of a library has nodes, and no scene that they are in. */
static void place_roots(gltf *g, const matrix *world)
{
    const size_t *const parents = rt_gltf_parents(g);
    rt_import_note_at(g->import, 0, "the file has no scene: all of its nodes are taken");
    for (size_t i = 0; parents && i < g->lists[GLTF_NODES].count && !g->import->failed; i++)
        if (parents[i] == SIZE_MAX)
            place_node(g, i, world, 0);
}

static void place_scene(gltf *g)
{
    uint64_t index = 0;
    const matrix world = rt_matrix_identity();
    if (g->lists[GLTF_SCENES].count == 0 && g->lists[GLTF_NODES].count > 0) {
        place_roots(g, &world);
        return;
    }
    rt_gltf_whole(g, g->root, "scene", &index);
    const cJSON *scene = rt_gltf_item(g, GLTF_SCENES, index, "the file");
    if (g->lists[GLTF_SCENES].count > 1)
        rt_import_note_at(g->import, 0, "the file has several scenes: the default one is taken");
    rt_gltf_note_unread(g, GLTF_IS_SCENE, scene);
    place_nodes(g, rt_gltf_array_of(g, scene, "nodes"), &world, 0);
}

/* ---- The file ---------------------------------------------------------------- */

/* Extensions that hide what a mesh or an image is: files are to be freed of them first. */
static const struct {
    const char *name, *remedy;
} packed[] = {
    {"KHR_draco_mesh_compression", "gltf-transform copy IN.glb OUT.glb"},
    {"EXT_meshopt_compression", "gltf-transform copy IN.glb OUT.glb"},
    {"KHR_meshopt_compression", "gltf-transform copy IN.glb OUT.glb"},
    {"KHR_texture_basisu", "gltf-transform ktxdecompress IN.glb OUT.glb"},
    {"EXT_texture_webp", "gltf-transform png IN.glb OUT.glb"},
};

/* Extensions that a file cannot be read without are told, where they are not read. */
static int check_required(gltf *g, const char *name)
{
    static const char *const known[] = {
        "KHR_lights_punctual",     "KHR_texture_transform", "KHR_mesh_quantization",
        "KHR_materials_unlit",     "KHR_materials_ior",     "KHR_materials_emissive_strength",
        "EXT_mesh_gpu_instancing", "KHR_node_visibility"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(name, known[i]) == 0)
            return 1;
    for (size_t i = 0; i < sizeof packed / sizeof *packed; i++)
        if (strcmp(name, packed[i].name) == 0)
            return rt_import_fail(g->import, 0, "the file requires %s, which is not read: run %s",
                                  name, packed[i].remedy);
    /* where a material has it, it is told there */
    if (strncmp(name, "KHR_materials_", 14) != 0)
        rt_import_note_at(g->import, 0, "%.60s, which the file requires, is left out", name);
    return 1;
}

static int check_extensions(gltf *g)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, rt_gltf_array_of(g, g->root, "extensionsRequired"))
    {
        if (!check_required(g, cJSON_IsString(item) ? item->valuestring : "?"))
            return 0;
    }
    if (gltf_get(g->root, "animations"))
        rt_import_note_at(g->import, 0, "animations are left out");
    const char *version = rt_gltf_string(gltf_get(g->root, "asset"), "version");
    if (!version || strncmp(version, "2.", 2) != 0)
        return rt_import_fail(g->import, 0, "asset.version is not 2.x: it is no glTF 2.0 file");
    const char *maker = rt_gltf_string(gltf_get(g->root, "asset"), "generator");
    g->is_blender = maker && strncmp(maker, "Khronos glTF Blender", 20) == 0;
    g->import->is_relative = g->is_blender;
    const char *least = rt_gltf_string(gltf_get(g->root, "asset"), "minVersion");
    if (least && strcmp(least, "2.0") != 0)
        rt_import_note_at(g->import, 0, "asset.minVersion is %.20s: the file is read as glTF 2.0",
                          least);
    return 1;
}

/* Arrays of the file as lists. */
static int make_lists(gltf *g)
{
    static const char *const arrays[] = {"scenes",      "nodes",   "meshes",   "materials",
                                         "textures",    "images",  "samplers", "accessors",
                                         "bufferViews", "buffers", "cameras",  "skins"};
    for (int i = 0; i < GLTF_ARRAY_COUNT; i++) {
        const cJSON *array =
            i == GLTF_LIGHTS
                ? rt_gltf_array_of(g, rt_gltf_extension(g->root, "KHR_lights_punctual"), "lights")
                : rt_gltf_array_of(g, g->root, arrays[i]);
        size_t count = array ? (size_t)cJSON_GetArraySize(array) : 0;
        g->lists[i].items = malloc((count + 1) * sizeof *g->lists[i].items);
        if (!g->lists[i].items)
            return rt_import_fail_memory(g->import);
        for (cJSON *item = count ? array->child : NULL; item; item = item->next)
            g->lists[i].items[g->lists[i].count++] = item;
    }
    size_t materials = g->lists[GLTF_MATERIALS].count + 1;
    g->buffers = calloc(g->lists[GLTF_BUFFERS].count + 1, sizeof *g->buffers);
    g->images = calloc(g->lists[GLTF_IMAGES].count + 1, sizeof *g->images);
    g->has_alpha = calloc(g->lists[GLTF_IMAGES].count + 1, 1);
    g->meshes = calloc(g->lists[GLTF_MESHES].count + 1, sizeof *g->meshes);
    g->on_path = calloc(g->lists[GLTF_NODES].count + 1, 1);
    g->materials = malloc(materials * sizeof *g->materials);
    for (size_t i = 0; g->materials && i < materials; i++)
        for (int k = 0; k < 4; k++)
            g->materials[i][k / 2][k % 2] = IMPORT_NONE;
    if (!g->buffers || !g->images || !g->has_alpha || !g->meshes || !g->on_path || !g->materials)
        return rt_import_fail_memory(g->import);
    return !g->import->failed;
}

static uint32_t word_at(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* The JSON and the binary chunk of a .glb. */
static int split_glb(gltf *g, const char **bytes, size_t *size)
{
    const char *at = *bytes;
    if (*size < GLB_HEADER)
        return rt_import_fail(g->import, 0, "a .glb that ends after %lu bytes",
                              (unsigned long)*size);
    if (word_at(at + 4) != 2 || word_at(at + 8) > *size || word_at(at + 8) < GLB_HEADER)
        return rt_import_fail(g->import, 0,
                              "a .glb of version %lu and %lu bytes, of which %lu are "
                              "there",
                              (unsigned long)word_at(at + 4), (unsigned long)word_at(at + 8),
                              (unsigned long)*size);
    if (word_at(at + 8) < *size)
        rt_import_note_at(g->import, 0, "%lu bytes behind the end of the .glb are left out",
                          (unsigned long)*size - (unsigned long)word_at(at + 8));
    size_t end = word_at(at + 8), from = GLB_HEADER;
    *bytes = NULL;
    while (end - from >= CHUNK_HEADER) {
        size_t length = word_at(at + from);
        uint32_t type = word_at(at + from + 4);
        from += CHUNK_HEADER;
        if (length > end - from)
            return rt_import_fail(g->import, 0, "a chunk of %lu bytes, of which %lu are there",
                                  (unsigned long)length, (unsigned long)(end - from));
        if (type == 0x4e4f534a && !*bytes) {
            *bytes = at + from;
            *size = length;
        } else if (type == 0x004e4942 && !g->chunk) {
            g->chunk = (const unsigned char *)at + from;
            g->chunk_size = length;
        }
        from += length;
    }
    return *bytes ? 1 : rt_import_fail(g->import, 0, "the .glb has no JSON chunk");
}

static int parse(gltf *g, const char *text, size_t size)
{
    const char *end = NULL;
    int line = 1;
    g->root = cJSON_ParseWithLengthOpts(text, size, &end, 0);
    if (cJSON_IsObject(g->root)) {
        while (end < text + size && strchr(" \t\r\n", *end))
            end++; /* a zero too, with which some fill up the chunk */
        if (end < text + size)
            rt_import_note_at(g->import, 0, "what follows the JSON is left out: '%.*s'",
                              text + size - end < 12 ? (int)(text + size - end) : 12, end);
        return 1;
    }
    for (const char *at = text; end && at < end && at < text + size; at++)
        line += *at == '\n';
    if (!g->root && end == text && size > 1)
        return rt_import_fail(g->import, line, "it is neither JSON nor GLB: it begins with '%.*s'",
                              size < 12 ? (int)size : 12, text);
    if (g->root || !end || end >= text + size - 1)
        return rt_import_fail(g->import, line,
                              g->root     ? "it is no JSON object"
                              : size == 0 ? "it is empty"
                                          : "the JSON ends too early");
    return rt_import_fail(g->import, line, "it is no JSON at byte %lu, '%.12s'",
                          (unsigned long)(end - text) + 1, end);
}

static void close(gltf *g)
{
    for (size_t i = 0; g->buffers && i < g->lists[GLTF_BUFFERS].count; i++)
        free(g->buffers[i].owned);
    for (size_t i = 0; g->meshes && i < g->lists[GLTF_MESHES].count; i++)
        free(g->meshes[i].primitives);
    for (int i = 0; i < GLTF_ARRAY_COUNT; i++)
        free(g->lists[i].items);
    free(g->buffers);
    free(g->images);
    free(g->has_alpha);
    free(g->meshes);
    free(g->on_path);
    free(g->materials);
    free(g->posed.primitives);
    free(g->parents);
    cJSON_Delete(g->root);
}

void rt_import_gltf(importer *import, const char *bytes, size_t size)
{
    gltf g = {.import = import, .size = size};
    int is_good = size >= 4 && memcmp(bytes, "glTF", 4) == 0 ? split_glb(&g, &bytes, &size) : 1;
    if (is_good && parse(&g, bytes, size) && make_lists(&g) && check_extensions(&g)) {
        rt_gltf_note_twice(&g, g.root);
        place_scene(&g);
    }
    rt_import_note_clip(import);
    import->place = (import_place){.file = NULL}; /* the names of items end with the JSON */
    close(&g);
}
