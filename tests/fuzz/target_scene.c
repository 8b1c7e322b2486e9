/* target_scene.c - scene texts, with the files that they name. */
#define _XOPEN_SOURCE 700 /* realpath */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/crc32.h"
#include "dsl/function.h"
#include "fuzz/scene_text.h"
#include "fuzz/targets.h"
#include "pack/pack.h"

enum { SHAPES_MAX = 500 }; /* of a scene that is packed */

/* What is said of one text. */
typedef struct heard {
    int errors, lines;
    int has_nul;  /* which ends a line that is shown */
    int has_root; /* only files of the current directory may be named */
    int reports,
        cancels; /* reports of progress; at which of them the reading is cancelled, 0: none */
} heard;

static void on_diagnostic(void *user, const rt_diagnostic *d)
{
    heard *h = user;
    h->errors += d->severity == RT_SEVERITY_ERROR;
    fuzz_expect_line(d->message);
    if (d->hint)
        fuzz_expect_line(d->hint);
    FUZZ_EXPECT(d->file[0] != '\0');
    FUZZ_EXPECT((d->line == 0) == (d->column == 0));
    if (d->line == 0)
        return;
    FUZZ_EXPECT(d->line > 0 && d->column > 0 && d->length >= 1);
    FUZZ_EXPECT(h->has_nul || (size_t)d->column <= strlen(d->source_line) + 1);
    FUZZ_EXPECT(!strchr(d->source_line, '\n'));
    FUZZ_EXPECT(strcmp(d->file, "fuzz.rts") != 0 || d->line <= h->lines);
}

/* With a root, only files below it are read, or it itself: here the current directory. */
static void on_file(void *user, const char *path)
{
    const heard *h = user;
    char here[PATH_MAX], there[PATH_MAX];
    FUZZ_EXPECT(path[0] != '\0');
    if (!h->has_root || strcmp(path, "fuzz.rts") == 0 || !realpath(path, there))
        return;
    FUZZ_EXPECT(realpath(".", here) != NULL);
    FUZZ_EXPECT(strncmp(there, here, strlen(here)) == 0);
    FUZZ_EXPECT(there[strlen(here)] == '/' || there[strlen(here)] == '\0');
}

static int on_progress(void *user, const rt_progress *progress)
{
    heard *h = user;
    FUZZ_EXPECT(progress->fraction >= 0 && progress->fraction <= 1);
    return h->cancels && h->reports++ == h->cancels - 1;
}

static void check_lights(const rt_scene_image *image)
{
    const rt_scene_header *header = image->data;
    const rt_light_data *lights =
        (const void *)((const char *)image->data + (size_t)header->lights * RT_SCENE_ROW);
    FUZZ_EXPECT(image->light_power >= 0 && isfinite(image->light_power));
    for (rt_u32 i = 0; i < header->light_count; i++) {
        fuzz_expect_finite(&lights[i].power, 1);
        FUZZ_EXPECT(lights[i].pmf >= 0 && lights[i].pmf <= 1);
        FUZZ_EXPECT(lights[i].cdf >= 0 && lights[i].cdf <= 1);
    }
}

/* What a render makes of a scene before a device sees it: the hierarchy, and tables of numbers. */
static void check_scene(const rt_scene *scene)
{
    rt_stage_progress progress;
    rt_scene_image image = {0};
    rt_scene_info info;
    rt_error error;
    rt_scene_get_info(scene, &info);
    if (info.shapes > SHAPES_MAX || info.triangles > SHAPES_MAX)
        return;
    FUZZ_EXPECT(rt_stage_begin(&progress, NULL, RT_STAGE_BUILD) == RT_OK);
    rt_status status =
        rt_scene_pack(&image, scene, RT_ACCEL_BVH, info.shapes % 2 ? 1 : 8, 1, &progress, &error);
    if (status == RT_OK) {
        check_lights(&image);
        rt_scene_image_free(&image);
    } else {
        FUZZ_EXPECT(error.status == status);
        fuzz_expect_line(error.message);
    }
}

/* Every setting as a text is what sets it, but for a 0 that means the default. */
static void check_settings(const rt_scene *scene)
{
    rt_render_options options, again = {0};
    char text[64];
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    rt_scene_get_options(scene, &options);
    for (size_t i = 0; i < count; i++) {
        rt_setting_get(text, sizeof text, &settings[i], &options);
        rt_status status = rt_setting_set(&again, &settings[i], text, NULL);
        FUZZ_EXPECT(status == RT_OK || strcmp(text, "0") == 0);
        FUZZ_EXPECT(rt_setting_value(&settings[i], &again) ==
                    rt_setting_value(&settings[i], &options));
        rt_setting_missing(&settings[i], &options);
    }
}

/* Reads the text, from a file or from memory; the sum of its bytes chooses under what terms. */
static rt_status read_text(rt_scene **out, const char *text, size_t size, heard *h,
                           rt_memory *memory, rt_error *error)
{
    const uint32_t sum = rt_crc32(text, size);
    const rt_hooks hooks = {.progress = on_progress, .user = h};
    const rt_load_options options = {.diagnostic = on_diagnostic,
                                     .user = h,
                                     .check = 1,
                                     .file = on_file,
                                     .hooks = &hooks,
                                     .root = sum & 2 ? "." : NULL,
                                     .memory = memory};
    h->has_root = options.root != NULL;
    h->cancels = sum & 0xf0 ? 0 : 1 + (int)(sum >> 8 & 3);
    for (size_t i = 0; i < size; i++)
        h->lines += text[i] == '\n';
    h->has_nul = memchr(text, 0, size) != NULL;
    if (sum & 1)
        return rt_scene_parse(out, text, "fuzz.rts", &options, error);
    fuzz_write("fuzz.rts", text, size);
    return rt_scene_load(out, "fuzz.rts", &options, error);
}

/* Whether the text was read; where it was cancelled, or had too little memory, that is said. */
static int check_answer(rt_status status, const rt_error *error, const rt_scene *scene,
                        const heard *h, const rt_memory *memory)
{
    if (status == RT_CANCELLED || status == RT_ERROR_MEMORY) {
        FUZZ_EXPECT(status == RT_CANCELLED ? h->reports == h->cancels : memory != NULL);
        FUZZ_EXPECT(scene == fuzz_untouched && error->status == status);
        fuzz_expect_line(error->message);
        return 0;
    }
    int is_good = fuzz_expect_answer(status, error, scene);
    FUZZ_EXPECT(is_good == (h->errors == 0));
    return is_good;
}

static int run(const uint8_t *data, size_t size)
{
    heard h = {.lines = 1};
    rt_scene *scene = fuzz_untouched;
    rt_memory *memory = NULL;
    rt_memory_info info;
    rt_error error;
    char *text = malloc(size + 1);
    FUZZ_EXPECT(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    if ((rt_crc32(text, size) >> 16 & 7) == 0)
        FUZZ_EXPECT(rt_memory_create(&memory, 1024 + 64 * (uint64_t)size, &error) == RT_OK);
    rt_status status = read_text(&scene, text, size, &h, memory, &error);
    free(text);
    int is_good = check_answer(status, &error, scene, &h, memory);
    if (is_good) {
        check_settings(scene);
        check_scene(scene);
        rt_scene_destroy(scene);
    }
    if (memory) {
        rt_memory_get_info(memory, &info);
        FUZZ_EXPECT(info.used == 0 && info.most <= info.limit);
    }
    rt_memory_destroy(memory);
    return is_good;
}

/* ---- Seeds --------------------------------------------------------------------------------- */

#define NAMES "include \"names.rts\"\n"
#define STAGE                                                                                      \
    NAMES "camera { eye 0 1 -6  look_at 0 0 0 }\n"                                                 \
          "light point { position 2 4 -3  intensity 20 }\n"

#define OUTSIDE                                                                                    \
    "include \"link.rts\"\ninclude \"../names.rts\"\ninclude \"/etc/passwd\"\n"                    \
    "include \"./a.rts\"\nmesh m { file \"link.rts\" }\ntexture l { file \"/dev/zero\" }\n"

/* Statements, and what is found in a scene: media around the camera and lights, contacts, views. */
static const char *const texts[] = {
    "# a\nlet a = (1 + 2) * sin(30) / max(2, 3) - pi\nlet v = (2 * [1 a -2])\n" STAGE
    "render { mode photon  k all  radius 1  kernel cone  spp 2 }\n"
    "repeat i from 0 to 3 {\n  let x = (i * 2)\n  repeat j from 1 to 2 {\n"
    "    sphere { centre x j a  radius 0.5  material g }\n  }\n}\n",
    STAGE "sphere { centre 0 0 0  radius 1  material g }\n"
          "box { centre 1 0 0  size 1 1 1  material h }\n"
          "cylinder { a 0 1 0  b 0 2 0  radius 0.5  caps true  material h }\n"
          "ellipsoid { centre 0 -2 0  radii 1 1 1  material h }\n"
          "cone { base -1 0 0  apex -1 1 0  radius 1  caps true  material h }\n"
          "box { centre -3 0 0  size 1 1 1  material g }\n"
          "box { centre -4 0 0  size 1 1 1  material h }\n"
          "model { file \"m.ply\"  material h }\n",
    STAGE "sphere { centre 0 1 -6  radius 1  material m }\n"
          "ellipsoid { centre 2 4 -3  radii 1 2 1  material m  rotate 0 0 1 30 }\n"
          "torus { centre 2 4 -3  axis 0 1 0  major_radius 2  minor_radius 1  material m }\n"
          "cone { base 2 3 -3  apex 2 6 -3  radius 1  caps true  material m }\n"
          "sphere { centre 2 3 -3  radius 0.1  material m  power 3 }\n",
    STAGE "material inner { kt 1  ior 1.3  priority 2 }\n"
          "box { centre 0 0 0  size 2 2 2  material g }\n"
          "sphere { centre 0 0 0  radius 0.5  material inner  power 5 }\n"
          "instance thing { material g  scale -1 1 1 }\n"
          "quad { corner -1 -1 1  edge1 2 0 0  edge2 0 2 0  material h }\n"
          "plane { point 0 -1 0  normal 0 1 0  material h }\n",
    STAGE "medium { absorption 0 0.1 0.2  scattering 0.5  g 0.6 }\n"
          "material puff { interface true  absorption 1  scattering 3 2 1  g -0.5  priority 1 }\n"
          "material milk { kt 1  fresnel dielectric  scattering 60  g 0.9 }\n"
          "sphere { centre 0 0 0  radius 2  material puff }\n"
          "sphere { centre 1 0 0  radius 1.5  material milk }\n"
          "model { file \"m.ply\"  material puff }\n",
    NAMES "camera { eye 0 0 0  look_at 0 0 1 }\nsphere { centre 0 0 -5  radius 1  material m }\n"
          "light directional { direction 0 -1 0  irradiance 1 }\nlight environment { }\n"
          "light beam { position 0 2 0  target 0 0 0  width 1  height 2  power 3  cross_section "
          "rectangular }\n",
    "let a = [1 2 3]\nlet b = (a / [1 1 0])\nlet c = (1e200 * [1e200 1 1])\nlet d = [1 a 2]\n"
    "let e = sin (1)\nlet f = max(1)\nlet g = sin(1, 2)\nlet h = infinity\nlet i = sign(0)\n"
    "let j = 1E+3\nlet k = 1 +\nlet l = ((1)\nlet m = [1 2\nlet n = mod(5 0)\nlet o = -(-2)\n"
    "let p = log(0)\nlet q = 2 3\nlet r = \n let let = 1\nlet a = 2\n",
    "film { width 8m  height 6.5  width 9 }\ncamera { fov 40 degrees  eye [1 2 3]  look_at 1 2 }\n"
    "material m { kd 1 2  fresnel of  ior all  kd_texture 3  kd 2 }\nlight { }\nlight sun { }\n"
    "sphere m { }\nmaterial { }\ninstance nothing { }\nbox { rotate 1 2 3 matrix 1 2 }\ncube { }\n",
    "# \303\251\340\240\200\355\237\277\360\220\200\200\364\217\277\277 \355\240\200\n"
    "# \340\200\200 \360\200\200\200 \364\220\200\200 \303\n\t@ $ 'x' \"a\n12abc 1.2.3 .5. 1e\n",
    "include \"loop.rts\"\ninclude \"none.rts\"\nlet s = unknown\n} { ( ] \377 \"open\n",
    OUTSIDE,
};

/* A text so often, and what follows. */
static void add_often(fuzz_inputs *seeds, const char *text, int times, const char *last)
{
    rt_bytes all = {0};
    for (int i = 0; i < times; i++)
        fuzz_put_text(&all, text);
    fuzz_put_text(&all, last);
    fuzz_add(seeds, all.data, all.size);
    rt_bytes_free(&all);
}

/* What is counted, and is too much: errors, repeats inside each other, iterations, parentheses. */
static void add_limits(fuzz_inputs *seeds)
{
    add_often(seeds, "a\n", 1100, "");
    add_often(seeds, "repeat i from 0 to 0 {\n", 33, "material m { }\n");
    add_often(seeds, "repeat i from 1 to 200 {\n", 3, "material m { }\n}}}\n");
    add_often(seeds, "(", 70, "1\n");
    add_often(seeds, "film { } ", 40, "render { k 7 k 8 k all }\n");
    fuzz_add_text(seeds,
                  "repeat i from 0 to 1e9 { material m { } }\nrepeat j from [1 2 3] to 2 { }");
    fuzz_add_text(seeds,
                  "include \"c0.rts\"\ninclude \"loop2.rts\"\ninclude \"\"\ninclude \".\"\n");
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_random random = fuzz_random_begin(7);
    add_limits(seeds);
    const rt_block *block;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        fuzz_add_text(seeds, texts[i]);
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++)
        for (int fields = FUZZ_FIELDS_NEEDED; fields <= FUZZ_FIELDS_ANY; fields++) {
            rt_bytes text = {0};
            fuzz_put_text(&text, block->id == RT_BLOCK_CAMERA ? NAMES : STAGE);
            fuzz_scene_block(&text, block, (fuzz_fields)fields, &random);
            fuzz_add(seeds, text.data, text.size);
            rt_bytes_free(&text);
        }
    for (size_t i = 0; i < RT_FUNCTION_COUNT; i++) {
        char text[128];
        snprintf(text, sizeof text, NAMES "let x = %s(0.3%s)\nlet y = [x x x]\n",
                 rt_functions[i].name, rt_functions[i].arguments > 1 ? ", n" : "");
        fuzz_add_text(seeds, text);
    }
}

/* ---- Mutation ------------------------------------------------------------------------------ */

/* The start of the line of a random place. */
static size_t choose_line(const uint8_t *data, size_t size, fuzz_random *random)
{
    size_t at = fuzz_random_below(random, (uint32_t)size + 1);
    while (at > 0 && data[at - 1] != '\n')
        at--;
    return at;
}

/* Behind the end of the line. */
static size_t line_end(const uint8_t *data, size_t size, size_t at)
{
    const uint8_t *end = memchr(data + at, '\n', size - at);
    return end ? (size_t)(end - data) + 1 : size;
}

/* Puts another value in the place of a number or a word. */
static size_t change_value(uint8_t *data, size_t size, size_t room, fuzz_random *random)
{
    rt_bytes value = {0};
    size_t at = fuzz_random_below(random, (uint32_t)size + 1);
    while (at > 0 && !strchr(" \n{(", data[at - 1]))
        at--;
    size_t end = at;
    while (end < size && !strchr(" \n})", data[end]))
        end++;
    fuzz_scene_any_value(&value, random);
    size = fuzz_splice(data, size, room, at, end - at, value.data, value.size);
    rt_bytes_free(&value);
    return size;
}

/* Adds a block, or puts one in the place of a line. */
static size_t change_block(uint8_t *data, size_t size, size_t room, fuzz_random *random)
{
    rt_bytes block = {0};
    size_t at = choose_line(data, size, random);
    size_t gone = fuzz_random_below(random, 2) ? line_end(data, size, at) - at : 0;
    fuzz_scene_any_block(&block, random);
    size = fuzz_splice(data, size, room, at, gone, block.data, block.size);
    rt_bytes_free(&block);
    return size;
}

/* Puts a line into a repeat. */
static size_t repeat_line(uint8_t *data, size_t size, size_t room, fuzz_random *random)
{
    static const char begin[] = "repeat i from 0 to 3 { ", end[] = " }\n";
    size_t at = choose_line(data, size, random), stop = line_end(data, size, at);
    if (size + sizeof begin + sizeof end > room)
        return size;
    size = fuzz_splice(data, size, room, stop, 0, end, sizeof end - 1);
    return fuzz_splice(data, size, room, at, 0, begin, sizeof begin - 1);
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    switch (fuzz_random_below(&random, 8)) {
    case 0:
    case 1:
        return change_block(data, size, room, &random);
    case 2:
    case 3:
        return change_value(data, size, room, &random);
    case 4:
        return repeat_line(data, size, room, &random);
    default:
        return fuzz_mutate_bytes(data, size, room);
    }
}

/* ---- The dictionary ------------------------------------------------------------------------ */

/* What the parser knows beside its tables. */
static const char *const statements[] = {
    "let ",         "include ",  "repeat ",      "from ",     "to ",       "pi",
    "all",          "\"a.rts\"", "\"link.rts\"", "\"../",     "\"/",       "\"names.rts\"",
    "\"loop.rts\"", "\"t.png\"", "\"t.ppm\"",    "\"t.pfm\"", "\"t.exr\"", "\"m.ply\"",
    "\"m.obj\"",    "\"m.off\"", "\"m.stl\"",    "1e999",     "1e-999",    "1e15",
    "1e28",         "0.5",       " { ",          " }\n",      " = ",       "[1 2 3]",
    "\"d.grid\"",   "\"l.ies\"", "\n# ",         NULL};

static void add_field(fuzz_inputs *words, const rt_field *field)
{
    const rt_word *word = rt_field_words(field);
    fuzz_add_text(words, field->name);
    for (; word && word->name; word++)
        fuzz_add_text(words, word->name);
}

static void words(fuzz_inputs *out)
{
    const rt_block *block;
    const rt_field *field;
    for (size_t i = 0; statements[i]; i++)
        fuzz_add_text(out, statements[i]);
    for (size_t i = 0; i < RT_FUNCTION_COUNT; i++)
        fuzz_add_text(out, rt_functions[i].name);
    for (size_t i = 0; (block = rt_block_at(i)) != NULL; i++) {
        char title[RT_BLOCK_TITLE_SIZE];
        fuzz_add_text(out, rt_block_title(title, block));
        for (size_t j = 0; (field = rt_block_field(block, j)) != NULL; j++)
            add_field(out, field);
    }
}

/* ---- Files --------------------------------------------------------------------------------- */

static void begin(void)
{
    static const char part[] = "material a { kd 0.5 }\nlet b = 4\n",
                      loop[] = "include \"loop.rts\"", around[] = "include \"loop3.rts\"",
                      back[] = "include \"loop2.rts\"";
    char name[24], next[40];
    if (symlink("/etc/passwd", "link.rts") != 0)
        FUZZ_EXPECT(access("link.rts", F_OK) == 0);
    fuzz_write("a.rts", part, sizeof part - 1);
    fuzz_write("loop2.rts", around, sizeof around - 1);
    fuzz_write("loop3.rts", back, sizeof back - 1);
    for (int i = 0; i < 34; i++) {
        snprintf(name, sizeof name, "c%d.rts", i);
        snprintf(next, sizeof next, "include \"c%d.rts\"\n", i + 1);
        fuzz_write(name, next, strlen(next));
    }
    fuzz_write("names.rts", fuzz_scene_names, strlen(fuzz_scene_names));
    fuzz_write("loop.rts", loop, sizeof loop - 1);
    fuzz_write_seed(&fuzz_target_ply, 1, "m.ply");
    fuzz_write_seed(&fuzz_target_obj, 1, "m.obj");
    fuzz_write_seed(&fuzz_target_off, 1, "m.off");
    fuzz_write_seed(&fuzz_target_stl, 0, "m.stl");
    fuzz_write_seed(&fuzz_target_png, 10, "t.png");
    fuzz_write_seed(&fuzz_target_ppm, 0, "t.ppm");
    fuzz_write_seed(&fuzz_target_pfm, 0, "t.pfm");
    fuzz_write_seed(&fuzz_target_exr, 1, "t.exr");
    fuzz_write_seed(&fuzz_target_grid, 0, "d.grid");
    fuzz_write_seed(&fuzz_target_ies, 0, "l.ies");
}

const fuzz_target fuzz_target_scene = {
    .name = "scene",
    .sources = "dsl/*.c lib/scene/*.c lib/setting/*.c lib/shape/*.c lib/texture/*.c",
    .run = run,
    .seed = seed,
    .words = words,
    .begin = begin,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 6000,
};
