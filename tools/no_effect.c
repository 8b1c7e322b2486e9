/*
 * no_effect.c - warnings of options that have no effect beside the others. What a setting needs
 * beside other settings stands in the table of rt/setting.h; what other options need stands here.
 */
#include "no_effect.h"

#include "message.h"
#include "settings.h"

static int is_given(const command_line *arguments, option_id id)
{
    return arguments->options[id].given;
}

static int is_requested(const command_line *arguments, const char *setting)
{
    return settings_is_requested(arguments, rt_setting_find(setting));
}

/* ---- Settings ----------------------------------------------------------------- */

/* Says of each setting that is given what it lacks to have an effect. */
static void warn_settings(const command_line *arguments, const rt_render_options *options)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++) {
        char name[SETTING_NAME_SIZE], text[128];
        const rt_setting_need *need = rt_setting_missing(&settings[i], options);
        if (!need || !settings_is_requested(arguments, &settings[i]))
            continue;
        message_warning("--%s has no effect %s", settings_name(name, &settings[i]),
                        rt_setting_text(text, sizeof text, need->otherwise, RT_NAME_OPTION));
    }
}

/* The options with what the map of --photon-map holds, for the needs of the caustic map. */
static rt_render_options with_map(const rt_render_options *options)
{
    rt_render_options known = *options;
    rt_photon_map_info info;
    if (options->photon_map) {
        rt_photon_map_get_info(options->photon_map, &info);
        known.caustic_photons = info.split;
    }
    return known;
}

/* ---- Other options --------------------------------------------------------------- */

/* With a map no photon is emitted, and without photon mode neither; and not all scenes scatter. */
static void warn_photons(const command_line *arguments, const rt_render_options *options,
                         int scatters)
{
    static const char *const emissions[] = {"photons", "caustic_photons"}, *const of_media[] = {
                                                                               "volume_k",
                                                                               "volume_radius",
                                                                               "volume_estimate"};
    char name[SETTING_NAME_SIZE];
    const int is_photon = options->mode == RT_MODE_PHOTON;
    for (size_t i = 0; i < 2 && options->photon_map && is_photon; i++) {
        if (is_requested(arguments, emissions[i]))
            message_warning("--%s has no effect with --photon-map",
                            settings_name(name, rt_setting_find(emissions[i])));
    }
    for (size_t i = 0; i < 3 && is_photon && !scatters; i++)
        if (is_requested(arguments, of_media[i]))
            message_warning("--%s has no effect where no medium scatters",
                            settings_name(name, rt_setting_find(of_media[i])));
    if (is_given(arguments, OPTION_LIGHT_SHARES) && (options->photon_map || !is_photon))
        message_warning("--light-shares has no effect %s",
                        is_photon ? "with --photon-map" : "without --mode photon");
    if (is_given(arguments, OPTION_PHOTON_MAP) && !is_photon)
        message_warning("--photon-map has no effect without --mode photon");
}

/* Warns of options that no output file can store. */
static void warn_outputs(const command_line *arguments, const rt_render_options *options,
                         const output_list *outputs)
{
    if (!outputs_have_8bit(outputs) &&
        (is_given(arguments, OPTION_EXPOSURE) || is_given(arguments, OPTION_TONEMAP)))
        message_warning(
            "--exposure and --tonemap have no effect on .exr and .pfm, which hold radiance");
    if (outputs_have_layers(outputs) || is_given(arguments, OPTION_PREVIEW))
        return;
    if (is_requested(arguments, "aov"))
        message_warning("--aov has no effect without an .exr, which alone holds layers");
    if (is_requested(arguments, "photon_layers") && options->mode == RT_MODE_PHOTON)
        message_warning("--photon-layers has no effect without an .exr, which alone holds layers");
    if (is_requested(arguments, "variance"))
        message_warning("--variance adds no layer without an .exr, which alone holds layers; the "
                        "error is told all the same");
}

void no_effect_warn(const command_line *arguments, const rt_render_options *options,
                    const rt_scene *scene, const output_list *outputs)
{
    const rt_render_options known = with_map(options);
    rt_scene_info info;
    rt_scene_get_info(scene, &info);
    /* What a film to be continued was not begun with is refused, and needs no warning. */
    if (!is_given(arguments, OPTION_RESUME))
        warn_settings(arguments, &known);
    warn_photons(arguments, options, info.scatters);
    if (is_given(arguments, OPTION_JSON) && !is_given(arguments, OPTION_STATS))
        message_warning("--json has no effect without --stats");
    if (is_given(arguments, OPTION_COUNT_RAYS) && !is_given(arguments, OPTION_STATS))
        message_warning("--count-rays has no effect without --stats, but on the time");
    if (is_given(arguments, OPTION_DENOISER) && !is_given(arguments, OPTION_DENOISE))
        message_warning("--denoiser has no effect without --denoise");
    warn_outputs(arguments, options, outputs);
}
