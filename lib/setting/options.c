/* options.c - options of a render: their checks and their defaults. */
#include "setting/options.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"

/* ---- Checks ---------------------------------------------------------------- */

/* Zero stands for the default, whatever the range. */
static rt_status check_setting(const rt_setting *setting, const rt_render_options *options,
                               rt_error *error)
{
    const rt_field *field = &setting->field;
    const double value = rt_setting_value(setting, options);
    char range[64];
    if (field->type == RT_FIELD_BOOLEAN || value == 0 ||
        (field->type == RT_FIELD_COUNT && value == RT_K_ALL))
        return RT_OK;
    if (field->type == RT_FIELD_CHOICE) {
        for (const rt_word *word = field->words; word->name; word++)
            if (word->value == value)
                return RT_OK;
        return rt_fail_field(error, RT_ERROR_USAGE, field->name, "there is no %s %.0f", field->name,
                             value);
    }
    if (rt_range_holds(field->range, value))
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_USAGE, field->name, "%s is %.10g; it must be %s",
                         field->name, value, rt_range_phrase(range, sizeof range, field->range));
}

/* What concerns more than one setting. */
static rt_status check_together(const rt_render_options *o, rt_error *error)
{
    enum { film_pixels_max = 1 << 28, hull_k_min = 5 };
    if ((uint64_t)o->width * o->height > film_pixels_max)
        return rt_fail_field(error, RT_ERROR_USAGE, "height",
                             "a film of %u x %u pixels is over the limit of %d", o->width,
                             o->height, film_pixels_max);
    int is_few = o->k > 0 && o->k < hull_k_min;
    int is_few_caustic = o->caustic_k > 0 && o->caustic_k < hull_k_min;
    if (o->area == RT_AREA_HULL && (is_few || is_few_caustic))
        return rt_fail_field(error, RT_ERROR_USAGE, is_few ? "k" : "caustic_k",
                             "area hull needs %s of at least %d: four photons make the smallest "
                             "hull with one inside, and the farthest is not summed",
                             is_few ? "k" : "caustic_k", hull_k_min);
    return RT_OK;
}

/* Lines "NAME VALUE" of names that are no settings, as they are read back from a film. */
static rt_status check_note(const char *note, rt_error *error)
{
    for (const char *line = note, *end; line && *line; line = end + 1) {
        char name[32] = "";
        const size_t length = strcspn(line, " \n");
        end = strchr(line, '\n');
        if (!end || length == 0 || line[length] != ' ')
            return rt_fail_field(
                error, RT_ERROR_USAGE, "note",
                "note should consist of lines \"NAME VALUE\", each with its newline");
        if (length < sizeof name && rt_setting_find(memcpy(name, line, length)))
            return rt_fail_field(error, RT_ERROR_USAGE, "note",
                                 "note has a line of '%s', which is a setting", name);
    }
    return RT_OK;
}

rt_status rt_options_check(const rt_render_options *options, rt_error *error)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    rt_status status = RT_OK;
    for (size_t i = 0; i < count && status == RT_OK; i++)
        status = check_setting(&settings[i], options, error);
    if (status == RT_OK)
        status = check_note(options->note, error);
    return status == RT_OK ? check_together(options, error) : status;
}

/* ---- Defaults -------------------------------------------------------------- */

/*
 * Photon paths of a pass for each pixel of the film. With more of them, less bias and noise are
 * left; with many more, a pass takes longer than it has less of them.
 */
static const uint64_t photons_a_pixel = 4;

/* Defaults that depend on other settings, or cannot be written as a decimal number. */
static void complete_dependent(rt_render_options *o)
{
    int has_passes = o->passes > 1;
    uint32_t spp_max = (uint32_t)rt_setting_find("spp")->field.range.high;
    int has_limit = o->time > 0 || o->target_error > 0;
    if (o->spp == 0)
        o->spp = o->mode == RT_MODE_PHOTON && has_passes ? 1
                 : has_limit                             ? spp_max
                 : o->mode == RT_MODE_PHOTON             ? 16
                                                         : 64;
    if (o->photons == 0)
        o->photons = has_passes ? photons_a_pixel * o->width * o->height : 1000000;
    if (o->alpha == 0)
        o->alpha = 2 / 3.0f;
    if (o->caustic_k == 0)
        o->caustic_k = o->k;
    if (o->caustic_radius == 0)
        o->caustic_radius = o->radius;
}

void rt_options_complete(rt_render_options *options)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    /* A default in words is left to the other function: it is not what the setting takes. */
    for (size_t i = 0; i < count; i++)
        if (rt_setting_value(&settings[i], options) == 0)
            rt_setting_set(options, &settings[i], settings[i].field.fallback, NULL);
    complete_dependent(options);
}
