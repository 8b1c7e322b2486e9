/* photons.c - `rtc photons`: emits, merges, inspects and exports photon maps. */
#include "commands.h"
#include "photons.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "inputs.h"
#include "message.h"
#include "other_work.h"
#include "outputs.h"
#include "session.h"
#include "settings.h"
#include "status.h"

int photons_load(rt_photon_map **out, const char *path, const command_line *arguments)
{
    rt_error error;
    if (rt_photon_map_load_in(out, path, arguments->memory, &error) == RT_OK)
        return STATUS_DONE;
    const int status = session_fail(&error);
    if (outputs_is_film(path))
        message_hint("a film: `rtc info` tells what it holds, `rtc merge` joins films");
    return status;
}

int photons_output(const char **out, const command_line *arguments, const char *what,
                   const char *extension)
{
    if (arguments->output_count != 1) {
        message_error("%s goes to one file: --out FILE", what);
        return STATUS_USAGE;
    }
    const char *path = arguments->outputs[0];
    if (strcasecmp(outputs_extension(path), extension) != 0) {
        message_error("--out %s: %s goes to a file called NAME%s", path, what, extension);
        return STATUS_USAGE;
    }
    *out = path;
    return outputs_check_writable(path);
}

static int fail_operands(const char *usage)
{
    message_error("usage: rtc photons %s", usage);
    message_hint("`rtc photons --help` says what each form does");
    return STATUS_USAGE;
}

/* Whether maps that are to be joined are different files. */
static int check_maps(const command_line *arguments)
{
    for (size_t i = 2; i < arguments->operand_count; i++)
        for (size_t j = 1; j < i; j++)
            if (inputs_are_same(arguments->operands[j], arguments->operands[i])) {
                message_error("%s is given twice: merged maps must be of different parts or seeds",
                              arguments->operands[i]);
                return STATUS_USAGE;
            }
    return STATUS_DONE;
}

/* Whether a form's output is none of the maps that it reads. */
static int check_inputs(const command_line *arguments, const char *output)
{
    input_list inputs = {0};
    for (size_t i = 1; i < arguments->operand_count; i++)
        inputs_add(&inputs, arguments->operands[i]);
    int status = inputs_check(&inputs, output);
    inputs_free(&inputs);
    return status;
}

/* What is said of written files, unless rtc is to be quiet. */
static void say_written(const command_line *arguments, const char *path, const rt_photon_map *map)
{
    rt_photon_map_info info;
    rt_photon_map_get_info(map, &info);
    if (!arguments->options[OPTION_QUIET].given)
        message_note(
            "wrote %s: %llu photons of %llu paths", path,
            (unsigned long long)(info.photons[RT_PHOTONS_GLOBAL] +
                                 info.photons[RT_PHOTONS_CAUSTIC] +
                                 info.photons[RT_PHOTONS_VOLUME]),
            (unsigned long long)(info.paths[RT_PHOTONS_GLOBAL] + info.paths[RT_PHOTONS_CAUSTIC]));
}

/* ---- Forms that work on files -------------------------------------------------- */

static int info(const command_line *arguments)
{
    if (arguments->operand_count < 2)
        return fail_operands("info MAP...");
    int status = STATUS_DONE;
    for (size_t i = 1; i < arguments->operand_count; i++) {
        rt_photon_map *map = NULL;
        int now = photons_load(&map, arguments->operands[i], arguments);
        if (now == STATUS_DONE)
            now = arguments->options[OPTION_JSON].given
                      ? photons_print_info_json(arguments->operands[i], map, NULL)
                      : photons_print_info(arguments->operands[i], map);
        rt_photon_map_destroy(map);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}

static int merge(const command_line *arguments)
{
    size_t count = arguments->operand_count - 1;
    const char *path = NULL;
    rt_photon_map *whole = NULL;
    rt_error error;
    if (count < 1)
        return fail_operands("merge MAP... --out MAP.rtp");
    int status = photons_output(&path, arguments, "the merged map", ".rtp");
    if (status == STATUS_DONE)
        status = check_inputs(arguments, path);
    if (status == STATUS_DONE)
        status = check_maps(arguments);
    if (status != STATUS_DONE)
        return status;
    rt_photon_map **maps = calloc(count, sizeof *maps);
    if (!maps) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    for (size_t i = 0; i < count && status == STATUS_DONE; i++)
        status = photons_load(maps + i, arguments->operands[1 + i], arguments);
    if (status == STATUS_DONE &&
        rt_photon_map_merge(&whole, (const rt_photon_map *const *)maps, count, &error) != RT_OK)
        status = session_fail(&error);
    if (status == STATUS_DONE)
        status = other_work_check_map(path, whole, arguments);
    if (status == STATUS_DONE && rt_photon_map_save(whole, path, &error) != RT_OK)
        status = session_fail(&error);
    if (status == STATUS_DONE)
        say_written(arguments, path, whole);
    for (size_t i = 0; i < count; i++)
        rt_photon_map_destroy(maps[i]);
    free(maps);
    rt_photon_map_destroy(whole);
    return status;
}

static int diff(const command_line *arguments)
{
    rt_photon_map *a = NULL, *b = NULL;
    int differ = 0;
    if (arguments->operand_count != 3)
        return fail_operands("diff MAP MAP");
    int status = photons_load(&a, arguments->operands[1], arguments);
    if (status == STATUS_DONE)
        status = photons_load(&b, arguments->operands[2], arguments);
    if (status == STATUS_DONE)
        status = arguments->options[OPTION_JSON].given
                     ? photons_print_difference_json(arguments->operands + 1, a, b, &differ)
                     : photons_print_difference(a, b, &differ);
    rt_photon_map_destroy(a);
    rt_photon_map_destroy(b);
    return status == STATUS_DONE && differ ? STATUS_INPUT : status;
}

static int export(const command_line *arguments)
{
    rt_photon_map *map = NULL;
    const char *path = NULL;
    rt_error error;
    if (arguments->operand_count != 2)
        return fail_operands("export MAP --out FILE.ply");
    int status = photons_output(&path, arguments, "the cloud of points", ".ply");
    if (status == STATUS_DONE)
        status = check_inputs(arguments, path);
    if (status == STATUS_DONE)
        status = photons_load(&map, arguments->operands[1], arguments);
    if (status == STATUS_DONE && rt_photon_map_export(map, path, &error) != RT_OK)
        status = session_fail(&error);
    if (status == STATUS_DONE)
        say_written(arguments, path, map);
    rt_photon_map_destroy(map);
    return status;
}

/* ---- The command ------------------------------------------------------------------ */

static const photons_form forms[] = {
    {"info", info, 0, 0,
     "usage: rtc photons info MAP...\n"
     "\n"
     "Prints what maps hold on stdout: paths, photons, flux, bounds, and the energy\n"
     "ledger of each light.\n"},
    {"merge", merge, 1, 0,
     "usage: rtc photons merge MAP... --out MAP.rtp\n"
     "\n"
     "Joins parts of a map made by --part, or maps of different seeds, in any order,\n"
     "into the map that would have been made at once, to the bit.\n"},
    {"diff", diff, 0, 0,
     "usage: rtc photons diff MAP MAP\n"
     "\n"
     "Prints how two maps differ on stdout.\n"
     "\n"
     "Exit status: 0 when the maps are equal, 1 when they are not; 1 with an error and\n"
     "nothing on stdout when one cannot be read.\n"},
    {"export", export, 1, 0,
     "usage: rtc photons export MAP --out FILE.ply\n"
     "\n"
     "Writes the photons as the points of a PLY file for MeshLab or Blender.\n"},
    {"illuminance", photons_illuminance, 0, 1,
     "usage: rtc photons illuminance MAP POINTS [OPTION]...\n"
     "\n"
     "Prints the light that arrives at points on stdout, a line a point: its position,\n"
     "irradiance (W/m^2, red, green and blue), illuminance (lx, 179 lm/W by the\n"
     "luminance of sRGB) and, in media that scatter, fluence rate (W/m^2), each with\n"
     "its standard error. POINTS is a text, or - for stdin, with a line a point:\n"
     "x y z, in metres, and for irradiance nx ny nz, the normal of the surface on the\n"
     "side of the light. # begins a comment. The map should hold direct light:\n"
     "--direct photons.\n"},
};

const photons_form *photons_forms(size_t *count)
{
    if (count)
        *count = sizeof forms / sizeof *forms;
    return forms;
}

const photons_form *photons_find_form(const command_line *arguments)
{
    if (arguments->command != COMMAND_PHOTONS || arguments->operand_count == 0)
        return NULL;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (strcmp(arguments->operands[0], forms[i].word) == 0)
            return &forms[i];
    return NULL;
}

int photons_form_takes(const photons_form *form, option_id id)
{
    return id == OPTION_QUIET || id == OPTION_HELP || id == OPTION_MEMORY ||
           (id == OPTION_OUT && form->writes) || (id == OPTION_JSON && !form->writes);
}

int photons_form_takes_setting(const photons_form *form, const rt_setting *setting)
{
    return form ? form->finds && settings_finds_photons(setting)
                : (setting->flags & RT_SETTING_EMITS) != 0;
}

/* Emission has many options, the other forms few; form: or NULL. */
static int check_options(const command_line *arguments, const photons_form *form)
{
    int status = STATUS_DONE;
    for (int i = 0; i < OPTION_COUNT; i++) {
        if (form && arguments->options[i].given && !photons_form_takes(form, (option_id)i)) {
            message_error("`rtc photons %s` takes no option --%s", form->word,
                          option_table[i].name);
            status = STATUS_USAGE;
        }
    }
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        char name[SETTING_NAME_SIZE];
        if (settings_text(arguments, &settings[i]) &&
            !photons_form_takes_setting(form, &settings[i])) {
            message_error("`rtc photons%s%s` takes no option --%s", form ? " " : "",
                          form ? form->word : "", settings_name(name, &settings[i]));
            status = STATUS_USAGE;
        }
    }
    return status;
}

const char *photons_nearest_form(const char *word)
{
    rt_nearest search;
    rt_nearest_begin(&search, word, strlen(word));
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        rt_nearest_offer(&search, forms[i].word, strlen(forms[i].word));
    return search.best;
}

/* What is not there as a scene may be a mistyped form. Returns whether there is a hint. */
static int hint_form(const char *word)
{
    const char *form = access(word, F_OK) != 0 ? photons_nearest_form(word) : NULL;
    if (form)
        message_hint("did you mean `rtc photons %s`?", form);
    return form != NULL;
}

int command_photons(const command_line *arguments)
{
    if (arguments->operand_count == 0)
        return fail_operands("SCENE --out MAP.rtp");
    const photons_form *form = photons_find_form(arguments);
    const int taken = check_options(arguments, form);
    if (taken != STATUS_DONE)
        return taken;
    if (form)
        return form->run(arguments);
    if (strcmp(arguments->operands[0], "help") == 0) {
        message_error("`rtc photons` has no form help: try `rtc help photons`");
        return STATUS_USAGE;
    }
    if (arguments->operand_count > 1) {
        message_error("usage: rtc photons %s",
                      "SCENE --out MAP.rtp, or info, merge, diff, export or illuminance");
        if (!hint_form(arguments->operands[0]))
            message_hint("`rtc photons --help` says what each form does");
        return STATUS_USAGE;
    }
    int status = photons_emit(arguments);
    if (status != STATUS_DONE)
        hint_form(arguments->operands[0]);
    return status;
}
