/*
 * target_fmt.c - scene texts laid out: twice is as once, with the tokens of the text, which is read
 * as before or refused as before.
 */
#include <stdlib.h>
#include <string.h>

#include "dsl/lexer.h"
#include "fuzz/scene_text.h"
#include "fuzz/targets.h"

/* A text that a lexer reads. */
typedef struct lexed {
    rt_source source;
    rt_reports reports;
    rt_lexer lexer;
    uint64_t order;
} lexed;

static void begin(lexed *out, char *text)
{
    memset(out, 0, sizeof *out);
    out->source.path = "fuzz.rts";
    out->source.text = text;
    out->source.size = strlen(text);
    rt_lexer_begin(&out->lexer, &out->source, &out->reports, &out->order);
}

static void check_tokens(char *before, char *after)
{
    lexed a, b;
    rt_token s, t;
    begin(&a, before);
    begin(&b, after);
    do {
        rt_lexer_next(&a.lexer, &s);
        rt_lexer_next(&b.lexer, &t);
        FUZZ_EXPECT(s.kind == t.kind && s.place.length == t.place.length);
        FUZZ_EXPECT(
            memcmp(before + s.place.offset, after + t.place.offset, (size_t)s.place.length) == 0);
    } while (s.kind != RT_TOKEN_END);
    rt_reports_free(&a.reports);
    rt_reports_free(&b.reports);
}

/* Whether a text is read, and how many shapes it has. */
static uint64_t shapes_of(const char *text)
{
    const rt_load_options options = {.root = "."};
    rt_scene *scene = NULL;
    rt_scene_info info;
    if (rt_scene_parse(&scene, text, "fuzz.rts", &options, NULL) != RT_OK)
        return UINT64_MAX;
    rt_scene_get_info(scene, &info);
    rt_scene_destroy(scene);
    return info.shapes;
}

static int run(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1), *made = fuzz_untouched, *again = NULL;
    rt_error error;
    FUZZ_EXPECT(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    rt_status status = rt_scene_format(&made, text, "fuzz.rts", NULL, &error);
    int is_good = fuzz_expect_answer(status, &error, made);
    if (is_good) {
        check_tokens(text, made);
        FUZZ_EXPECT(rt_scene_format(&again, made, "fuzz.rts", NULL, &error) == RT_OK);
        FUZZ_EXPECT(strcmp(made, again) == 0);
        FUZZ_EXPECT(shapes_of(text) == shapes_of(made));
        free(made);
    }
    free(again);
    free(text);
    return is_good;
}

static void seed(fuzz_inputs *seeds)
{
    fuzz_add_text(seeds, "# a\nlet a=1 # b\nlet bc = 2*( a+-1 )\n\n\nfilm {width 4 height 5}\n"
                         "camera{ eye 0 1 -4 look_at 0 (1-a) 0 fov 40 }\n"
                         "render { mode direct kernel gaussian-jensen k all }\n"
                         "material m { kd 0.5 0.4 [0 1 -1] }\n"
                         "repeat i from 0 to (bc - 1) { sphere {\ncentre cos( 60*i ) 0 -1\n"
                         "radius 1 material m } }\nlight point { position 0 3 0 intensity 1 }\n");
    fuzz_add_text(seeds,
                  "include \"a.rts\"\r\nmodel { file \"a-mesh-with-a-long-name-to-break.ply\" "
                  "material white scale 2 translate 1 2 3 rotate 0 1 0 45 } # far\n"
                  "mesh k { file \"k.ply\" }\ninstance k { matrix 1 0 0 0\n0 1 0 0\n"
                  "0 0 1 0 }\n");
}

const fuzz_target fuzz_target_fmt = {
    .name = "fmt",
    .sources = "dsl/format.c dsl/format_line.c",
    .run = run,
    .seed = seed,
    .size_max = 4096,
    .tries = 3000,
};
