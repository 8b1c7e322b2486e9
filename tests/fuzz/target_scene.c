/* target_scene.c - scene texts, with the files that they name. */
#include <stdlib.h>
#include <string.h>

#include "dsl/function.h"
#include "dsl/schema.h"
#include "fuzz/targets.h"

/* What is said of one text. */
typedef struct heard {
    int errors, lines;
    int has_nul; /* which ends a line that is shown */
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

static void on_file(void *user, const char *path)
{
    (void)user;
    FUZZ_EXPECT(path[0] != '\0');
}

static int run(const uint8_t *data, size_t size)
{
    heard h = {0, 1, memchr(data, 0, size) != NULL};
    const rt_load_options options = {
        .diagnostic = on_diagnostic, .user = &h, .check = 1, .file = on_file};
    rt_scene *scene = fuzz_untouched;
    rt_error error;
    char *text = malloc(size + 1);
    FUZZ_EXPECT(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    for (size_t i = 0; i < size; i++)
        h.lines += text[i] == '\n';
    rt_status status;
    if (size % 2) {
        fuzz_write("fuzz.rts", text, size);
        status = rt_scene_load(&scene, "fuzz.rts", &options, &error);
    } else {
        status = rt_scene_parse(&scene, text, "fuzz.rts", &options, &error);
    }
    free(text);
    int is_good = fuzz_expect_answer(status, &error, scene);
    FUZZ_EXPECT(is_good == (h.errors == 0));
    if (is_good)
        rt_scene_destroy(scene);
    return is_good;
}

/* ---- Seeds --------------------------------------------------------------------------------- */

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "camera { eye 0 1 -4  look_at 0 1 0  fov 40 }\nfilm { width 8 height 6 }\n"
                         "material white { kd 0.7 }\nplane { point 0 0 0 normal 0 1 0 material "
                         "white }\nlight point { position 2 4 -3  intensity 20 }\n");
    fuzz_add_text(seeds, "# a\nlet a = (1 + 2) * sin(30) / max(2, 3) - pi\nlet v = [1, a, -2]\n"
                         "render { mode photon k all kernel cone spp 2 }\n"
                         "material glass { kt 1 ior 1.5 fresnel dielectric absorption .1 0 0 "
                         "priority 2 }\nrepeat i from 0 to 3 {\n  let x = i * 2\n"
                         "  sphere { centre x 0 v[1] radius 0.5 material glass }\n}\n"
                         "light spot { position 0 3 0 target v intensity 1 2 3 inner 10 outer 20 "
                         "}\n");
    fuzz_add_text(seeds, "include \"a.rts\"\ntexture t { kind image file \"t.png\" wrap mirror "
                         "scale 2 3 }\nmaterial m { kd_texture t bump_texture t bump_scale .1 }\n"
                         "mesh thing { file \"m.ply\" shading smooth material m }\n"
                         "instance thing { translate 1 2 3 rotate 0 1 0 90 scale 2 }\n"
                         "instance thing { matrix 1 0 0 0 0 1 0 0 0 0 1 0 }\n");
    fuzz_add_text(seeds, "texture c { kind checker a 1 0 0 b 0 0 1 }\ntexture g { kind gradient a "
                         "0 b 1 wrap clamp }\nmaterial e { kd .5 emission 3 two_sided true }\n"
                         "quad { corner 0 0 0 edge1 1 0 0 edge2 0 1 0 material e texture c }\n"
                         "disc { centre 0 0 0 normal 0 1 0 radius 1 inner_radius .5 material e }\n"
                         "cone { base 0 0 0 apex 0 1 0 radius 1 apex_radius .2 caps true material "
                         "e }\ntorus { centre 0 0 0 axis 0 1 0 major_radius 1 minor_radius .1 "
                         "material e power 5 }\n");
    fuzz_add_text(seeds, "light environment { file \"t.pfm\" radiance 2 rotation 30 }\n"
                         "light directional { direction 0 -1 0 irradiance 3 }\n"
                         "material m { kd 1 roughness .3 }\n"
                         "box { centre 0 0 0 size 1 2 3 material m rotate 0 1 0 30 }\n"
                         "cylinder { a 0 0 0 b 0 1 0 radius .5 material m }\n"
                         "ellipsoid { centre 3 0 0 radii 1 2 3 material m }\n"
                         "triangle { a 0 0 0 b 1 0 0 c 0 1 0 material m }\n"
                         "mesh { file \"m.obj\" material m }\n");
    fuzz_add_text(seeds, "include \"loop.rts\"\ninclude \"none.rts\"\n");
}

/* What the parser knows beside its tables. */
static const char *const statements[] = {
    "let ",      "include ",     "repeat ",   "from ",     "to ",       "pi",        "all",
    "\"a.rts\"", "\"loop.rts\"", "\"t.png\"", "\"t.ppm\"", "\"t.pfm\"", "\"t.exr\"", "\"m.ply\"",
    "\"m.obj\"", "\"m.off\"",    "\"m.stl\"", "1e999",     "1e-999",    "1e15",      "1e28",
    "0.5",       " { ",          " }\n",      " = ",       "[1, 2, 3]", "\n# ",      NULL};

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
    static const char part[] = "material a { kd 0.5 }\nlet n = 4\n",
                      loop[] = "include \"loop.rts\"";
    fuzz_write("a.rts", part, sizeof part - 1);
    fuzz_write("loop.rts", loop, sizeof loop - 1);
    fuzz_write_seed(&fuzz_target_ply, 1, "m.ply");
    fuzz_write_seed(&fuzz_target_obj, 1, "m.obj");
    fuzz_write_seed(&fuzz_target_off, 1, "m.off");
    fuzz_write_seed(&fuzz_target_stl, 0, "m.stl");
    fuzz_write_seed(&fuzz_target_png, 10, "t.png");
    fuzz_write_seed(&fuzz_target_ppm, 0, "t.ppm");
    fuzz_write_seed(&fuzz_target_pfm, 0, "t.pfm");
    fuzz_write_seed(&fuzz_target_exr, 0, "t.exr");
}

const fuzz_target fuzz_target_scene = {
    .name = "scene",
    .sources = "dsl/* lib/scene/* lib/setting/* lib/shape/* lib/texture/*",
    .run = run,
    .seed = seed,
    .words = words,
    .begin = begin,
    .size_max = 4096,
    .tries = 3000,
};
