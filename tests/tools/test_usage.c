/* test_usage.c - the command line of rtc: what it takes, what it refuses, and what it says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "rt.h"
#include "spawn.h"

static const char scene[] = "camera { eye 0 0 -4  look_at 0 0 0 }\n"
                            "film { width 8  height 8 }\n"
                            "material white { kd 0.7 }\n"
                            "sphere { centre 0 0 0  radius 1  material white }\n"
                            "light point { position 2 4 -3  intensity 20 }\n";

/* ---- Refusals -------------------------------------------------------------- */

static const struct {
    const char *line, *says;
} refusals[] = {
    {"", "which scene?"},
    {"a.rts b.rts", "one scene at a time: 'a.rts' and 'b.rts'"},
    {"rendr a.rts", "there is no command 'rendr', and no scene"},
    {"chekc a.rts", "did you mean `rtc check`?"},
    {"render a.rts", "rendering has no command word: rtc SCENE"},
    {"a.rts --samples 16", "did you mean --spp?"},
    {"a.rts --kernel gauss", "did you mean gaussian?"},
    {"merge m.rtp n.rtp", "`rtc photons merge` joins photon maps"},
    {"merge --out a.exr", "usage: rtc merge FILM.rtpart"},
    {"info", "usage: rtc info FILE..."},
    {"merge a.rts a.rts --out a.pfm", "a.rts is given twice"},
    {"a.rts --preview foo", "--preview takes page, open or tev"},
    {"a.rts --mode photon --k all", "--radius R gives it"},
    {"a.rts --part 1/2 --out a.png", "goes to a film called NAME.rtpart"},
    {"a.rts --part 0/2", "there is no part 0 of 2"},
    {"a.rts --part 1/99999999999", "there are 4294967295 parts at most"},
    {"a.rts --part 2", "--part takes the number of a part and of all parts"},
    {"compare a.exr b.exr --out c.rtpart", "a difference is an image, no film"},
    {"a.rts --spp", "--spp needs a value"},
    {"a.rts --spp=", "--spp needs a value"},
    {"a.rts --mode --spp 3", "--mode needs a value"},
    {"a.rts --spp 0", "--spp takes a whole number from 1 to 16777216"},
    {"a.rts --spp -3", "not '-3'"},
    {"a.rts --spp 2.5", "not '2.5'"},
    {"a.rts --spp 3x", "not '3x'"},
    {"a.rts --spp 0x10", "not '0x10'"},
    {"a.rts --spp 1e10", "not '1e10'"},
    {"a.rts --spp 1e400", "not '1e400'"},
    {"a.rts --seed 4294967296", "not '4294967296'"},
    {"a.rts --photons 1.5e0", "not '1.5e0'"},
    {"a.rts --time nan", "--time takes a number"},
    {"a.rts --time inf", "--time takes a number"},
    {"a.rts --time -1", "--time takes a number"},
    {"a.rts --radius -0.5", "--radius takes a number from 1e-15 to 1e+15, or 0"},
    {"a.rts --radius 1e-999", "not '1e-999'"},
    {"a.rts --radius -0.1e-60", "not '-0.1e-60'"},
    {"a.rts --mode photon --radius 1e-20",
     "--radius takes a number from 1e-15 to 1e+15, or 0; not '1e-20'"},
    {"a.rts --photons 4000000001", "--photons takes a whole number from 1 to 4000000000"},
    {"a.rts --cone-k 0.9", "--cone-k takes a number from 1 to 1000000"},
    {"a.rts --mode photon --passes 2 --alpha 0",
     "--alpha takes a number between 0 and 1, both excluded; not '0'"},
    {"a.rts --mode photon --passes 2 --alpha 1",
     "--alpha takes a number between 0 and 1, both excluded; not '1'"},
    {"a.rts --mode photon --passes 2 --alpha 0.9999999999",
     "--alpha takes a number between 0 and 1, both excluded; not '0.9999999999'"},
    {"a.rts --memory 4x", "--memory takes a number of bytes, as in 800M or 4G; not '4x'"},
    {"a.rts --memory 0", "not '0'"},
    {"check a.rts --memory -1G", "not '-1G'"},
    {"check a.rts --memory 1e30T", "not '1e30T'"},
    {"photons info a.rtp --memory G", "not 'G'"},
    {"a.rts --exposure ++1", "--exposure takes a number"},
    {"a.rts --exposure 1000", "--exposure takes a number"},
    {"a.rts --mode paht", "did you mean path?"},
    {"a.rts --mode pathtrace", "did you mean path?"},
    {"a.rts --kernel gausian", "did you mean gaussian?"},
    {"a.rts --kernel q",
     "--kernel takes epanechnikov, box, cone, gaussian, silverman or gaussian-jensen; not 'q'"},
    {"a.rts --sampler halton", "--sampler takes sobol or independent"},
    {"a.rts --direct no", "--direct takes nee or photons"},
    {"a.rts --accel kd", "--accel takes bvh or none"},
    {"a.rts --tonemap filmic", "--tonemap takes none, reinhard or aces"},
    {"a.rts --progress yes", "--progress takes auto, plain, json or none"},
    {"a.rts --stats=1", "--stats takes no value"},
    {"a.rts --profile", "--profile"},
    {"a.rts --profile a.rts", "--profile a.rts: it goes to a file called NAME.json"},
    {"photons a.rts --out m.rtp --profile .json", "called NAME.json"},
    {"a.rts --max_depth 3", "did you mean --max-depth?"},
    {"a.rts --mdoe path", "did you mean --mode?"},
    {"a.rts --photn 3", "did you mean --photons?"},
    {"a.rts --frobnicate", "unknown option '--frobnicate'"},
    {"help frobnicate", "there is no command 'frobnicate'"},
    {"help photon", "did you mean photons?"},
    {"help export", "did you mean `rtc photons export --help`?"},
    {"photons exprot n.rtp --out n.ply", "did you mean `rtc photons export`?"},
    {"photons inof", "did you mean `rtc photons info`?"},
    {"a.rts --sp 3", "did you mean --spp?"},
    {"a.rts -s 3", "unknown option '-s'"},
    {"a.rts -o a.png", "did you mean --out?"},
    {"a.rts --verbose --quiet", "exclude each other"},
    {"a.rts --out a.jpg", "the extension tells the format"},
    {"a.rts --out a.exrr", "did you mean .exr?"},
    {"a.rts --out noextension", "the extension tells the format"},
    {"a.rts --out a.png --out a.png", "--out a.png is given twice"},
    {"a.rts --out a.png --out ./a.png", "--out ./a.png is given twice"},
    {"a.rts --out .exr", "--out .exr: the extension tells the format"},
    {"photons a.rts --out .rtp", "called NAME.rtp"},
    {"mesh sphere --out .ply", "--out .ply: a mesh is written as .ply"},
    {"photons info m.rtp --verbose", "`rtc photons info` takes no option --verbose"},
    {"a.rts --mode photon --area hull --k 4", "--k: area hull needs k of at least 5"},
    {"a.rts --mode photon --k 1", "--k takes a whole number from 2 to 65536"},
    {"a.rts --width 65537", "--width takes a whole number from 1 to 65536"},
    {"a.rts --width 65536 --height 65536", "--height: a film of"},
    {"a.rts --max-depth 1e6", "--max-depth takes a whole number from 1 to 4096"},
    {"a.rts --roulette-depth 5000", "--roulette-depth takes a whole number"},
    {"a.rts --roulette-threshold 0", "--roulette-threshold takes a number"},
    {"a.rts --roulette-threshold 1.5", "--roulette-threshold takes a number"},
    {"a.rts --work-group 1e6", "--work-group: "},
    {"check", "which scene?"},
    {"check a.rts --spp 3", "`rtc check` takes no option --spp"},
    {"check a.rts --mode photon", "hint: a scene is checked with the settings of its own film"},
    {"devices --spp 3", "`rtc devices` takes no option --spp"},
    {"devices a.rts", "takes no argument"},
    {"doctor a.rts", "takes no argument but options"},
    {"a.rts --no-stats", "unknown option '--no-stats'"},
    {"a.rts --no-aov=1", "--aov takes no value"},
    {"check --help=yes", "--help takes no value"},
    {"a.rts --caustic-k 1", "--caustic-k takes a whole number from 2 to 65536"},
    {"a.rts --caustic-kernel q", "--caustic-kernel takes epanechnikov, box"},
    {"check a.rts --part 1/2", "takes no option --part"},
    {"photons", "usage: rtc photons"},
    {"photons a.rts", "--out FILE"},
    {"photons help", "try `rtc help photons`"},
    {"photons a.rts b.rts --out m.rtp", "usage: rtc photons"},
    {"photons a.rts --out m.rtp --out n.rtp", "--out FILE"},
    {"photons a.rts --out m.rtp --part 0/2",
     "--part 0/2: there is no part 0 of 2; they are counted from 1"},
    {"photons a.rts --out m.rtp --part 3/2", "--part 3/2: there is no part 3 of 2"},
    {"photons a.rts --out m.rtp --part 0/0", "--part takes"},
    {"photons a.rts --out m.rtp --part 1", "--part takes"},
    {"photons a.rts --out m.rtp --part 1/x", "--part takes"},
    {"a.rts --resolution 640x480", "did you mean --width W and --height H?"},
    {"a.rts --size=640", "did you mean --width W and --height H?"},
    {"a.rts --fov 40", "'camera { ... fov (fov) }', make it a constant, for --set fov=VALUE"},
    {"a.rts --focal-distance 4", "unknown option '--focal-distance'"},
    {"a.rts --widht 40", "did you mean --width?"},
    {"a.rts --gpu", "did you mean --device?"},
    {"a.rts --max-bounces 4", "did you mean --max-depth?"},
    {"a.rts --set radius", "--set takes NAME=VALUE; not 'radius'"},
    {"a.rts --set =3", "--set takes NAME=VALUE; not '=3'"},
    {"a.rts --set radius=", "--set takes NAME=VALUE; not 'radius='"},
    {"photons a.rts --out m.rtp --light-shares 1,,2",
     "--light-shares takes a number from 0 to 1e+15 for each light, with commas between them, as "
     "in 1,0.5,2; not "
     "'1,,2'"},
    {"a.rts --mode photon --light-shares 1,2e15", "--light-shares takes"},
    {"a.rts --mode photon --light-shares 1,2", "--light-shares: 2 shares for a scene of 1 light"},
    {"photons a.rts --out m.rtp --light-shares 1,-2", "--light-shares takes"},
    {"photons a.rts --out m.rtp --light-shares 1,2",
     "--light-shares: 2 shares for a scene of 1 light"},
    {"photons a.rts --out m.rtp --k 5", "`rtc photons` takes no option --k"},
    {"photons a.rts --out m.rtp --max-depth 1e6",
     "--max-depth takes a whole number from 1 to 4096"},
    {"photons info", "usage: rtc photons info"},
    {"photons illuminance m.rtp", "usage: rtc photons illuminance MAP POINTS"},
    {"photons illuminance m.rtp p.txt --seed 3",
     "`rtc photons illuminance` takes no option --seed"},
    {"photons a.rts --k 3 --out m.rtp", "`rtc photons` takes no option --k"},
    {"photons info m.rtp --seed 3", "`rtc photons info` takes no option --seed"},
    {"photons info m.rtp --out a", "`rtc photons info` takes no option --out"},
    {"photons merge --out m.rtp", "usage: rtc photons merge"},
    {"photons merge a.rtp", "--out FILE"},
    {"photons diff a.rtp", "usage: rtc photons diff"},
    {"photons a.rts --out m.png", "--out m.png: the photon map goes to a file called NAME.rtp"},
    {"photons a.rts --out a.rts", "called NAME.rtp"},
    {"photons merge a.rtp --out m", "called NAME.rtp"},
    {"photons export a.rtp --out a.rtp", "called NAME.ply"},
    {"photons export a.rtp b.rtp --out c.ply", "usage: rtc photons export"},
};

static void wrong_usage_is_refused_with_status_2(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++) {
        run run = run_rtc("%s", refusals[i].line);
        expect_status(&run, 2);
        expect_err(&run, "rtc: error: ");
        expect_err(&run, refusals[i].says);
        assert_string_equal(run.out, "");
        run_free(&run);
    }
    /* Nothing was rendered. */
    assert_int_equal(scratch_count(), 1);
}

/* A scene that is not there may be a mistyped subcommand; one that is there is wrong itself. */
static void a_mistyped_subcommand_gets_a_hint(void **state)
{
    (void)state;
    run device = run_rtc("device");
    expect_status(&device, 1);
    expect_err(&device, "hint: did you mean `rtc devices`?");
    run_free(&device);
    scratch_write("device", "nonsense");
    run scene = run_rtc("device");
    expect_status(&scene, 1);
    expect_no_err(&scene, "devices");
    run_free(&scene);
}

static void several_mistakes_are_all_told(void **state)
{
    (void)state;
    run run = run_rtc("a.rts --spp x --kernel y --bogus");
    expect_status(&run, 2);
    expect_err(&run, "--spp takes");
    expect_err(&run, "--kernel takes");
    expect_err(&run, "unknown option '--bogus'");
    run_free(&run);
}

/* Not by its own name, nor by a link, and whoever names it: nothing that is read is overwritten. */
static void outputs_spare_what_is_read(void **state)
{
    static const struct {
        const char *line, *output;
    } cases[] = {
        {"b.rts --spp 1", "wood.ppm"}, /* a texture */
        {"b.rts --spp 1", "link.ppm"},
        {"b.rts --spp 1 --out c.pfm", "part.ppm"}, /* an included text */
        {"b.rts --spp 1", "a.pfm"},                /* the scene itself */
        {"compare wood.ppm wood.ppm", "wood.ppm"},
        {"compare wood.ppm wood.ppm", "link.ppm"},
        {"photons b.rts --photons 10", "m.rtp"},
        {"photons merge n.rtp", "n.rtp"},
        {"photons export n.rtp", "n.ply"},
        {"b.rts --spp 1 --photon-map n.rtp", "n.pfm"},
    };
    (void)state;
    scratch_write("wood.ppm", "P3 1 1 255 9 9 9\n");
    scratch_write("part.ppm", "texture wood { file \"wood.ppm\" }\n");
    scratch_write(
        "b.rts",
        "include \"part.ppm\"\n"
        "camera { eye 0 0 -4  look_at 0 0 0 }\nfilm { width 8  height 8 }\n"
        "material white { kd_texture wood }\nsphere { centre 0 0 0  radius 1  material white }\n"
        "light point { position 2 4 -3  intensity 20 }\n");
    assert_int_equal(symlink("wood.ppm", "link.ppm"), 0);
    assert_int_equal(link("b.rts", "a.pfm"), 0);
    run made = run_rtc("photons b.rts --photons 10 --out n.rtp");
    expect_status(&made, 0);
    run_free(&made);
    assert_int_equal(link("n.rtp", "n.ply"), 0);
    assert_int_equal(link("n.rtp", "n.pfm"), 0);
    assert_int_equal(symlink("b.rts", "m.rtp"), 0);
    size_t files = scratch_count();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char says[64];
        snprintf(says, sizeof says, "--out %s: this command reads that file", cases[i].output);
        run run = run_rtc("%s --out %s", cases[i].line, cases[i].output);
        expect_status(&run, 2);
        expect_err(&run, says);
        run_free(&run);
    }
    assert_int_equal(scratch_count(), files);
    /* What is not read may be replaced. */
    run first = run_rtc("b.rts --spp 1 --quiet --out c.pfm"),
        again = run_rtc("b.rts --spp 1 --quiet --out c.pfm");
    expect_status(&first, 0);
    expect_status(&again, 0);
    run_free(&first);
    run_free(&again);
}

/*
 * Options that are good alone may not go together; what is at fault is called by the name that was
 * typed.
 */
static void typed_options_are_named_when_the_scene_disagrees(void **state)
{
    static const struct {
        const char *render, *options, *says;
    } cases[] = {
        {"mode photon area hull", "--passes 4",
         "--passes does not go with the scene's area: the hull is"},
        {"mode photon passes 4", "--area hull", "--area: the hull is"},
        {"mode photon", "--k all", "--k: to gather all photons within a radius, give the radius"},
        {"mode photon k all radius 1", "--radius 0",
         "--radius does not go with the scene's k: to gather"},
        {"mode photon gather flann", "--passes 4",
         "--passes does not go with the scene's gather: FLANN"},
        {"target_error 0.1", "--spp 1",
         "--spp does not go with the scene's target_error: one sample"},
        {"", "--mode photon --variance", "--variance: the samples of one photon map"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%srender { %s }\n", scene, cases[i].render);
        scratch_write("a.rts", text);
        run run = run_rtc("a.rts %s --out a.pfm", cases[i].options);
        expect_status(&run, 2);
        expect_err(&run, cases[i].says);
        expect_no_file("a.pfm");
        run_free(&run);
    }
}

/* A file of another kind is called what it is, whether it is there or not. */
static void what_is_no_scene_is_named(void **state)
{
    static const struct {
        const char *line, *says;
    } cases[] = {
        {"a.png", "a.png is a picture, not a scene (.rts .xml .pbrt .gltf .glb .obj .ply .stl"},
        {"a.blend", "export it as glTF (a.blend as NAME.glb): `rtc NAME.glb` renders that"},
        {"a.rtpart", "rtc --resume a.rtpart"},
        {"a.rtp", "--photon-map a.rtp"},
        {"info a.pfm", "reads films (.rtpart) and photon maps (.rtp)"},
        {"n.rts --spp 1", "no camera, such as camera { eye"},
    };
    (void)state;
    scratch_write("a.pfm", "P3 1 1 255 9 9 9\n");
    scratch_write("n.rts", strchr(scene, '\n') + 1);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        run run = run_rtc("%s", cases[i].line);
        expect_status(&run, 1);
        expect_err(&run, cases[i].says);
        expect_no_err(&run, "warning: the scene has no camera");
        run_free(&run);
    }
    run run = run_rtc("help paths");
    assert_null(strstr(run.out, "normals:"));
    run_free(&run);
    run = run_rtc("help study");
    expect_out(&run, "where the page goes");
    run_free(&run);
}

/* ---- What is accepted ------------------------------------------------------- */

static void both_forms_of_an_option_are_the_same(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run a = run_rtc("a.rts --spp 3 --stats --out a.pfm");
    run b = run_rtc("a.rts --spp=3 --stats --out=b.pfm");
    expect_status(&a, 0);
    expect_status(&b, 0);
    assert_true(stats_number(&a, "samples a pixel") == 3.0);
    expect_same_files("a.pfm", "b.pfm");
    run_free(&a);
    run_free(&b);
}

/* What the scene turns on the command line can turn off. */
static void switches_of_the_scene_are_taken_back(void **state)
{
    char text[1024];
    (void)state;
    snprintf(text, sizeof text, "%srender { variance true  aov true }\n", scene);
    scratch_write("a.rts", text);
    run refused = run_rtc("a.rts --mode normals --out a.exr");
    expect_status(&refused, 2);
    expect_err(&refused, "--mode does not go with the scene's variance: ");
    expect_err(&refused, "hint: --no-variance");
    run_free(&refused);

    run plain = run_rtc("a.rts --spp 4 --no-variance --no-aov --out plain.exr");
    run layers = run_rtc("a.rts --spp 4 --no-variance --no-aov --aov --out layers.exr");
    run normals = run_rtc("a.rts --spp 4 --no-variance --mode normals --out normals.exr");
    expect_status(&plain, 0);
    expect_no_err(&plain, "relative error");
    expect_status(&layers, 0);
    expect_different_files("plain.exr", "layers.exr");
    expect_status(&normals, 0);
    run_free(&plain);
    run_free(&layers);
    run_free(&normals);
}

static void last_of_a_repeated_option_counts(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("a.rts --spp 9 --spp 2 --stats --out a.pfm");
    expect_status(&run, 0);
    assert_true(stats_number(&run, "samples a pixel") == 2.0);
    run_free(&run);
}

static void two_dashes_end_the_options(void **state)
{
    (void)state;
    scratch_write("--spp.rts", scene);
    run run = run_rtc("--spp 1 --out a.pfm -- --spp.rts");
    expect_status(&run, 0);
    expect_file("a.pfm");
    run_free(&run);
}

static void negative_value_is_a_value(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("a.rts --spp 1 --exposure -1 --out a.png");
    expect_status(&run, 0);
    run_free(&run);
}

/* ---- Help, version, and the small commands ---------------------------------- */

/* Every option of the specification is there, and no line is wider than a terminal. */
static void help_describes_every_option(void **state)
{
    (void)state;
    static const char *const options[] = {
        "--mode ",    "--spp ",    "--max-depth ", "--photons ",      "--k ",        "--kernel ",
        "--cone-k ",  "--radius ", "--direct ",    "--final-gather ", "--accel ",    "--sampler ",
        "--width ",   "--height ", "--seed ",      "--time ",         "--out ",      "--exposure ",
        "--tonemap ", "--device ", "--threads ",   "--work-group ",   "--progress ", "--stats",
        "--verbose",  "--quiet",   "--help",       "--version"};
    run run = run_rtc("--help");
    expect_status(&run, 0);
    assert_string_equal(run.err, "");
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        char entry[64];
        snprintf(entry, sizeof entry, "\n  %s", options[i]);
        expect_out(&run, entry);
    }
    expect_out(&run, "Exit status: 0 done");
    for (const char *line = run.out; *line; line += strcspn(line, "\n") + 1)
        assert_true(strcspn(line, "\n") <= 80);
    run_free(&run);
}

static void each_command_has_its_help(void **state)
{
    (void)state;
    static const char *const commands[] = {"check",   "mesh",    "devices", "doctor",
                                           "photons", "compare", "kernels"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        char usage[64];
        snprintf(usage, sizeof usage, "usage: rtc %s", commands[i]);
        run run = run_rtc("%s --help", commands[i]), same = run_rtc("help %s", commands[i]),
            option = run_rtc("--help %s", commands[i]);
        expect_status(&run, 0);
        expect_out(&run, usage);
        assert_string_equal(run.out, same.out);
        assert_string_equal(run.out, option.out);
        run_free(&run);
        run_free(&same);
        run_free(&option);
    }
}

/* A form of `rtc photons` tells its own usage and the options that it takes, and no others. */
static void each_form_of_photons_has_its_help(void **state)
{
    static const struct {
        const char *form, *usage;
        int writes;
        const char *says;
    } cases[] = {{"info", "usage: rtc photons info MAP...\n", 0, "print what each map holds"},
                 {"merge", "usage: rtc photons merge MAP... --out MAP.rtp\n", 1,
                  "where the merged map goes; its name ends in .rtp"},
                 {"diff", "usage: rtc photons diff MAP MAP\n", 0, "print how the maps differ"},
                 {"export", "usage: rtc photons export MAP --out FILE.ply\n", 1,
                  "where the points go; its name ends in .ply"},
                 {"illuminance", "usage: rtc photons illuminance MAP POINTS [OPTION]...\n", 0,
                  "\n  --volume-radius X "}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        run run = run_rtc("help photons %s", cases[i].form),
            same = run_rtc("photons %s --help", cases[i].form);
        expect_status(&run, 0);
        assert_string_equal(run.out, same.out);
        assert_memory_equal(run.out, cases[i].usage, strlen(cases[i].usage));
        assert_int_equal(strstr(run.out, "\n  --out ") != NULL, cases[i].writes);
        expect_out(&run, "\n  --quiet ");
        expect_out(&run, cases[i].says);
        assert_null(strstr(run.out, "--photons"));
        assert_null(strstr(run.out, "--stats"));
        assert_null(strstr(run.out, "--progress"));
        assert_null(strstr(run.out, "--device"));
        for (const char *line = run.out; *line; line += strcspn(line, "\n") + 1)
            assert_true(strcspn(line, "\n") <= 80);
        run_free(&run);
        run_free(&same);
    }
}

static void the_name_of_a_photon_map_is_told(void **state)
{
    (void)state;
    run run = run_rtc("help photons");
    expect_out(&run, "The name of a map that is written must end in .rtp.");
    expect_out(&run, "where the map goes; its name ends in .rtp");
    run_free(&run);
}

static void version_is_told(void **state)
{
    (void)state;
    run run = run_rtc("--version");
    expect_status(&run, 0);
    assert_string_equal(run.out, "rtc 0.1.0\n");
    run_free(&run);
}

static void devices_are_listed(void **state)
{
    (void)state;
    run run = run_rtc("devices");
    expect_status(&run, 0);
    assert_memory_equal(run.out, "0  ", 3);
    expect_out(&run, "compute unit");
    run_free(&run);
}

static void doctor_finds_all_well(void **state)
{
    (void)state;
    run run = run_rtc("doctor");
    expect_status(&run, 0);
    expect_out(&run, "ok    path mode renders");
    expect_out(&run, "ok    photon mode renders");
    expect_out(&run, "all checks passed\n");
    run_free(&run);
}

static void check_counts_what_a_scene_holds(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("check a.rts");
    expect_status(&run, 0);
    assert_string_equal(run.out, "a.rts: ok: 1 shape, 0 triangles, 1 material, 1 light\n");
    run_free(&run);
}

/* A pipe that none writes to would make rtc wait without end. */
static void scenes_name_regular_files_only(void **state)
{
    static const char *const texts[] = {"include \"pipe\"\n", "texture t { file \"pipe\" }\n",
                                        "light environment { file \"pipe\" }\n",
                                        "mesh m { file \"pipe\" }\n"};
    (void)state;
    assert_int_equal(mkfifo("pipe", 0600), 0);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        scratch_write("b.rts", texts[i]);
        run run = run_rtc("check b.rts");
        expect_status(&run, 1);
        expect_err(&run, "b.rts:");
        expect_err(&run, "it is not a regular file");
        run_free(&run);
    }
}

static void only_the_first_errors_are_printed(void **state)
{
    char text[1024] = "";
    (void)state;
    for (int i = 0; i < 33; i++)
        strcat(text, "material { }\n");
    scratch_write("a.rts", text);
    run run = run_rtc("check a.rts");
    expect_status(&run, 1);
    expect_err(&run, "a.rts:20:1: error: ");
    expect_no_err(&run, "a.rts:21:1: error: ");
    expect_err(&run, "a.rts: and 13 more errors\n");
    run_free(&run);
}

static void check_of_several_scenes_goes_on_after_a_bad_one(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    scratch_write("b.rts", "bad { }\n");
    run run = run_rtc("check b.rts a.rts");
    expect_status(&run, 1);
    expect_err(&run, "b.rts:1:1: error: ");
    expect_out(&run, "a.rts: ok");
    run_free(&run);
}

/* ---- Without OpenCL, and other failures --------------------------------------- */

static void no_platform_is_status_3_and_says_what_to_install(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    static const char *const lines[] = {"a.rts", "devices", "doctor"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        run run = run_rtc("OCL_ICD_VENDORS=/nonexistent rtc %s", lines[i]);
        expect_status(&run, 3);
        assert_true(strstr(run.err, "pocl-opencl-icd") || strstr(run.out, "pocl-opencl-icd"));
        run_free(&run);
    }
    assert_int_equal(scratch_count(), 1);
}

/*
 * Each setting of rt.h has its entry in the help, with its default, and refuses what it does not
 * take in the words of the table.
 */
static void each_setting_is_an_option(void **state)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    (void)state;
    run help = run_rtc("--help");
    for (size_t i = 0; i < count; i++) {
        char entry[64], says[512], phrase[192];
        const rt_setting *setting = &settings[i];
        int is_switch = setting->field.type == RT_FIELD_BOOLEAN;
        snprintf(entry, sizeof entry, "\n  --%s ", setting->field.name);
        for (char *c = entry; *c; c++)
            *c = *c == '_' ? '-' : *c;
        expect_out(&help, entry);
        if (is_switch)
            continue;
        entry[strlen(entry) - 1] = '\0';
        run run = run_rtc("a.rts %s ?", entry + 3);
        rt_setting_phrase(phrase, sizeof phrase, setting);
        snprintf(says, sizeof says, "%s takes %s; not '?'", entry + 3, phrase);
        expect_status(&run, 2);
        expect_err(&run, says);
        run_free(&run);
    }
    run_free(&help);
}

static void check_needs_no_device(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("OCL_ICD_VENDORS=/nonexistent rtc check a.rts");
    expect_status(&run, 0);
    run_free(&run);
}

static void unknown_device_is_status_3(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("a.rts --device nosuchdevice");
    expect_status(&run, 3);
    expect_err(&run, "nosuchdevice");
    expect_err(&run, "`rtc devices` lists them");
    run_free(&run);
}

/* In every command that takes it; the largest of several forms of one size is enough. */
static void memory_is_limited_with_status_3(void **state)
{
    static const char *const commands[] = {"check a.rts", "a.rts --spp 1 --out a.pfm",
                                           "photons a.rts --photons 1000 --out a.rtp",
                                           "photons info b.rtp", "a.rts --photon-map b.rtp"},
                             *const enough[] = {"400M", "400mb", "0.4GiB", "4e8"};
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc("photons a.rts --photons 1000 --out b.rtp");
    expect_status(&run, 0);
    run_free(&run);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        run = run_rtc("%s --memory 100", commands[i]);
        expect_status(&run, 3);
        expect_err(&run, " needs ");
        expect_err(&run, ", more than the limit of 100 bytes");
        run_free(&run);
    }
    for (size_t i = 0; i < sizeof enough / sizeof *enough; i++) {
        run = run_rtc("%s --memory %s", commands[i], enough[i]);
        expect_status(&run, 0);
        run_free(&run);
    }
    run = run_rtc_input(scene, strlen(scene), "check - --memory 100");
    expect_status(&run, 3);
    run_free(&run);
}

static void full_stdout_is_status_4(void **state)
{
    (void)state;
    static const char *const lines[] = {"--version", "--help", "devices"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        run run = run_rtc_to("/dev/full", "%s", lines[i]);
        expect_status(&run, 4);
        expect_err(&run, "cannot write to stdout");
        run_free(&run);
    }
}

/* A name may hold any bytes. */
static void names_are_told_without_harm(void **state)
{
    (void)state;
    scratch_write("\xff\x1b\xc2\x9b.rts", scene);
    run run = run_rtc_terminal("check \xff\x1b\xc2\x9b.rts");
    expect_status(&run, 0);
    expect_out(&run, "????.rts: ok: 1 shape");
    run_free(&run);
    run = run_rtc("check \xff\x1b\xc2\x9b.rts");
    expect_out(&run, "\xff\x1b\xc2\x9b.rts: ok: 1 shape");
    run_free(&run);
    run = run_rtc("check --json \xff\x1b\xc2\x9b.rts");
    expect_status(&run, 0);
    expect_out(&run, "{\"scene\":\"\\ufffd\\u001b\\u009b.rts\",\"ok\":true");
    run_free(&run);
    scratch_write("\xc3\xa4.rts", scene);
    run = run_rtc("check --json \xc3\xa4.rts");
    expect_out(&run, "{\"scene\":\"\xc3\xa4.rts\"");
    run_free(&run);
}

/* A file that opens does not become stdout or stderr. */
static void closed_streams_receive_no_other_files(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    run run = run_rtc_closed(2, "devices");
    expect_status(&run, 4);
    expect_err(&run, "cannot write to stdout: Bad file descriptor");
    run_free(&run);
    run = run_rtc_closed(7, "a.rts --spp 1 --quiet --stats --out a.pfm");
    expect_status(&run, 4);
    run_free(&run);
    run = run_rtc_closed(7, "a.rts --spp 1 --checkpoint a.rtpart --out b.pfm");
    expect_status(&run, 0);
    run_free(&run);
    expect_same_files("a.pfm", "b.pfm");
    expect_rtc(0, "info a.rtpart");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(wrong_usage_is_refused_with_status_2),
        TEST(a_mistyped_subcommand_gets_a_hint),
        TEST(several_mistakes_are_all_told),
        TEST(outputs_spare_what_is_read),
        TEST(what_is_no_scene_is_named),
        TEST(typed_options_are_named_when_the_scene_disagrees),
        TEST(both_forms_of_an_option_are_the_same),
        TEST(switches_of_the_scene_are_taken_back),
        TEST(last_of_a_repeated_option_counts),
        TEST(two_dashes_end_the_options),
        TEST(negative_value_is_a_value),
        TEST(help_describes_every_option),
        TEST(each_command_has_its_help),
        TEST(each_form_of_photons_has_its_help),
        TEST(the_name_of_a_photon_map_is_told),
        TEST(version_is_told),
        TEST(devices_are_listed),
        TEST(doctor_finds_all_well),
        TEST(check_counts_what_a_scene_holds),
        TEST(scenes_name_regular_files_only),
        TEST(only_the_first_errors_are_printed),
        TEST(check_of_several_scenes_goes_on_after_a_bad_one),
        TEST(no_platform_is_status_3_and_says_what_to_install),
        TEST(each_setting_is_an_option),
        TEST(check_needs_no_device),
        TEST(unknown_device_is_status_3),
        TEST(memory_is_limited_with_status_3),
        TEST(full_stdout_is_status_4),
        TEST(names_are_told_without_harm),
        TEST(closed_streams_receive_no_other_files),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
