/* photons_illuminance.c - `rtc photons illuminance`: the light that a map brings to points. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "json.h"
#include "message.h"
#include "photons.h"
#include "session.h"
#include "settings.h"
#include "status.h"

enum { POINTS_BYTES_MAX = 1 << 30, NUMBERS = 6 };

/* Points that were read, and what is known of them. */
typedef struct points {
    float *positions, *normals; /* [capacity][3] */
    rt_photon_reading *readings;
    size_t count, capacity;
} points;

static void points_free(points *p)
{
    free(p->positions);
    free(p->normals);
    free(p->readings);
}

static int points_reserve(points *p)
{
    if (p->count < p->capacity)
        return STATUS_DONE;
    const size_t capacity = p->capacity ? 2 * p->capacity : 256;
    float *positions = realloc(p->positions, capacity * 3 * sizeof *positions);
    p->positions = positions ? positions : p->positions;
    float *normals = realloc(p->normals, capacity * 3 * sizeof *normals);
    p->normals = normals ? normals : p->normals;
    if (!positions || !normals) {
        message_error("out of memory for %zu points", capacity);
        return STATUS_DEVICE;
    }
    p->capacity = capacity;
    return STATUS_DONE;
}

/* Reads the numbers of a line, which a comment may end; how many, or -1: there is more. */
static int read_numbers(double out[NUMBERS], const char *line)
{
    for (int count = 0;; count++) {
        line += strspn(line, " \t\r,");
        if (*line == '\0' || *line == '#')
            return count;
        char *end;
        const double value = strtod(line, &end);
        if (end == line || count == NUMBERS || !isfinite(value) || !strchr(" \t\r,#", *end))
            return -1;
        out[count] = value;
        line = end;
    }
}

/* Takes the point of a line; normals are made unit. */
static int add_point(points *p, const char *path, size_t number, const char *line)
{
    double v[NUMBERS] = {0};
    const int count = read_numbers(v, line);
    if (count == 0)
        return STATUS_DONE;
    const double length = sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
    if ((count != 3 && count != NUMBERS) || (count == NUMBERS && !(length > 0))) {
        message_error(
            "%s:%zu: a line should be x y z, or x y z nx ny nz with a normal other than 0", path,
            number);
        return STATUS_INPUT;
    }
    const int status = points_reserve(p);
    if (status != STATUS_DONE)
        return status;
    for (int c = 0; c < 3; c++) {
        p->positions[3 * p->count + (size_t)c] = (float)v[c];
        p->normals[3 * p->count + (size_t)c] = count == NUMBERS ? (float)(v[3 + c] / length) : 0;
    }
    p->count++;
    return STATUS_DONE;
}

static int read_points(points *p, const char *path)
{
    size_t size, number = 0;
    char *text;
    rt_error error;
    if (rt_file_load(&text, &size, path, POINTS_BYTES_MAX, &error) != RT_OK)
        return message_failure(&error);
    int status = STATUS_DONE;
    if (memchr(text, '\0', size)) {
        message_error("%s is no text", path);
        status = STATUS_INPUT;
    }
    for (char *line = text + rt_byte_order_mark(text, size); line && status == STATUS_DONE;) {
        char *end = strchr(line, '\n');
        if (end)
            *end++ = '\0';
        status = add_point(p, path, ++number, line);
        line = end;
    }
    free(text);
    if (status == STATUS_DONE && p->count == 0) {
        message_error("%s has no points", path);
        status = STATUS_INPUT;
    }
    return status;
}

/* ---- Results ------------------------------------------------------------------------- */

static const char head[] =
    "# x y z [m], irradiance R G B [W/m^2], its standard error, illuminance [lx], its standard "
    "error,\n# fluence rate R G B [W/m^2], its standard error\n";

static void print_numbers(const double *values, int count)
{
    for (int i = 0; i < count; i++)
        printf(" %.6g", values[i]);
}

/* The fewest digits that read back as the number. */
static const char *shortest(char *out, size_t size, float value)
{
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(out, size, "%.*g", digits, value);
        if (strtof(out, NULL) == value)
            break;
    }
    return out;
}

static void print_lines(const points *p)
{
    char text[32];
    fputs(head, stdout);
    for (size_t i = 0; i < p->count; i++) {
        const float *x = p->positions + 3 * i;
        const rt_photon_reading *r = p->readings + i;
        for (int c = 0; c < 3; c++)
            printf("%s%s", c ? " " : "", shortest(text, sizeof text, x[c]));
        print_numbers(r->irradiance, 3);
        print_numbers(r->irradiance_error, 3);
        print_numbers(&r->illuminance, 1);
        print_numbers(&r->illuminance_error, 1);
        print_numbers(r->fluence, 3);
        print_numbers(r->fluence_error, 3);
        putchar('\n');
    }
}

static void print_json(const points *p)
{
    char text[32];
    for (size_t i = 0; i < p->count; i++) {
        const float *x = p->positions + 3 * i;
        const rt_photon_reading *r = p->readings + i;
        printf("{\"position\":");
        for (int c = 0; c < 3; c++)
            printf("%c%s", c ? ',' : '[', shortest(text, sizeof text, x[c]));
        putchar(']');
        json_triple("irradiance", r->irradiance);
        json_triple("irradiance_error", r->irradiance_error);
        json_member("illuminance", r->illuminance);
        json_member("illuminance_error", r->illuminance_error);
        json_triple("fluence", r->fluence);
        json_triple("fluence_error", r->fluence_error);
        printf(",\"photons\":%zu,\"volume_photons\":%zu", r->photons, r->volume_photons);
        json_member("radius", r->radius);
        json_member("volume_radius", r->volume_radius);
        puts("}");
    }
}

/* ---- The form ------------------------------------------------------------------------- */

/* The value of a setting, or its default. */
static double value_of(const char *name, const rt_render_options *options)
{
    const rt_setting *setting = rt_setting_find(name);
    const double value = rt_setting_value(setting, options);
    return value > 0 ? value : strtod(setting->field.fallback, NULL);
}

/* Warns where a list has fewer photons than an estimate wants. */
static void warn_of_few(const rt_photon_map *map, const rt_render_options *options)
{
    static const char *const names[] = {"", "caustic ", "volume "};
    const double k_of_all = value_of("k", options), caustic_k = value_of("caustic_k", options),
                 ks[] = {k_of_all, caustic_k > 0 ? caustic_k : k_of_all,
                         value_of("volume_k", options)};
    for (int kind = 0; kind < 3; kind++) {
        const size_t count = rt_photon_map_count(map, (rt_photon_kind)kind);
        const double k = ks[kind];
        if (count > 0 && k != RT_K_ALL && k > (double)count)
            message_warning("the map has %zu %sphoton%s, fewer than the %.0f nearest that an "
                            "estimate wants",
                            count, names[kind], count == 1 ? "" : "s", k);
    }
}

/* What a reading says of photons on surfaces, or in media. */
typedef struct neighbourhood {
    size_t photons;
    double nearest, radius;
} neighbourhood;

static neighbourhood on_surfaces(const rt_photon_reading *r)
{
    return (neighbourhood){r->photons, r->nearest, r->radius};
}

static neighbourhood in_media(const rt_photon_reading *r)
{
    return (neighbourhood){r->volume_photons, r->volume_nearest, r->volume_radius};
}

/*
 * Warns of points that lie off what the photons lie on, or in. If n photons lie in a disc or sphere
 * by chance, none of them is in the part nearer than the nearest in (1 - part)^n of all cases.
 */
static void warn_of_far(const points *p, neighbourhood (*around)(const rt_photon_reading *r),
                        int dimensions, const char *away_from, const char *within)
{
    const double rarely = 1e-9;
    size_t far = 0, first = 0;
    for (size_t i = 0; i < p->count; i++) {
        const neighbourhood n = around(p->readings + i);
        const double part = n.radius > 0 ? pow(n.nearest / n.radius, dimensions) : 0;
        if (n.photons == 0 || pow(1 - part, (double)n.photons) > rarely)
            continue;
        first = far++ == 0 ? i : first;
    }
    const neighbourhood n = around(p->readings + first);
    if (far > 0)
        message_warning("of %zu points %zu lie%s %s: the nearest to point %zu is %.3g m away, in a "
                        "%s of radius %.3g m",
                        p->count, far, far == 1 ? "s" : "", away_from, first + 1, n.nearest, within,
                        n.radius);
}

/* Warns where points lie on surfaces and no photon does. */
static void warn_of_none(const points *p, const rt_photon_map *map)
{
    if (rt_photon_map_count(map, RT_PHOTONS_GLOBAL) + rt_photon_map_count(map, RT_PHOTONS_CAUSTIC))
        return;
    for (size_t i = 0; i < p->count; i++) {
        const float *n = p->normals + 3 * i;
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) {
            message_warning("no photon lies on a surface, so that all irradiance is 0: they are "
                            "stored where a material has `kd`, and on rough metals with "
                            "--gather-roughness");
            return;
        }
    }
}

static int estimate(points *p, const rt_photon_map *map, const command_line *arguments)
{
    const int is_quiet = arguments->options[OPTION_QUIET].given;
    rt_render_options options = {0};
    rt_photon_map_info info;
    rt_error error;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    settings_apply(arguments, &options, NULL);
    p->readings = calloc(p->count, sizeof *p->readings);
    if (!p->readings) {
        message_error("out of memory for %zu points", p->count);
        return STATUS_DEVICE;
    }
    rt_photon_map_get_info(map, &info);
    if (info.direct != RT_DIRECT_PHOTONS && !is_quiet)
        message_warning("the map leaves direct light to shadow rays, so it is missing: emit with "
                        "--direct photons");
    if (rt_photon_map_illuminance(p->readings, map, p->positions, p->normals, p->count,
                                  cores > 0 ? (uint32_t)cores : 1, &options, &error) != RT_OK) {
        /* The points are of a file, and of no option. */
        if (strcmp(error.field, "positions") == 0)
            error.field[0] = '\0';
        return session_fail(&error);
    }
    if (!is_quiet) {
        warn_of_few(map, &options);
        warn_of_far(p, on_surfaces, 2, "off the surfaces that photons lie on", "disc");
        warn_of_far(p, in_media, 3, "outside of the media that photons lie in", "sphere");
        warn_of_none(p, map);
    }
    return STATUS_DONE;
}

int photons_illuminance(const command_line *arguments)
{
    rt_photon_map *map = NULL;
    points p = {0};
    if (arguments->operand_count != 3) {
        message_error("usage: rtc photons illuminance MAP POINTS");
        message_hint("`rtc photons illuminance --help` says what a line of points is");
        return STATUS_USAGE;
    }
    int status = read_points(&p, arguments->operands[2]);
    if (status == STATUS_DONE)
        status = photons_load(&map, arguments->operands[1], arguments);
    if (status == STATUS_DONE)
        status = estimate(&p, map, arguments);
    if (status == STATUS_DONE && arguments->options[OPTION_JSON].given)
        print_json(&p);
    else if (status == STATUS_DONE)
        print_lines(&p);
    rt_photon_map_destroy(map);
    points_free(&p);
    return status;
}
