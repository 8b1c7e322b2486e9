/*
 * compare_print.c - the results of `rtc compare` on stdout: lines for a person, or JSON for a
 * program.
 */
#include <math.h>
#include <stdio.h>

#include "compare.h"
#include "json.h"

static const char *const channel_names[3] = {"R", "G", "B"};

/* ---- Text ------------------------------------------------------------------- */

static double ratio(const rt_image_block *b, uint32_t channel)
{
    return b->mean[channel] / b->reference[channel];
}

static double ratio_error(const rt_image_block *b, uint32_t channel)
{
    return b->error[channel] / fabs(b->reference[channel]);
}

enum { SHOWN = 32 }; /* room for a number */

/* A number, or that there is none. */
static const char *show(char out[SHOWN], const char *format, double value)
{
    if (isnan(value))
        return "unknown";
    snprintf(out, SHOWN, format, value);
    return out;
}

static void print_number(const char *name, double value)
{
    char text[SHOWN];
    printf("%s: %s\n", name, show(text, "%.6g", value));
}

/* "1.02 +- 0.03" */
static const char *show_ratio(char out[2 * SHOWN + 4], double value, double error)
{
    char a[SHOWN], b[SHOWN];
    snprintf(out, 2 * SHOWN + 4, "%s +- %s", show(a, "%.6g", value), show(b, "%.2g", error));
    return out;
}

static void print_worst(const rt_comparison_info *info, const rt_image_block *blocks)
{
    const rt_image_block *b = &blocks[info->worst];
    uint32_t c = info->worst_channel;
    char text[2 * SHOWN + 4];
    printf("worst block: at %u %u, channel %s, %.6g for %.6g, ratio %s, %.3g of what is allowed\n",
           (unsigned)b->x, (unsigned)b->y, channel_names[c], b->mean[c], b->reference[c],
           show_ratio(text, ratio(b, c), ratio_error(b, c)), b->excess[c]);
}

/*
 * Each block on a line: its place, and by channel the ratio, its standard error and the part of
 * what is allowed.
 */
static void print_blocks(const rt_image_block *blocks, size_t count)
{
    char a[SHOWN], b[SHOWN];
    printf("# x y  ratio error excess of R  of G  of B\n");
    for (size_t i = 0; i < count; i++) {
        printf("%u %u", (unsigned)blocks[i].x, (unsigned)blocks[i].y);
        for (uint32_t c = 0; c < 3; c++)
            printf("  %s %s %.3g", show(a, "%.6g", ratio(&blocks[i], c)),
                   show(b, "%.2g", ratio_error(&blocks[i], c)), blocks[i].excess[c]);
        putchar('\n');
    }
}

void compare_print_text(const rt_comparison *comparison, const command_line *arguments)
{
    rt_comparison_info info;
    size_t count;
    const rt_image_block *blocks = rt_comparison_blocks(comparison, &count);
    rt_comparison_get_info(comparison, &info);
    char ratio_text[2 * SHOWN + 4], text[SHOWN];
    printf("size: %ux%u\n", (unsigned)info.width, (unsigned)info.height);
    print_number("mse", info.mse);
    print_number("rmse", info.rmse);
    print_number("relmse", info.relmse);
    printf("ratio: %s\n", show_ratio(ratio_text, info.ratio, info.ratio_error));
    printf("ratio by channel:");
    for (int c = 0; c < 3; c++)
        printf(" %s", show(text, "%.6g", info.ratio_rgb[c]));
    putchar('\n');
    print_number("ssim", info.ssim);
    printf("flip: %.6g\ntypical difference: %.4g\n", info.flip, info.typical);
    printf("not finite: %llu and %llu\n", (unsigned long long)info.not_finite[0],
           (unsigned long long)info.not_finite[1]);
    printf("blocks: %zu\nblocks off: %zu\n", info.blocks, info.off);
    print_worst(&info, blocks);
    if (arguments->options[OPTION_BLOCKS].given)
        print_blocks(blocks, count);
}

/* ---- JSON ------------------------------------------------------------------- */

static void put_block(const rt_image_block *b)
{
    printf("{\"x\":%u,\"y\":%u,\"width\":%u,\"height\":%u", (unsigned)b->x, (unsigned)b->y,
           (unsigned)b->width, (unsigned)b->height);
    json_triple("mean", b->mean);
    json_triple("reference", b->reference);
    json_triple("error", b->error);
    json_triple("excess", b->excess);
    putchar('}');
}

static void put_names(const command_line *arguments)
{
    size_t count = arguments->operand_count - 1;
    fputs("{\"images\":[", stdout);
    for (size_t i = 0; i < count; i++) {
        if (i)
            putchar(',');
        json_string(arguments->operands[i]);
    }
    fputs("],\"reference\":", stdout);
    json_string(arguments->operands[count]);
    fputs(",\"layer\":", stdout);
    if (arguments->options[OPTION_LAYER].given)
        json_string(arguments->options[OPTION_LAYER].text);
    else
        fputs("null", stdout);
}

static void put_limits(const command_line *arguments, const rt_comparison_info *info)
{
    int first = 1;
    fputs(",\"limits\":[", stdout);
    for (int i = 0; i < COMPARE_LIMITS; i++) {
        const compare_limit *limit = &compare_limits[i];
        if (!compare_given(limit, arguments))
            continue;
        printf("%s{\"option\":\"%s\"", first ? "" : ",", option_table[limit->option].name);
        json_member("limit", compare_allowed(limit, arguments));
        json_member("measured", compare_measured(limit, info));
        printf(",\"kept\":%s}", compare_kept(limit, arguments, info) ? "true" : "false");
        first = 0;
    }
    putchar(']');
}

void compare_print_json(const rt_comparison *comparison, const command_line *arguments, int within)
{
    rt_comparison_info info;
    size_t count;
    const rt_image_block *blocks = rt_comparison_blocks(comparison, &count);
    rt_comparison_get_info(comparison, &info);
    put_names(arguments);
    printf(",\"width\":%u,\"height\":%u,\"not_finite\":[%llu,%llu]", (unsigned)info.width,
           (unsigned)info.height, (unsigned long long)info.not_finite[0],
           (unsigned long long)info.not_finite[1]);
    json_member("mse", info.mse);
    json_member("rmse", info.rmse);
    json_member("relmse", info.relmse);
    json_member("ratio", info.ratio);
    json_member("ratio_error", info.ratio_error);
    printf(",\"shares_photons\":[%s,%s]", info.shares_photons[0] ? "true" : "false",
           info.shares_photons[1] ? "true" : "false");
    json_triple("ratio_rgb", info.ratio_rgb);
    json_member("ssim", info.ssim);
    json_member("flip", info.flip);
    json_member("typical", info.typical);
    printf(",\"blocks\":%zu,\"off\":%zu,\"worst_channel\":\"%s\",\"worst\":", info.blocks, info.off,
           channel_names[info.worst_channel]);
    put_block(&blocks[info.worst]);
    for (size_t i = 0; i < count && arguments->options[OPTION_BLOCKS].given; i++) {
        fputs(i ? "," : ",\"block_list\":[", stdout);
        put_block(&blocks[i]);
        if (i + 1 == count)
            putchar(']');
    }
    put_limits(arguments, &info);
    printf(",\"within\":%s}\n", within ? "true" : "false");
}
