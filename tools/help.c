/* help.c - the help of every command, from the table of options. */
#include <stdio.h>
#include <string.h>

#include "help.h"
#include "photons.h"
#include "settings.h"

enum { LEFT = 26, WIDTH = 80 };

static const char *const usages[COMMAND_COUNT] = {
    [COMMAND_RENDER] =
        "usage: rtc SCENE [OPTION]...       render a scene, also one of another program\n"
        "       rtc check SCENE...          report all errors in scenes\n"
        "       rtc mesh KIND [OPTION]...   write a mesh made from a formula\n"
        "       rtc import FILE --out SCENE write a scene of another program as .rts\n"
        "       rtc fmt SCENE... [OPTION]   lay out scenes anew, in place\n"
        "       rtc devices                 list the OpenCL devices\n"
        "       rtc doctor [OPTION]...      check that everything works here\n"
        "       rtc kernels [PROGRAM]...    compile the kernels ahead of the first render\n"
        "       rtc study SCENE --sweep ... settings compared on a page of pictures\n"
        "       rtc paths SCENE --pixel X,Y ... the paths of a pixel, vertex by vertex\n"
        "       rtc photons ...             emit, merge, inspect and export photon maps\n"
        "       rtc compare A... B [OPTION]... measure how images differ from a reference\n"
        "       rtc merge FILM... --out FILE   join the parts of a picture\n"
        "       rtc info FILE...            what a film or a photon map holds\n"
        "       rtc help COMMAND            the options of one command\n"
        "       rtc --version               the version\n"
        "\n"
        "Renders a scene of the .rts language by path tracing, photon mapping or vertex\n"
        "connection and merging. The name - stands for stdin, whose images are stdin.png\n"
        "and stdin.exr. Scenes of other programs are taken too, here and by all commands:\n"
        ".xml (Mitsuba) .pbrt .gltf .glb .obj, and the meshes .ply .stl .off. An option\n"
        "is written --name value or --name=value; the last one of several wins.\n",
    [COMMAND_CHECK] =
        "usage: rtc check SCENE... [OPTION]...\n"
        "\n"
        "Reads scenes without rendering them and reports all errors, each with its\n"
        "place. SCENE - reads from stdin. A scene is checked as it is written, with the\n"
        "settings of its own film and render blocks.\n",
    [COMMAND_MESH] = "usage: rtc mesh KIND [OPTION]...\n"
                     "\n"
                     "Writes a mesh made from a formula, with normals and texture coordinates.\n"
                     "KIND is one of:\n"
                     "  sphere   radius 1\n"
                     "  torus    around the y axis, radii 0.7 and 0.3\n"
                     "  knot     a tube along the trefoil\n"
                     "  terrain  hills over a square, y up\n"
                     "Each is centred at the origin and fits in the cube from -1 to 1.\n",
    [COMMAND_DEVICES] =
        "usage: rtc devices\n"
        "\n"
        "Lists the OpenCL devices of this machine; the number selects one by --device.\n",
    [COMMAND_DOCTOR] =
        "usage: rtc doctor [OPTION]...\n"
        "\n"
        "Checks step by step that OpenCL, the kernels, the modes path and photon and the\n"
        "image writers work on this machine, and says what to do about what does not.\n",
    [COMMAND_KERNELS] =
        "usage: rtc kernels [PROGRAM]... [OPTION]...\n"
        "\n"
        "Compiles all kernels, or those of the programs named, so that no render has to\n"
        "wait for them: after installation, or into the image of a container.\n",
    [COMMAND_STUDY] =
        "usage: rtc study SCENE --sweep NAME=A,B,... [OPTION]...\n"
        "\n"
        "Renders a scene with every combination of the values that are swept, measures\n"
        "each picture against a reference, and writes NAME.html, a page of pictures and\n"
        "plots that needs no other file, and NAME.csv. What stands in NAME.films is not\n"
        "rendered again.\n",
    [COMMAND_PATHS] =
        "usage: rtc paths SCENE --pixel X,Y [OPTION]...\n"
        "\n"
        "Follows the camera paths of a pixel again, the same as a render in mode path\n"
        "does, and writes every vertex down: where, what happened, the throughput, the\n"
        "densities, the light that was met or sampled, its weight by multiple importance\n"
        "sampling and what it added to the pixel. What all add up to is the pixel.\n",
    [COMMAND_IMPORT] =
        "usage: rtc import FILE --out SCENE.rts [OPTION]...\n"
        "\n"
        "Writes a scene of another program in the scene language: glTF 2.0 (.gltf, .glb),\n"
        "OBJ with MTL, Mitsuba (.xml), pbrt-v4 (.pbrt), or a mesh (.ply, .stl, .off). To\n"
        "render one, `rtc FILE` is enough. What the language lacks is left out or comes\n"
        "as near as it can; each such place is a warning, and a comment at the head of\n"
        "the scene.\n",
    [COMMAND_FMT] =
        "usage: rtc fmt SCENE.rts... [OPTION]...\n"
        "\n"
        "Lays scenes out anew, in place; what is right stays as it is. Comments stay, and\n"
        "so does what the scene means. Lines end with LF, also where they ended with\n"
        "CR LF. The scene - goes from stdin to stdout.\n",
    [COMMAND_PHOTONS] =
        "usage: rtc photons SCENE --out MAP.rtp [OPTION]...       emit a photon map\n"
        "       rtc photons info MAP...                          what maps hold\n"
        "       rtc photons merge MAP... --out MAP.rtp           join maps into one\n"
        "       rtc photons diff MAP MAP                         say how two maps differ\n"
        "       rtc photons export MAP --out FILE.ply            points for MeshLab or Blender\n"
        "       rtc photons illuminance MAP POINTS               light that arrives at points\n"
        "\n"
        "Emits photons into a map, or works on maps in files.\n"
        "The name of a map that is written must end in .rtp.\n"
        "`rtc SCENE --photon-map MAP.rtp` renders with a map. Parts made by --part, or\n"
        "maps of different seeds, merge in any order into the map that would have been\n"
        "made at once, to the bit. `diff` exits with 0 for equal maps and 1 for others.\n"
        "A scene called like one of these words is written ./info.\n",
    [COMMAND_MERGE] =
        "usage: rtc merge FILM.rtpart... --out FILE [OPTION]...\n"
        "\n"
        "Joins films of the same picture: the parts that `rtc SCENE --part I/N` made,\n"
        "checkpoints, or what was merged before, in any order. The picture has the bits\n"
        "of a render at once. FILE is an image, for which all parts must be there, or\n"
        "another film, NAME.rtpart.\n",
    [COMMAND_INFO] =
        "usage: rtc info FILE... [OPTION]...\n"
        "\n"
        "Prints what films (.rtpart) hold on stdout: how much is done, the time spent and\n"
        "to come, parts that are missing, and all settings; and what photon maps (.rtp)\n"
        "hold, as `rtc photons info` does.\n",
    [COMMAND_COMPARE] =
        "usage: rtc compare A... B [OPTION]...\n"
        "\n"
        "Measures on stdout how image A differs from the reference B, of the same size:\n"
        "  mse, rmse  mean of (a - b)^2 over pixels and channels, linear; its square root\n"
        "  relmse     mean of (a - b)^2 / (b^2 + 0.01)\n"
        "  ratio      mean of a by mean of b, with its standard error\n"
        "  ssim       structural similarity of the luminance as a display shows it\n"
        "  flip       what a person sees of the difference, 0 to 1\n"
        "  typical    difference that 95 % of the pixels do not exceed\n"
        "  blocks     the same ratio block by block, and how many are off beyond noise\n"
        "Several A are independent renders, of different seeds: their mean is compared,\n"
        "and their scatter is part of the noise, which one render made in photon mode\n"
        "understates: pixels share photons. Images have any format that textures\n"
        "have; those of 8 and 16 bits are decoded from sRGB.\n"
        "\n"
        "Exit status: 0 when every limit given is kept, 1 when one is not, with the\n"
        "results on stdout all the same; 1 with an error and no results when an image\n"
        "cannot be read or the sizes differ. Pixels that are not finite keep no limit.\n",
};

static const char footer[] =
    "\n"
    "Exit status: 0 done, 1 the scene or an input file is wrong, 2 usage, 3 device,\n"
    "OpenCL or memory, 4 an output could not be written, 130 interrupted. On Ctrl-C,\n"
    "SIGTERM or SIGHUP the samples so far are written; a second one stops at once.\n"
    "\n"
    "Example: rtc scenes/cornell.rts --mode photon --k 50 --kernel epanechnikov\n";

/* Prints text from column `left` on, broken between words, on lines of at most WIDTH columns. */
static void print_wrapped(const char *text, size_t column, size_t left)
{
    while (*text) {
        size_t length = strcspn(text, " ");
        if (column > left && column + 1 + length > WIDTH) {
            fputc('\n', stdout);
            column = 0;
        }
        if (column < left) {
            printf("%*s", (int)(left - column), "");
            column = left;
        } else if (column > left) {
            fputc(' ', stdout);
            column++;
        }
        printf("%.*s", (int)length, text);
        column += length;
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', stdout);
}

/*
 * What an option does in a command, or in a form of `rtc photons`, where it is not what the table
 * says.
 */
static const struct {
    option_id option;
    command_id command;
    const char *form; /* "" for emission; NULL: of any command but `rtc photons` */
    const char *help;
} own_helps[] = {
    {OPTION_OUT, COMMAND_PHOTONS, "", "where the map goes; its name ends in .rtp"},
    {OPTION_OUT, COMMAND_PHOTONS, "merge", "where the merged map goes; its name ends in .rtp"},
    {OPTION_OUT, COMMAND_PHOTONS, "export", "where the points go; its name ends in .ply"},
    {OPTION_OUT, COMMAND_COMPARE, NULL,
     "where the signed difference goes; .png .ppm: white where equal, red where A is brighter, "
     "blue where B is; .exr .pfm: A - B as it is; may be repeated"},
    {OPTION_OUT, COMMAND_PATHS, NULL,
     "where the paths go, stdout if not given: .json; .ply, lines for Blender or MeshLab; .html, a "
     "page that draws them over the picture; may be repeated"},
    {OPTION_OUT, COMMAND_STUDY, NULL,
     "where the page goes, NAME.html, with NAME.csv and NAME.films beside it; not given: called "
     "after the scene, in the current directory"},
    {OPTION_STATS, COMMAND_PHOTONS, "",
     "print what the map holds on stdout, as `rtc photons info` does, and how long it took"},
    {OPTION_JSON, COMMAND_RENDER, NULL,
     "print --stats as one JSON object; null stands for what is not a finite number"},
    {OPTION_JSON, COMMAND_CHECK, NULL,
     "print what each scene holds as a JSON object on a line of stdout, and errors and warnings as "
     "such lines on stderr"},
    {OPTION_JSON, COMMAND_PHOTONS, "", "print --stats as one JSON object"},
    {OPTION_JSON, COMMAND_PHOTONS, "info", "print what each map holds as a JSON object on a line"},
    {OPTION_JSON, COMMAND_PHOTONS, "diff", "print how the maps differ as one JSON object"},
    {OPTION_JSON, COMMAND_PHOTONS, "illuminance",
     "print a JSON object on a line for each point, with the photons and their radius"},
    {OPTION_OUT, COMMAND_MERGE, NULL,
     "where the picture goes: .exr .pfm (linear), .png .ppm (sRGB), or .rtpart, a film; may be "
     "repeated"},
    {OPTION_CHECKPOINT, COMMAND_PHOTONS, "",
     "keep the photons so far in a map NAME.rtp, which --resume goes on from; an older one stays "
     "until the new one is whole"},
    {OPTION_RESUME, COMMAND_PHOTONS, "",
     "emit only the paths that this map lacks, which is of the same scene and settings; it is the "
     "checkpoint too where none is given"},
    {OPTION_PART, COMMAND_PHOTONS, "",
     "emit the I-th of N parts of the map, to be merged later; auto takes I and N from Slurm, MPI "
     "or an indexed job"},
    {OPTION_JSON, COMMAND_INFO, NULL, "print what each file holds as a JSON object on a line"},
    {OPTION_QUIET, COMMAND_MERGE, NULL, "say nothing but errors"},
    {OPTION_QUIET, COMMAND_CHECK, NULL, "say nothing but errors"},
    {OPTION_QUIET, COMMAND_PHOTONS, "info", "say nothing but errors, and the results"},
    {OPTION_QUIET, COMMAND_PHOTONS, "diff", "say nothing but errors, and the results"},
    {OPTION_QUIET, COMMAND_PHOTONS, "illuminance", "say nothing but errors, and the results"},
    {OPTION_QUIET, COMMAND_PHOTONS, "merge", "say nothing but errors"},
    {OPTION_QUIET, COMMAND_PHOTONS, "export", "say nothing but errors"},
};

const char *help_of(const option *option, command_id command, const photons_form *form)
{
    const char *word = form ? form->word : "";
    for (size_t i = 0; i < sizeof own_helps / sizeof *own_helps; i++)
        if (option == &option_table[own_helps[i].option] && own_helps[i].command == command &&
            (!own_helps[i].form || strcmp(own_helps[i].form, word) == 0))
            return own_helps[i].help;
    return option->help;
}

const char *help_usage(command_id command)
{
    return usages[command];
}

/* The option's name and value, and beside them "help (words; default ...)". */
static void print_entry(const char *name, const char *value, const char *help, const char *words,
                        const char *fallback)
{
    char text[1024];
    if (fallback)
        snprintf(text, sizeof text, "%s (%s%sdefault %s)", help, words, words[0] ? "; " : "",
                 fallback);
    else
        snprintf(text, sizeof text, "%s", help);
    int column = printf("  --%s%s%s", name, value ? " " : "", value ? value : "");
    print_wrapped(text, (size_t)column, LEFT);
}

static void print_option(const option *option, command_id command, const photons_form *form)
{
    char words[128] = "";
    const char *help = help_of(option, command, form);
    if (option->words)
        rt_words_join(words, sizeof words, option->words);
    print_entry(option->name, option->value, help, words,
                help == option->help ? option->fallback : NULL);
}

/* Whether a command takes a word of a setting: camera paths are those of one mode. */
static int takes_word(command_id command, const rt_setting *setting, const rt_word *word)
{
    return command != COMMAND_PATHS || strcmp(setting->field.name, "mode") != 0 ||
           word->value == RT_MODE_PATH;
}

/* A line or more for each word of a setting. */
static void print_words(const rt_setting *setting, command_id command)
{
    char help[SETTING_HELP_SIZE];
    for (const rt_word *words = setting->field.words; words->name; words++) {
        if (!takes_word(command, setting, words))
            continue;
        printf("%*s", LEFT + 2, "");
        int length = printf("%s:", words->name);
        rt_setting_text(help, sizeof help, words->help, RT_NAME_OPTION);
        print_wrapped(help, (size_t)(LEFT + 2 + length), LEFT + 4);
    }
}

/* The setting before this one that has the same words, or NULL. */
static const rt_setting *same_words(const rt_setting *setting)
{
    const rt_setting *before = rt_settings(NULL);
    while (before != setting && before->field.words != setting->field.words)
        before++;
    return setting->field.words && before != setting ? before : NULL;
}

static void print_setting(const rt_setting *setting, command_id command)
{
    char name[SETTING_NAME_SIZE], other[SETTING_NAME_SIZE], help[SETTING_HELP_SIZE], fallback[128],
        kind[80] = "";
    const rt_field *field = &setting->field;
    const rt_setting *same = same_words(setting);
    settings_name(name, setting);
    rt_setting_text(help, sizeof help, field->help, RT_NAME_OPTION);
    rt_setting_text(fallback, sizeof fallback, field->fallback, RT_NAME_OPTION);
    if (same)
        snprintf(kind, sizeof kind, "a word of --%s", settings_name(other, same));
    else if (field->unit[0])
        snprintf(kind, sizeof kind, "in %s", field->unit);
    if (settings_is_switch(setting))
        snprintf(help + strlen(help), sizeof help - strlen(help), "; --no-%s: do not", name);
    print_entry(name, settings_value_name(setting), help, kind,
                settings_is_switch(setting) ? NULL : fallback);
    if (field->words && !same)
        print_words(setting, command);
}

/* Whether what is asked about, a command or a form of `rtc photons`, has this option. */
static int takes(command_id command, const photons_form *form, option_id id)
{
    return (option_table[id].commands & (1u << command)) && (!form || photons_form_takes(form, id));
}

/* The same of a setting. */
static int takes_setting(command_id command, const photons_form *form, const rt_setting *setting)
{
    return command == COMMAND_PHOTONS ? photons_form_takes_setting(form, setting)
                                      : settings_is_taken(setting, command);
}

/*
 * The settings of a group that a command, or a form, takes; with `print`, prints them. Returns how
 * many.
 */
static int group_settings(option_group group, command_id command, const photons_form *form,
                          int print)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    int found = 0;
    for (size_t i = 0; i < count; i++)
        if (settings_group(&settings[i]) == group && takes_setting(command, form, &settings[i])) {
            found++;
            if (print)
                print_setting(&settings[i], command);
        }
    return found;
}

/* The same of the options that are no settings; form: of `rtc photons`, or NULL. */
static int group_options(option_group group, command_id command, const photons_form *form,
                         int print)
{
    int found = 0;
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].group == group && takes(command, form, (option_id)i)) {
            found++;
            if (print)
                print_option(&option_table[i], command, form);
        }
    return found;
}

/* Prints what a group has, under its title; the files of GROUP_OUTPUT come before their layers. */
static void print_group(option_group group, command_id command, const photons_form *form)
{
    int settings = group_settings(group, command, form, 0);
    if (settings + group_options(group, command, form, 0) == 0)
        return;
    printf("\n%s:\n", option_group_titles[group]);
    if (group == GROUP_OUTPUT)
        group_options(group, command, form, 1);
    group_settings(group, command, form, 1);
    if (group != GROUP_OUTPUT)
        group_options(group, command, form, 1);
}

void help_print(const command_line *arguments)
{
    command_id command = arguments->command;
    const photons_form *form = photons_find_form(arguments);
    fputs(form ? form->usage : usages[command], stdout);
    for (int group = 0; group < GROUP_COUNT; group++)
        print_group((option_group)group, command, form);
    if (command == COMMAND_RENDER)
        fputs(footer, stdout);
}
