/*
 * ies.c - reads IES files: lines of words up to that of TILT, then numbers, which commas and white
 * space part.
 *
 * Reference:
 *   ANSI/IESNA LM-63-02: "Standard File Format for the Electronic Transfer of Photometric Data".
 */
#include "scene/ies.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/file.h"
#include "scene/check.h"
#include "scene/light_table.h"

static const double pi = 3.14159265358979323846;

/* ---- Words ------------------------------------------------------------------- */

typedef struct reader {
    const uint8_t *at, *end;
    uint32_t line;
    rt_error *error;
} reader;

#define FAIL(r, ...) fail_at((r), rt_fail((r)->error, RT_ERROR_INPUT, __VA_ARGS__))

static rt_status fail_at(const reader *r, rt_status status)
{
    if (r->error)
        r->error->line = r->line;
    return status;
}

static int is_delimiter(uint8_t c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',';
}

/* What stands behind TILT=, which may have spaces around the sign; NULL: it is another line. */
static const uint8_t *behind_tilt(const uint8_t *line, const uint8_t *end)
{
    if (end - line < 5 || strncasecmp((const char *)line, "TILT", 4) != 0)
        return NULL;
    for (line += 4; line < end && *line == ' ';)
        line++;
    if (line == end || *line != '=')
        return NULL;
    for (line++; line < end && *line == ' ';)
        line++;
    return line;
}

/* Passes the lines before that of TILT and the word behind it. */
static rt_status skip_header(reader *r)
{
    while (r->at < r->end) {
        const uint8_t *line = r->at, *end = memchr(line, '\n', (size_t)(r->end - line));
        end = end ? end : r->end;
        r->line++;
        r->at = end < r->end ? end + 1 : end;
        if (!(line = behind_tilt(line, end)))
            continue;
        for (; end > line && is_delimiter(end[-1]);)
            end--;
        if (end - line == 4 && strncasecmp((const char *)line, "NONE", 4) == 0) {
            r->line++;
            return RT_OK;
        }
        return FAIL(r, "an IES file with TILT=%.*s; only TILT=NONE is supported",
                    end - line > 40 ? 40 : (int)(end - line), (const char *)line);
    }
    return FAIL(r, "not an IES file: it has no line that begins with TILT=");
}

/* Decimal digits, a point, an exponent, by hand: strtod would follow the locale. */
static int parse_number(double *out, const char *word)
{
    double value = 0;
    int exponent = 0, written = 0, digits = 0, is_behind = 0, sign = 1;
    size_t i = word[0] == '-' || word[0] == '+';
    for (; (word[i] >= '0' && word[i] <= '9') || (word[i] == '.' && !is_behind); i++) {
        if (word[i] == '.') {
            is_behind = 1;
            continue;
        }
        value = 10 * value + (word[i] - '0');
        exponent -= is_behind;
        digits++;
    }
    if (digits > 0 && (word[i] == 'e' || word[i] == 'E')) {
        i++;
        if (word[i] == '-' || word[i] == '+')
            sign = word[i++] == '-' ? -1 : 1;
        digits = word[i] >= '0' && word[i] <= '9';
        for (; word[i] >= '0' && word[i] <= '9'; i++)
            written = written < 1000 ? 10 * written + (word[i] - '0') : written;
    }
    exponent += sign * written;
    /* A quotient by a power of ten rounds once, where a product would twice. */
    value = exponent < 0 ? value / pow(10, -exponent) : value * pow(10, exponent);
    *out = word[0] == '-' ? -value : value;
    return digits > 0 && word[i] == '\0';
}

/* The next number; what: its name in messages. */
static rt_status read_number(reader *r, const char *what, double *out)
{
    char word[32];
    size_t length = 0;
    while (r->at < r->end && is_delimiter(*r->at))
        r->line += *r->at++ == '\n';
    while (r->at < r->end && !is_delimiter(*r->at) && length < sizeof word - 1)
        word[length++] = (char)*r->at++;
    word[length] = '\0';
    if (length == 0)
        return FAIL(r, "an IES file ends where its %s should be", what);
    if (!parse_number(out, word) || (r->at < r->end && !is_delimiter(*r->at)))
        return FAIL(r, "an IES file has '%.31s' where its %s should be a number", word, what);
    if (!(fabs(*out) <= RT_COLOUR_MAX))
        return FAIL(r, "an IES file has a %s of %.31s, which is too large", what, word);
    return RT_OK;
}

static rt_status read_count(reader *r, const char *what, rt_u32 *out)
{
    double value = 0;
    const rt_status status = read_number(r, what, &value);
    if (status != RT_OK)
        return status;
    if (!(value >= 1 && value <= RT_IES_ANGLES_MAX && value == floor(value)))
        return FAIL(r, "an IES file has %s %g; it must be a whole number from 1 to %d", what, value,
                    RT_IES_ANGLES_MAX);
    *out = (rt_u32)value;
    return RT_OK;
}

/* ---- The numbers -------------------------------------------------------------- */

typedef struct ies {
    rt_u32 vertical, horizontal; /* angles */
    double scale;                /* of candela */
    double *angles;              /* [vertical + horizontal], degrees */
    float *candela;              /* [horizontal][vertical], scaled */
} ies;

/* The two lines of numbers before the angles. */
static rt_status read_sizes(reader *r, ies *f)
{
    static const char *const names[] = {
        "photometric type",      "units",      "width", "length", "height", "ballast factor",
        "second ballast factor", "input watts"};
    double sources, lumens, numbers[8];
    rt_status status = read_number(r, "number of sources", &sources);
    if (status == RT_OK)
        status = read_number(r, "lumens of a source", &lumens);
    if (status == RT_OK)
        status = read_number(r, "candela multiplier", &f->scale);
    if (status == RT_OK)
        status = read_count(r, "number of vertical angles", &f->vertical);
    if (status == RT_OK)
        status = read_count(r, "number of horizontal angles", &f->horizontal);
    for (int i = 0; i < 8 && status == RT_OK; i++) {
        status = read_number(r, names[i], numbers + i);
        if (status == RT_OK && i == 0 && numbers[0] != 1)
            return FAIL(r, "an IES file of photometric type %s (%g); only type C (1) is supported",
                        numbers[0] == 2   ? "B"
                        : numbers[0] == 3 ? "A"
                                          : "unknown",
                        numbers[0]);
        if (status == RT_OK && i == 1 && numbers[1] != 1 && numbers[1] != 2)
            return FAIL(r, "an IES file with units %g; they are 1, feet, or 2, metres", numbers[1]);
    }
    if (status != RT_OK)
        return status;
    f->scale *= numbers[5] * numbers[6];
    if (!(f->scale > 0 && f->scale <= RT_COLOUR_MAX))
        return FAIL(r,
                    "an IES file whose multiplier and ballast factors make %g; their product "
                    "must be above 0",
                    f->scale);
    return RT_OK;
}

static rt_status read_angles(reader *r, const char *what, double *angles, rt_u32 count, double most)
{
    rt_status status = RT_OK;
    for (rt_u32 i = 0; i < count && status == RT_OK; i++) {
        status = read_number(r, what, angles + i);
        if (status == RT_OK && !(angles[i] >= 0 && angles[i] <= most))
            return FAIL(r, "an IES file with the %s %g; it must lie from 0 to %g", what, angles[i],
                        most);
        if (status == RT_OK && i > 0 && !(angles[i] - angles[i - 1] >= 1e-3))
            return FAIL(r, "an IES file whose %s %g follows on %g; they must ascend", what,
                        angles[i], angles[i - 1]);
    }
    return status;
}

/* The ranges that say how the rest follows by symmetry. */
static rt_status check_range(const reader *r, const ies *f)
{
    const double *h = f->angles + f->vertical, first = h[0], last = h[f->horizontal - 1];
    if (f->vertical < 2)
        return FAIL(r, "an IES file with one vertical angle; there must be two or more");
    if (first == 0 && (last == 0 || last == 90 || last == 180 || last == 360))
        return RT_OK;
    return FAIL(r,
                "an IES file whose horizontal angles go from %g to %g; they are 0 alone, or go "
                "from 0 to 90, 180 or 360",
                first, last);
}

static rt_status read_candela(reader *r, ies *f)
{
    const size_t count = (size_t)f->vertical * f->horizontal;
    for (size_t i = 0; i < count; i++) {
        double value;
        const rt_status status = read_number(r, "candela value", &value);
        if (status != RT_OK)
            return status;
        value *= f->scale;
        if (!(value >= 0 && value <= RT_COLOUR_MAX))
            return FAIL(r, "an IES file with %g candela; they must lie from 0 to %g", value,
                        RT_COLOUR_MAX);
        f->candela[i] = (float)value;
    }
    return RT_OK;
}

/* More numbers than the counts say are of other counts than the file has. */
static rt_status check_end(reader *r, const ies *f)
{
    while (r->at < r->end && is_delimiter(*r->at))
        r->line += *r->at++ == '\n';
    if (r->at == r->end)
        return RT_OK;
    return FAIL(r,
                "an IES file goes on behind the candela values of its %u vertical and %u "
                "horizontal angles",
                f->vertical, f->horizontal);
}

/* ---- The table ----------------------------------------------------------------- */

/* An angle about the axis, degrees, and the column of the file that it has. */
typedef struct plane {
    double angle;
    rt_u32 column;
} plane;

/* All around, ascending: those of the file, and what mirrors them. Returns how many. */
static rt_u32 unfold(const ies *f, plane *out)
{
    const double *h = f->angles + f->vertical;
    const rt_u32 n = f->horizontal;
    rt_u32 count = 0;
    for (rt_u32 i = 0; i < n; i++)
        out[count++] = (plane){h[i], i};
    for (double last = h[n - 1]; n > 1 && last < 360; last *= 2)
        for (rt_u32 i = count - 1; i-- > 0;)
            out[count++] = (plane){2 * last - out[i].angle, out[i].column};
    if (n == 1)
        out[count++] = (plane){360, 0};
    return count;
}

static rt_status make_table(rt_scene_light_table *out, const ies *f, rt_memory *memory,
                            rt_error *error)
{
    plane *around =
        rt_memory_alloc(memory, 4 * (size_t)f->horizontal, sizeof *around, "an IES file", error);
    if (!around)
        return RT_ERROR_MEMORY;
    rt_scene_light_table t = {.columns = unfold(f, around) - 1, .rows = f->vertical - 1};
    const rt_status status = rt_light_table_alloc(&t, memory, error);
    for (rt_u32 i = 0; i <= t.columns && status == RT_OK; i++) {
        const float *column = f->candela + (size_t)around[i].column * f->vertical;
        t.lines[i] = (float)(around[i].angle * pi / 180);
        for (rt_u32 row = 0; row <= t.rows; row++) {
            float *value = t.values + 4 * ((size_t)row * (t.columns + 1) + i);
            value[0] = value[1] = value[2] = column[row];
        }
    }
    for (rt_u32 row = 0; row <= t.rows && status == RT_OK; row++)
        t.lines[t.columns + 1 + row] = (float)(f->angles[row] * pi / 180);
    rt_memory_free(around);
    if (status == RT_OK)
        *out = t;
    return status;
}

rt_status rt_ies_decode(rt_scene_light_table *out, const rt_bytes *file, rt_memory *memory,
                        rt_error *error)
{
    reader r = {file->data, file->data + file->size, 0, error};
    ies f = {0};
    rt_status status = skip_header(&r);
    if (status == RT_OK)
        status = read_sizes(&r, &f);
    if (status != RT_OK)
        return status;
    /* Each number takes two bytes, but for the last. */
    const size_t angles = (size_t)f.vertical + f.horizontal,
                 count = (size_t)f.vertical * f.horizontal;
    if (angles + count > (size_t)(r.end - r.at) / 2 + 1)
        return FAIL(&r,
                    "an IES file of %u vertical and %u horizontal angles, which is too short "
                    "for them",
                    f.vertical, f.horizontal);
    f.angles = rt_memory_alloc(memory, angles, sizeof *f.angles, "an IES file", error);
    f.candela =
        f.angles ? rt_memory_alloc(memory, count, sizeof *f.candela, "an IES file", error) : NULL;
    status =
        f.candela ? read_angles(&r, "vertical angle", f.angles, f.vertical, 180) : RT_ERROR_MEMORY;
    if (status == RT_OK)
        status = read_angles(&r, "horizontal angle", f.angles + f.vertical, f.horizontal, 360);
    if (status == RT_OK)
        status = check_range(&r, &f);
    if (status == RT_OK)
        status = read_candela(&r, &f);
    if (status == RT_OK)
        status = check_end(&r, &f);
    if (status == RT_OK)
        status = make_table(out, &f, memory, error);
    rt_memory_free(f.angles);
    rt_memory_free(f.candela);
    return status;
}

rt_status rt_ies_read(rt_scene_light_table *out, const char *path, rt_memory *memory,
                      rt_error *error)
{
    rt_bytes file = {.memory = memory};
    rt_status status = rt_file_check_regular(path, error);
    if (status == RT_OK)
        status = rt_file_read(&file, path, RT_IES_BYTES_MAX, error);
    if (status == RT_OK)
        status = rt_ies_decode(out, &file, memory, error);
    rt_bytes_free(&file);
    return rt_at_file(status, path, error);
}
