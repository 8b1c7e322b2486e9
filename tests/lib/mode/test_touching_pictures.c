/*
 * test_touching_pictures.c - the picture of solids that touch is that of solids that overlap by 0.1
 * mm, where no faces coincide, block by block: in path and in photon mode, in both orders of the
 * file.
 *
 * Glass and water absorb different colours, so that a path that counts as in the wrong one shows.
 * Where the overlap would hide the boundary of the wrong solid, the priorities say which counts.
 */
#include "kernels/statistics.h"
#include "lib/image/scratch.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { side = 32, block = 8, across = side / block, blocks = across * across, renders = 24 };
enum { corners = 24, text_most = 4096 };

static const double pi = 3.14159265358979323846;

#define STAGE                                                                                      \
    "camera { eye 1.1 1.5 -2.3  look_at 0 0.55 0  fov 36 }\n"                                      \
    "light environment { radiance 0.6 }\n"                                                         \
    "light directional { direction 0.4 -1 0.3  irradiance 3 }\n"                                   \
    "material grey { kd 0.6 }\n"                                                                   \
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material grey }\n"                           \
    "material glass { kt 1  ior 1.5  fresnel dielectric  absorption 0.2 0.2 1.5 }\n"

#define WATER(priority)                                                                            \
    "material water { kt 1  ior 1.33  fresnel dielectric  absorption 2 0.5 0.1  "                  \
    "priority " priority " }\n"
#define AIR "material air { kt 1  ior 1  fresnel dielectric  priority 1 }\n"

/*
 * Solids that touch, and the same with an overlap, whose solids are then in that order. The lines
 * of `solids` are one solid each.
 */
static const struct pair {
    const char *name, *touching_media, *overlapping_media;
    const char *touching[3], *overlapping[3];
} pairs[] = {
    {"cylinder on cylinder",
     WATER("0"),
     WATER("1"),
     {"cylinder { a 0 0.1 0  b 0 0.6 0  radius 0.5  material glass }\n",
      "cylinder { a 0 0.6 0  b 0 1.1 0  radius 0.5  material water }\n"},
     {"cylinder { a 0 0.1 0  b 0 0.6 0  radius 0.5  material glass }\n",
      "cylinder { a 0 0.5999 0  b 0 1.1 0  radius 0.4999  material water }\n"}},
    {"box in box, which share the bottom and a side",
     WATER("1"),
     WATER("1"),
     {"box { centre 0 0.6 0  size 1 1 1  material glass }\n",
      "box { centre 0.2 0.4 0  size 0.6 0.6 0.6  material water }\n"},
     {"box { centre 0 0.6 0  size 1 1 1  material glass }\n",
      "box { centre 0.2 0.4 0  size 0.6002 0.6002 0.6  material water }\n"}},
    {"ball in ball of the same size",
     WATER("1"),
     WATER("1"),
     {"sphere { centre 0 0.6 0  radius 0.5  material glass }\n",
      "sphere { centre 0 0.6 0  radius 0.5  material water }\n"},
     {"sphere { centre 0 0.6 0  radius 0.5  material glass }\n",
      "sphere { centre 0 0.6 0  radius 0.5001  material water }\n"}},
    {"box in a mesh, of which it is the lower half",
     WATER("1"),
     WATER("1"),
     {"model { file \"cube.off\"  scale 0.5  translate 0 0.6 0  material glass }\n",
      "box { centre 0 0.35 0  size 1 0.5 1  material water }\n"},
     {"model { file \"cube.off\"  scale 0.5  translate 0 0.6 0  material glass }\n",
      "box { centre 0 0.35 0  size 1.0002 0.5002 1.0002  material water }\n"}},
    {"cup of a cylinder, with air and water in it",
     AIR WATER("2"),
     AIR WATER("2"),
     {"cylinder { a 0 0.1 0  b 0 1 0  radius 0.5  material glass }\n",
      "cylinder { a 0 0.2 0  b 0 1 0  radius 0.42  material air }\n",
      "cylinder { a 0 0.2 0  b 0 0.7 0  radius 0.42  material water }\n"},
     {"cylinder { a 0 0.1 0  b 0 1 0  radius 0.5  material glass }\n",
      "cylinder { a 0 0.2 0  b 0 1.0001 0  radius 0.42  material air }\n",
      "cylinder { a 0 0.1999 0  b 0 0.7 0  radius 0.4201  material water }\n"}},
    {"cup that is a mesh, with water that is one",
     WATER("0"),
     WATER("1"),
     {"model { file \"cup.off\"  material glass }\n",
      "model { file \"water.off\"  material water }\n"},
     {"model { file \"cup.off\"  material glass }\n",
      "model { file \"water_overlapping.off\"  material water }\n"}},
};
enum { pair_count = sizeof pairs / sizeof *pairs };

/* ---- Meshes -------------------------------------------------------------------------- */

/*
 * A solid of revolution with this profile from the axis round to the axis: radius and height of
 * each ring of corners; the first and the last have no radius.
 */
static void write_revolved(const char *name, const double (*profile)[2], int rings)
{
    char text[16384];
    int used = sprintf(text, "OFF\n%d %d 0\n", (rings - 2) * corners + 2, (rings - 1) * corners);
    used += sprintf(text + used, "0 %.9g 0\n", profile[0][1]);
    for (int r = 1; r < rings - 1; r++)
        for (int i = 0; i < corners; i++)
            used +=
                sprintf(text + used, "%.9g %.9g %.9g\n", profile[r][0] * cos(2 * pi * i / corners),
                        profile[r][1], profile[r][0] * sin(2 * pi * i / corners));
    used += sprintf(text + used, "0 %.9g 0\n", profile[rings - 1][1]);
    const int last = (rings - 2) * corners + 1;
    for (int r = 0; r < rings - 1; r++)
        for (int i = 0; i < corners; i++) {
            const int a = 1 + (r - 1) * corners + i, b = 1 + (r - 1) * corners + (i + 1) % corners;
            const int lower[2] = {a + corners, b + corners};
            if (r == 0)
                used += sprintf(text + used, "3 0 %d %d\n", lower[0], lower[1]);
            else if (r == rings - 2)
                used += sprintf(text + used, "3 %d %d %d\n", b, a, last);
            else
                used += sprintf(text + used, "4 %d %d %d %d\n", a, lower[0], lower[1], b);
        }
    assert_true((size_t)used < sizeof text);
    scratch_write(name, text);
}

static void write_meshes(void)
{
    static const double cup[][2] = {{0, 0.1},    {0.5, 0.1},  {0.5, 1}, {0.42, 1},
                                    {0.42, 0.7}, {0.42, 0.2}, {0, 0.2}};
    static const double water[][2] = {{0, 0.2}, {0.42, 0.2}, {0.42, 0.7}, {0, 0.7}};
    static const double overlapping[][2] = {{0, 0.1999}, {0.4201, 0.1999}, {0.4201, 0.7}, {0, 0.7}};
    scratch_write("cube.off", "OFF\n8 6 0\n"
                              "-1 -1 -1\n1 -1 -1\n-1 1 -1\n1 1 -1\n"
                              "-1 -1 1\n1 -1 1\n-1 1 1\n1 1 1\n"
                              "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n"
                              "4 0 4 6 2\n4 1 3 7 5\n");
    write_revolved("cup.off", cup, 7);
    write_revolved("water.off", water, 4);
    write_revolved("water_overlapping.off", overlapping, 4);
}

/* ---- Pictures ------------------------------------------------------------------------ */

static rt_renderer *open_solids(const char *media, const char *const solids[3], int reversed)
{
    char text[text_most];
    int used = sprintf(text, "%s%s", STAGE, media);
    for (int i = 0; i < 3; i++) {
        const char *solid = solids[reversed ? 2 - i : i];
        used += sprintf(text + used, "%s", solid ? solid : "");
    }
    return test_renderer(text);
}

/* The means of the channels of each block of several pictures, of different seeds. */
typedef struct pictures {
    double means[3 * blocks][renders];
} pictures;

static void add_picture(pictures *all, int index, const rt_film *film)
{
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++)
            for (int c = 0; c < 3; c++)
                all->means[3 * (y / block * across + x / block) + c][index] +=
                    rt_film_rgb(film)[3 * (y * side + x) + c] / (double)(block * block);
}

static void render(pictures *all, rt_renderer *renderer, rt_mode mode, uint32_t seed)
{
    memset(all, 0, sizeof *all);
    for (int i = 0; i < renders; i++) {
        rt_render_options options = {.width = side,
                                     .height = side,
                                     .mode = mode,
                                     .spp = mode == RT_MODE_PATH ? 8 : 1,
                                     .photons = 8000,
                                     .k = 40,
                                     .gather = RT_GATHER_DEVICE,
                                     .max_depth = 24,
                                     .seed = test_seed(seed + (uint32_t)i)};
        rt_film *film = NULL;
        rt_error error;
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        add_picture(all, i, film);
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

/* The blocks agree within 1 %, or by chance. */
static void expect_same(const pictures *a, const pictures *b, const char *what)
{
    for (int i = 0; i < 3 * blocks; i++) {
        double differences[renders], mean = 0;
        char name[128];
        for (int r = 0; r < renders; r++) {
            differences[r] = a->means[i][r] - b->means[i][r];
            mean += b->means[i][r] / renders;
        }
        snprintf(name, sizeof name, "%s, block %d, channel %d of %.3f", what, i / 3, i % 3, mean);
        expect_mean(differences, renders, 0, 0.01 * mean, name);
    }
}

static void expect_touching_as_overlapping(const struct pair *pair, rt_mode mode)
{
    pictures overlapping, touching;
    render(&overlapping, open_solids(pair->overlapping_media, pair->overlapping, 0), mode, 100);
    for (int reversed = 0; reversed < 2; reversed++) {
        char what[96];
        snprintf(what, sizeof what, "%s%s", pair->name, reversed ? ", reversed" : "");
        render(&touching, open_solids(pair->touching_media, pair->touching, reversed), mode,
               reversed ? 300 : 200);
        expect_same(&touching, &overlapping, what);
    }
}

static void paths_see_touching_solids_as_overlapping_ones(void **state)
{
    (void)state;
    for (int i = 0; i < pair_count; i++)
        expect_touching_as_overlapping(pairs + i, RT_MODE_PATH);
}

static void photons_see_touching_solids_as_overlapping_ones(void **state)
{
    (void)state;
    for (int i = 0; i < pair_count; i++)
        expect_touching_as_overlapping(pairs + i, RT_MODE_PHOTON);
}

/* ---- Emitters ------------------------------------------------------------------------ */

#define TURNED "rotate 1 2 3 37  translate 30 -20 50 }\n"
#define LAMP_BELOW_GLASS                                                                           \
    "camera { eye 29.7277 -19.4863 50.1483  look_at 29.5462 -19.1438 50.2471 up 0.364833 "         \
    "-0.0745428 0.928084  fov 60 }\n"                                                              \
    "material wall { kd 0.6 }\nmaterial lamp { emission 3 }\n"                                     \
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"                                       \
    "quad { corner -2 1 -2  edge1 4 0 0  edge2 0 0 4  material wall  " TURNED                      \
    "quad { corner -0.5 0.3 -0.5  edge1 0 0 1  edge2 1 0 0  material lamp  " TURNED                \
    "model { file \"cube.off\"  scale 2000 0.1 2000  translate 0 0.4 0  material glass  " TURNED

/*
 * Photons of a lamp start in the glass that lies on it, as paths that find the lamp end there: a
 * wall above looks the same, within the bias of the gather. The sheet of glass is 4 km wide, so
 * that its rounded corners are farther off than the lamp's own error.
 */
static void photons_start_in_the_glass_that_touches_their_lamp(void **state)
{
    pictures paths, photons;
    double differences[renders], mean = 0;
    (void)state;
    render(&paths, test_renderer(LAMP_BELOW_GLASS), RT_MODE_PATH, 400);
    render(&photons, test_renderer(LAMP_BELOW_GLASS), RT_MODE_PHOTON, 500);
    for (int r = 0; r < renders; r++) {
        differences[r] = 0;
        for (int i = 0; i < 3 * blocks; i++) {
            differences[r] += (photons.means[i][r] - paths.means[i][r]) / (3 * blocks);
            mean += paths.means[i][r] / (3 * blocks * renders);
        }
    }
    assert_true(mean > 0.1);
    expect_mean(differences, renders, 0, 0.02 * mean, "a wall above a lamp below glass");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(paths_see_touching_solids_as_overlapping_ones),
        statistical_test(photons_see_touching_solids_as_overlapping_ones),
        statistical_test(photons_start_in_the_glass_that_touches_their_lamp),
    };
    void *scratch = NULL;
    if (scratch_enter(&scratch) != 0)
        return 1;
    write_meshes();
    int failed = cmocka_run_group_tests_name("lib/mode/touching_pictures", tests, NULL, NULL);
    return scratch_leave(&scratch) != 0 || failed != 0;
}
