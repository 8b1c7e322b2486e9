/*
 * compare.c - `rtc compare`: how much images differ from a reference, and whether by more than is
 * allowed.
 */
#include "commands.h"
#include "compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "inputs.h"
#include "message.h"
#include "outputs.h"
#include "recorded.h"
#include "status.h"
#include "session.h"

/* ---- Limits --------------------------------------------------------------- */

const compare_limit compare_limits[COMPARE_LIMITS] = {
    {OPTION_MAX_MSE, "mse", 0},        {OPTION_MAX_RMSE, "rmse", 0},
    {OPTION_MAX_RELMSE, "relmse", 0},  {OPTION_MAX_BIAS, "bias", 0},
    {OPTION_MIN_SSIM, "ssim", 1},      {OPTION_MAX_FLIP, "flip", 0},
    {OPTION_MAX_OFF, "blocks off", 0},
};

double compare_measured(const compare_limit *limit, const rt_comparison_info *info)
{
    const option_id option = limit->option;
    return option == OPTION_MAX_MSE      ? info->mse
           : option == OPTION_MAX_RMSE   ? info->rmse
           : option == OPTION_MAX_RELMSE ? info->relmse
           : option == OPTION_MAX_BIAS   ? fabs(info->ratio - 1.0)
           : option == OPTION_MIN_SSIM   ? info->ssim
           : option == OPTION_MAX_FLIP   ? info->flip
                                         : (double)info->off;
}

int compare_given(const compare_limit *limit, const command_line *arguments)
{
    return arguments->options[limit->option].given;
}

double compare_allowed(const compare_limit *limit, const command_line *arguments)
{
    const option_value *value = &arguments->options[limit->option];
    return option_table[limit->option].kind == KIND_WHOLE ? (double)value->count : value->real;
}

int compare_kept(const compare_limit *limit, const command_line *arguments,
                 const rt_comparison_info *info)
{
    double measured = compare_measured(limit, info), allowed = compare_allowed(limit, arguments);
    return limit->is_least ? measured >= allowed : measured <= allowed;
}

/* Says that a limit is not kept because what it is for is not known, and why. */
static void say_unknown(const compare_limit *limit, const rt_comparison_info *info)
{
    const char *name = option_table[limit->option].name;
    if (limit->option == OPTION_MIN_SSIM)
        message_note("the pictures are too small for --%s: %ux%u pixels, and its window has 11x11",
                     name, (unsigned)info->width, (unsigned)info->height);
    else
        message_note("%s is unknown, and not within --%s: %s", limit->measure, name,
                     limit->option == OPTION_MAX_BIAS ? "the mean of the reference is 0"
                                                      : "no pixel is finite");
}

/*
 * Says which limits are broken; whether all are kept. Pixels that are not finite break any limit.
 */
static int check_limits(const command_line *arguments, const rt_comparison_info *info)
{
    int given = 0, within = 1;
    for (int i = 0; i < COMPARE_LIMITS; i++) {
        const compare_limit *limit = &compare_limits[i];
        if (!compare_given(limit, arguments))
            continue;
        given = 1;
        if (compare_kept(limit, arguments, info))
            continue;
        within = 0;
        if (isnan(compare_measured(limit, info))) {
            say_unknown(limit, info);
            continue;
        }
        message_note("%s %.6g is %s --%s %.6g", limit->measure, compare_measured(limit, info),
                     limit->is_least ? "not at least" : "over", option_table[limit->option].name,
                     compare_allowed(limit, arguments));
    }
    unsigned long long not_finite[2] = {info->not_finite[0], info->not_finite[1]};
    if (given && not_finite[0] + not_finite[1] > 0) {
        message_note("%llu pixels, and %llu of the reference, are not finite: within no limit",
                     not_finite[0], not_finite[1]);
        within = 0;
    }
    return within;
}

/* ---- The command ---------------------------------------------------------- */

static void free_images(rt_image **images, size_t count)
{
    for (size_t i = 0; images && i < count; i++)
        rt_image_destroy(images[i]);
    free(images);
}

/* Reads all images that the command line names; says of each that cannot be read why. */
static int read_images(rt_image ***out, const command_line *arguments)
{
    size_t count = arguments->operand_count;
    rt_image **images = calloc(count, sizeof *images);
    int status = STATUS_DONE;
    if (!images) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    for (size_t i = 0; i < count; i++) {
        char word[RECORDED_WORD_SIZE];
        rt_error error;
        if (rt_image_read(&images[i], arguments->operands[i], &error) == RT_OK)
            continue;
        int now = message_failure(&error);
        if (strcasecmp(outputs_extension(arguments->operands[i]), ".rtpart") == 0 &&
            access(arguments->operands[i], F_OK) == 0)
            message_hint("`rtc merge %s --out NAME.exr` makes an image of a film",
                         recorded_word(word, arguments->operands[i]));
        status = status == STATUS_DONE ? now : status;
    }
    if (status == STATUS_DONE)
        *out = images;
    else
        free_images(images, count);
    return status;
}

static int compare_images(rt_comparison **out, rt_image **images, const command_line *arguments)
{
    const option_value *given = arguments->options;
    rt_compare_options options = {0};
    rt_error error;
    size_t count = arguments->operand_count - 1;
    options.layer = given[OPTION_LAYER].text;
    options.block = (uint32_t)given[OPTION_BLOCK].count;
    options.tolerance = given[OPTION_TOLERANCE].real;
    options.exposure = given[OPTION_COMPARE_EXPOSURE].real;
    options.names = arguments->operands;
    rt_status status = rt_image_compare(out, (const rt_image *const *)images, count, images[count],
                                        &options, &error);
    if (status == RT_OK)
        return STATUS_DONE;
    const int failed = session_fail(&error);
    if (strstr(error.message, "no layer"))
        message_hint("`rtc SCENE --aov --out NAME.exr` writes layers");
    return failed;
}

static int write_differences(const output_list *outputs, const rt_comparison *comparison,
                             double scale)
{
    int status = STATUS_DONE;
    for (size_t i = 0; i < outputs->count; i++) {
        rt_error error;
        if (rt_comparison_write_difference(comparison, outputs->paths[i], scale, &error) == RT_OK)
            continue;
        int now = message_failure(&error);
        status = status == STATUS_DONE ? now : status;
    }
    return status;
}

/*
 * Where renders share photons, neighbouring blocks are off together, which one render does not
 * show.
 */
static void warn_shared_photons(const command_line *arguments, const rt_comparison_info *info)
{
    size_t last = arguments->operand_count - 1;
    if (info->shares_photons[0])
        message_warning("%s: the noise of one photon render is understated, for its pixels share "
                        "photons; give several "
                        "of other seeds",
                        arguments->operands[0]);
    if (info->shares_photons[1])
        message_warning("%s: the noise of a reference of photon mode is understated, for its "
                        "pixels share photons",
                        arguments->operands[last]);
}

/*
 * Prints the results and writes the difference pictures; images that differ too much are no
 * success.
 */
static int report(const rt_comparison *comparison, const command_line *arguments,
                  const output_list *outputs)
{
    rt_comparison_info info;
    rt_comparison_get_info(comparison, &info);
    warn_shared_photons(arguments, &info);
    int within = check_limits(arguments, &info);
    if (arguments->options[OPTION_JSON].given)
        compare_print_json(comparison, arguments, within);
    else
        compare_print_text(comparison, arguments);
    int status = write_differences(outputs, comparison, arguments->options[OPTION_SCALE].real);
    return status == STATUS_DONE && !within ? STATUS_INPUT : status;
}

/* Whether no difference picture replaces an image that is compared. */
static int check_inputs(const command_line *arguments, const output_list *outputs)
{
    input_list inputs = {0};
    int status = STATUS_DONE;
    for (size_t i = 0; i < arguments->operand_count; i++)
        inputs_add(&inputs, arguments->operands[i]);
    for (size_t i = 0; i < outputs->count && status == STATUS_DONE; i++)
        status = inputs_check(&inputs, outputs->paths[i]);
    inputs_free(&inputs);
    return status;
}

/* Whether renders that are to be independent are different files. */
static int check_renders(const command_line *arguments)
{
    for (size_t i = 0; i + 1 < arguments->operand_count; i++)
        for (size_t j = 0; j < i; j++)
            if (inputs_are_same(arguments->operands[j], arguments->operands[i])) {
                message_error(
                    "%s is given twice: several renders must be independent, of different seeds",
                    arguments->operands[i]);
                return STATUS_USAGE;
            }
    return STATUS_DONE;
}

int command_compare(const command_line *arguments)
{
    rt_image **images = NULL;
    rt_comparison *comparison = NULL;
    output_list outputs = {0};
    if (arguments->operand_count < 2) {
        message_error("which images? usage: rtc compare A... B [OPTION]...");
        return STATUS_USAGE;
    }
    int status = outputs_plan(&outputs, arguments, NULL, 0, 0);
    if (status == STATUS_DONE && outputs_films(&outputs) > 0) {
        message_error("--out: a difference is an image, no film");
        status = STATUS_USAGE;
    }
    if (status == STATUS_DONE)
        status = check_inputs(arguments, &outputs);
    if (status == STATUS_DONE)
        status = check_renders(arguments);
    if (status == STATUS_DONE && arguments->options[OPTION_SCALE].given &&
        !outputs_have_8bit(&outputs))
        message_warning("--scale has no effect without --out to a .png or .ppm");
    if (status == STATUS_DONE)
        status = read_images(&images, arguments);
    if (status == STATUS_DONE)
        status = compare_images(&comparison, images, arguments);
    if (status == STATUS_DONE)
        status = report(comparison, arguments, &outputs);
    rt_comparison_destroy(comparison);
    free_images(images, arguments->operand_count);
    outputs_free(&outputs);
    return status;
}
