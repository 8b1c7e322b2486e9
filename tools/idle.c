#include "idle.h"

#include "message.h"

static int is_asked_for(const command_line *arguments, option_id id)
{
    const option_value *value = &arguments->options[id];
    return value->given && !(option_table[id].kind == KIND_SWITCH && !value->choice);
}

/* ---- What an option may need ------------------------------------------------ */

static int is_photon(const rt_render_options *o)
{
    return o->mode == RT_MODE_PHOTON;
}

/* Whether the first hit is not all that is shown. */
static int follows_light(const rt_render_options *o)
{
    return o->mode == RT_MODE_PATH || o->mode == RT_MODE_DIRECT || o->mode == RT_MODE_PHOTON;
}

/*
 * Whether paths from the eye are followed through diffuse bounces, as the map is asked at the first
 * one.
 */
static int bounces(const rt_render_options *o)
{
    return !is_photon(o) || o->final_gather > 0;
}

static int emits(const rt_render_options *o)
{
    return !o->photon_map;
}

/* Whether caustic photons are kept apart. */
static int splits(const rt_render_options *o)
{
    rt_photon_map_info info;
    if (!o->photon_map)
        return o->caustic_photons > 0;
    rt_photon_map_get_info(o->photon_map, &info);
    return info.split;
}

static int weighs(const rt_render_options *o)
{
    return o->area == RT_AREA_DISC;
}

static int has_cone(const rt_render_options *o)
{
    return weighs(o) &&
           (o->kernel == RT_DENSITY_CONE || (splits(o) && o->caustic_kernel == RT_DENSITY_CONE));
}

static int has_passes(const rt_render_options *o)
{
    return o->passes > 1;
}

/*
 * Whether k photons are looked for: passes gather within a radius, and ask for the k-th where none
 * is given.
 */
static int counts_photons(const rt_render_options *o)
{
    return !has_passes(o) || o->radius == 0;
}

static int counts_caustics(const rt_render_options *o)
{
    return !has_passes(o) || (o->caustic_radius == 0 && o->radius == 0);
}

/* ---- The table -------------------------------------------------------------- */

/*
 * An option, what it does nothing without, and how that is said. Those of photon mode are looked at
 * in that mode.
 */
static const struct {
    option_id option;
    int (*has_effect)(const rt_render_options *options);
    const char *says;
} needs[] = {
    {OPTION_MAX_DEPTH, follows_light, "in a mode that shows no light"},
    {OPTION_ROULETTE_DEPTH, follows_light, "in a mode that shows no light"},
    {OPTION_ROULETTE_THRESHOLD, follows_light, "in a mode that shows no light"},
    {OPTION_ESTIMATOR, follows_light, "in a mode that shows no light"},
    {OPTION_ROULETTE_DEPTH, bounces, "in photon mode without --final-gather"},
    {OPTION_ROULETTE_THRESHOLD, bounces, "in photon mode without --final-gather"},
    {OPTION_ESTIMATOR, bounces, "in photon mode without --final-gather"},
    {OPTION_PHOTONS, emits, "with --photon-map"},
    {OPTION_CAUSTIC_PHOTONS, emits, "with --photon-map"},
    {OPTION_LIGHT_SHARES, emits, "with --photon-map"},
    {OPTION_CAUSTIC_K, splits, "without --caustic-photons"},
    {OPTION_CAUSTIC_RADIUS, splits, "without --caustic-photons"},
    {OPTION_CAUSTIC_KERNEL, splits, "without --caustic-photons"},
    {OPTION_KERNEL, weighs, "with --area hull"},
    {OPTION_CAUSTIC_KERNEL, weighs, "with --area hull"},
    {OPTION_CONE_K, has_cone, "without --kernel cone, or with --area hull"},
    {OPTION_ALPHA, has_passes, "without --passes"},
    {OPTION_K, counts_photons, "with --passes and --radius"},
    {OPTION_CAUSTIC_K, counts_caustics, "with --passes and a radius"},
};

static void warn_needs(const command_line *arguments, const rt_render_options *options)
{
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        const option *option = &option_table[needs[i].option];
        if (option->group == GROUP_PHOTON && !is_photon(options))
            continue;
        if (is_asked_for(arguments, needs[i].option) && !needs[i].has_effect(options))
            message_warning("--%s has no effect %s", option->name, needs[i].says);
    }
}

/* What is asked for but has no place in the files. */
static void warn_outputs(const command_line *arguments, const rt_render_options *options,
                         const output_list *outputs)
{
    if (!outputs_have_8bit(outputs) &&
        (is_asked_for(arguments, OPTION_EXPOSURE) || is_asked_for(arguments, OPTION_TONEMAP)))
        message_warning(
            "--exposure and --tonemap have no effect on .exr and .pfm, which hold radiance");
    if (outputs_have_layers(outputs))
        return;
    if (is_asked_for(arguments, OPTION_AOV))
        message_warning("--aov has no effect without an .exr, which alone holds layers");
    if (is_asked_for(arguments, OPTION_PHOTON_LAYERS) && is_photon(options))
        message_warning("--photon-layers has no effect without an .exr, which alone holds layers");
    if (is_asked_for(arguments, OPTION_VARIANCE))
        message_warning("--variance adds no layer without an .exr, which alone holds layers; the "
                        "error is told all the "
                        "same");
}

void idle_warn(const command_line *arguments, const rt_render_options *options,
               const output_list *outputs)
{
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].group == GROUP_PHOTON && !is_photon(options) &&
            is_asked_for(arguments, (option_id)i))
            message_warning("--%s has no effect in %s mode; --mode photon asks for photon mapping",
                            option_table[i].name, rt_mode_name(options->mode));
    warn_needs(arguments, options);
    if (is_asked_for(arguments, OPTION_JSON) && !is_asked_for(arguments, OPTION_STATS))
        message_warning("--json has no effect without --stats");
    warn_outputs(arguments, options, outputs);
}
