/* mitsuba_value.c - numbers, colours and transforms of Mitsuba's XML. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mitsuba.h"
#include "dsl/import/spectrum.h"

enum { AGAIN_MAX = 16 * IMPORT_SHAPES_MAX, PARAMETER_LENGTH = 128, VALUE_LENGTH_MAX = 1 << 20 };

int rt_mitsuba_is(const char *written, const char *name)
{
    for (; *written && *name; written++, name++) {
        if (*name == '_' && isupper((unsigned char)*written)) {
            name++;
            if (tolower((unsigned char)*written) != *name)
                return 0;
        } else if (*written != *name && tolower((unsigned char)*written) != *name) {
            return 0;
        }
    }
    return *written == *name;
}

/* The value of the parameter whose name the text begins with, and how long that is; or NULL. */
static const char *find_parameter(mitsuba *m, const char *text, size_t *length)
{
    char name[PARAMETER_LENGTH];
    *length = 0;
    while (*length < sizeof name - 1 &&
           (isalnum((unsigned char)text[*length]) || text[*length] == '_'))
        ++*length;
    for (memcpy(name, text, *length); *length > 0; --*length) {
        name[*length] = '\0';
        const char *const set = rt_import_parameter(m->import, name);
        if (set)
            return set;
        const int at = rt_name_table_find(&m->default_names, name);
        if (at >= 0)
            return m->defaults[at];
    }
    return NULL;
}

/* Puts the values of parameters into *value, which is moved; returns 0 where one has none. */
static int put_parameters(mitsuba *m, char **value)
{
    import_text made = {NULL, 0, 0};
    int has_all = 1;
    for (const char *at = *value; *at && has_all; at++) {
        size_t length;
        const char *const with = *at == '$' ? find_parameter(m, at + 1, &length) : NULL;
        if (with)
            rt_import_put(m->import, &made, "%s", with), at += length;
        else if (*at == '$')
            has_all = 0;
        else
            rt_import_put(m->import, &made, "%c", *at);
        has_all &= made.size <= VALUE_LENGTH_MAX;
    }
    if (has_all && made.text) {
        free(*value);
        *value = made.text;
    } else {
        free(made.text);
    }
    return has_all;
}

/* An attribute with its parameters; *is_known: whether all of these have values. */
static const char *text_of(mitsuba *m, xml_node *node, const char *attribute, int *is_known)
{
    int i = 0;
    while (i < node->attribute_count && strcmp(node->names[i], attribute) != 0)
        i++;
    *is_known = 1;
    if (i == node->attribute_count)
        return "";
    if (strchr(node->values[i], '$'))
        *is_known = put_parameters(m, &node->values[i]);
    return node->values[i];
}

const char *rt_mitsuba_text(mitsuba *m, xml_node *node, const char *attribute)
{
    int is_known;
    const char *value = text_of(m, node, attribute, &is_known);
    if (is_known)
        return value;
    rt_import_fail(rt_mitsuba_at(m, node), node->line, "'%.60s' has no <default>", value);
    return "";
}

/* The children whose names may be mistyped ones of this, a constant. */
static void offer_name(xml_node *node, const char *name)
{
    for (xml_node *child = node->first; child; child = child->next) {
        const char *const written = rt_xml_attribute(child, "name");
        if (!written || child->is_read != UNREAD)
            continue;
        if (!child->meant.wanted)
            rt_nearest_begin(&child->meant, written, strlen(written));
        rt_nearest_offer(&child->meant, name, strlen(name));
    }
}

xml_node *rt_mitsuba_child(xml_node *node, const char *name)
{
    for (xml_node *child = node->first; child; child = child->next) {
        const char *written = rt_xml_attribute(child, "name");
        if (written && rt_mitsuba_is(written, name))
            return child;
    }
    offer_name(node, name);
    return NULL;
}

/*
 * The child of that name with one of the tags ("float integer"), marked; or NULL, also where its
 * value is that of a parameter that has none.
 */
static xml_node *take(mitsuba *m, xml_node *node, const char *tags, const char *name)
{
    xml_node *child = rt_mitsuba_child(node, name);
    const char *at = child ? strstr(tags, child->tag) : NULL;
    size_t length = child ? strlen(child->tag) : 0;
    if (!at || (at > tags && at[-1] != ' ') || (at[length] != ' ' && at[length] != '\0')) {
        if (child && !child->expected)
            child->expected = tags;
        return NULL;
    }
    child->is_read = READ;
    int is_known;
    const char *const value = text_of(m, child, "value", &is_known);
    if (is_known)
        return child;
    rt_import_note_at(rt_mitsuba_at(m, child), child->line,
                      "'%.60s' has no <default>: '%.40s' counts as not given", value, name);
    return NULL;
}

/* Numbers of a text, separated by spaces or commas; returns how many, -1 where it has others. */
static int read_numbers(const char *text, double *out, int most)
{
    int count = 0;
    for (;;) {
        text += strspn(text, " \t\r\n,");
        if (!*text)
            return count;
        if (count == most || !rt_import_number(&out[count], &text))
            return -1;
        count++;
    }
}

#define NO_VALUE "is empty"

/* What is wrong with the text of a number; NULL: nothing, and *out is it. */
static const char *fault_of(const xml_node *node, const char *text, double *out)
{
    if (!*text)
        return NO_VALUE;
    if (read_numbers(text, out, 1) != 1)
        return "is not a finite number";
    return strcmp(node->tag, "integer") == 0 && *out != floor(*out) ? "is no whole number" : NULL;
}

/* A value that is wrong counts as not given. */
static void note_wrong(mitsuba *m, const xml_node *node, const char *name, const char *text,
                       const char *fault)
{
    rt_import_note_at(rt_mitsuba_at(m, node), node->line, "'%.60s' %s: '%.40s' counts as not given",
                      text, fault, name);
}

double rt_mitsuba_number(mitsuba *m, xml_node *node, const char *name, double fallback)
{
    xml_node *child = take(m, node, "float integer", name);
    double value = fallback;
    const char *const text = child ? rt_mitsuba_text(m, child, "value") : "",
                      *const fault = child ? fault_of(child, text, &value) : NULL;
    if (!fault)
        return value;
    note_wrong(m, child, name, text, fault);
    return fallback;
}

int rt_mitsuba_flag(mitsuba *m, xml_node *node, const char *name, int fallback)
{
    xml_node *child = take(m, node, "boolean", name);
    if (!child)
        return fallback;
    const char *value = rt_mitsuba_text(m, child, "value");
    int is_true = rt_mitsuba_is(value, "true");
    if (is_true || rt_mitsuba_is(value, "false"))
        return is_true;
    note_wrong(m, child, name, value, "is neither true nor false");
    return fallback;
}

const char *rt_mitsuba_string(mitsuba *m, xml_node *node, const char *name)
{
    xml_node *child = take(m, node, "string", name);
    return child ? rt_mitsuba_text(m, child, "value") : NULL;
}

#define NO_TRIPLE "is not one or three finite numbers"

/*
 * x, y and z, or value: one number for all, or three. Returns NULL, or the text that is wrong; then
 * *out is unchanged.
 */
static const char *find_triple(mitsuba *m, xml_node *node, double out[3], double fallback)
{
    static const char *const axes[] = {"x", "y", "z"};
    const char *value = rt_mitsuba_text(m, node, "value");
    double found[3] = {fallback, fallback, fallback};
    const int count = *value ? read_numbers(value, found, 3) : 0;
    if (count == -1 || count == 2)
        return value;
    for (int c = 1; c < 3 && count == 1; c++)
        found[c] = found[0];
    for (int c = 0; c < 3 && count == 0; c++) {
        const char *const text =
            rt_xml_attribute(node, axes[c]) ? rt_mitsuba_text(m, node, axes[c]) : NULL;
        if (text && fault_of(node, text, &found[c]))
            return text;
    }
    memcpy(out, found, sizeof found);
    return NULL;
}

/* The same of a value that a default stands in for; returns whether it is there. */
static int take_triple(mitsuba *m, xml_node *node, const char *name, double out[3])
{
    const char *const value = rt_mitsuba_text(m, node, "value");
    const int is_given = value[strspn(value, " \t\r\n,")] || rt_xml_attribute(node, "x") ||
                         rt_xml_attribute(node, "y") || rt_xml_attribute(node, "z");
    const char *const wrong = is_given ? find_triple(m, node, out, 0) : "";
    if (wrong)
        note_wrong(m, node, name, wrong, is_given ? NO_TRIPLE : NO_VALUE);
    return wrong == NULL;
}

int rt_mitsuba_vector(mitsuba *m, xml_node *node, const char *name, double out[3])
{
    xml_node *child = take(m, node, "point vector", name);
    return child && take_triple(m, child, name, out);
}

/* #rrggbb, which is sRGB, but for that of an <rgb> of Mitsuba 0.x. */
static int read_hex(const char *text, int is_linear, double out[3])
{
    if (text[0] != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
        return 0;
    unsigned long value = strtoul(text + 1, NULL, 16);
    for (int c = 0; c < 3; c++) {
        const double part = (double)(value >> (16 - 8 * c) & 0xff) / 255;
        out[c] = is_linear ? part : rt_import_decode_srgb(part);
    }
    return 1;
}

/* What a spectrum is of, by what it stands in. */
static spectrum_use use_of(const xml_node *node)
{
    const char *const name = rt_xml_attribute(node, "name");
    if (name && (strcmp(name, "eta") == 0 || strcmp(name, "k") == 0))
        return SPECTRUM_INDEX;
    while (node->parent && strcmp(node->parent->tag, "emitter") != 0)
        node = node->parent;
    return node->parent ? SPECTRUM_EMISSION : SPECTRUM_REFLECTANCE;
}

/* Ends the colour of a spectrum, which was read or not. */
static void end_spectrum(mitsuba *m, xml_node *node, int is_read, spectrum *s, double out[3])
{
    if (is_read)
        rt_spectrum_colour(rt_mitsuba_at(m, node), node->line, s, use_of(node), out);
    rt_spectrum_free(s);
}

/* Values at wavelengths that are even, or that are given. */
static int read_points(mitsuba *m, xml_node *node, int is_even, spectrum *out)
{
    const double least = rt_mitsuba_number(m, node, "wavelength_min", 360),
                 most = rt_mitsuba_number(m, node, "wavelength_max", 830);
    const char *values = rt_mitsuba_string(m, node, "values"),
               *at = is_even ? NULL : rt_mitsuba_string(m, node, "wavelengths");
    double value, wavelength;
    size_t count = 0;
    for (const char *rest = values ? values : ""; *(rest += strspn(rest, " ,\t\r\n")); count++)
        if (!rt_import_number(&value, &rest))
            return rt_import_fail(rt_mitsuba_at(m, node), node->line,
                                  "'%.60s': expected the values of a spectrum", rest);
    for (size_t i = 0; i < count; i++) {
        values += strspn(values, " ,\t\r\n");
        rt_import_number(&value, &values);
        wavelength = least + (most - least) * (double)i / (count > 1 ? (double)count - 1 : 1);
        at += at ? strspn(at, " ,\t\r\n") : 0;
        if (!is_even && (!at || !rt_import_number(&wavelength, &at)))
            return rt_import_fail(rt_mitsuba_at(m, node), node->line,
                                  "a spectrum has fewer wavelengths than values");
        if (!rt_spectrum_add(rt_mitsuba_at(m, node), node->line, out, wavelength, value))
            return 0;
    }
    return count > 0 ||
           rt_import_fail(rt_mitsuba_at(m, node), node->line, "a spectrum without values");
}

/* Its temperature, in kelvin: an element, or an attribute of Mitsuba 0.x, "5500" or "5500K". */
static void read_black_body(mitsuba *m, xml_node *node, double out[3])
{
    const char *at = rt_mitsuba_text(m, node, "temperature"),
               *scaled = rt_mitsuba_text(m, node, "scale");
    double kelvin = *at ? -1 : rt_mitsuba_number(m, node, "temperature", 5000), scale = 1;
    if (*at && (!rt_import_number(&kelvin, &at) || at[strspn(at, "kK ")]))
        kelvin = -1;
    if (*scaled && (!rt_import_number(&scale, &scaled) || *scaled)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the scale of a <blackbody> is left out: it is a number");
        scale = 1;
    }
    if (kelvin >= 100 && kelvin <= 1e6)
        rt_spectrum_black_body(kelvin, out);
    else
        rt_import_note_at(
            rt_mitsuba_at(m, node), node->line,
            "a black body became white of 1: its temperature is from 100 to 1e6 kelvin");
    for (int c = 0; c < 3; c++)
        out[c] *= scale;
}

void rt_mitsuba_spectrum(mitsuba *m, xml_node *node, double out[3])
{
    const char *type = rt_mitsuba_text(m, node, "type");
    const int is_even = strcmp(type, "regular") == 0;
    spectrum s = {NULL, NULL, 0};
    out[0] = out[1] = out[2] = 1;
    if (strcmp(type, "uniform") == 0) {
        out[0] = out[1] = out[2] = rt_mitsuba_number(m, node, "value", 1);
    } else if (strcmp(type, "d65") == 0) {
        out[0] = out[1] = out[2] = rt_mitsuba_number(m, node, "scale", 1);
    } else if (strcmp(type, "srgb") == 0) {
        rt_mitsuba_colour(m, node, "color", out);
    } else if (is_even || strcmp(type, "irregular") == 0) {
        end_spectrum(m, node, read_points(m, node, is_even, &s), &s, out);
    } else if (strcmp(type, "blackbody") == 0 || strcmp(node->tag, "blackbody") == 0) {
        read_black_body(m, node, out);
    } else {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a <%.40s>%s%.40s%s is unknown: white of 1 stands in its place",
                          node->tag, *type ? " of type '" : "", type, *type ? "'" : "");
        rt_mitsuba_leave(node);
    }
}

/* A spectrum by pairs, in a file, or the same at all wavelengths; returns whether it is there. */
static int read_spectrum(mitsuba *m, xml_node *node, const char *name, const char *text,
                         double out[3])
{
    const char *const file = rt_mitsuba_text(m, node, "filename");
    spectrum s = {NULL, NULL, 0};
    int is_read;
    if (*file)
        is_read = rt_spectrum_read_file(rt_mitsuba_at(m, node), node->line, &s, file);
    else if (strchr(text, ':'))
        is_read = rt_spectrum_read(rt_mitsuba_at(m, node), node->line, &s, text);
    else {
        double value[3] = {0, 0, 0};
        if (!take_triple(m, node, name, value))
            return 0;
        memcpy(out, value, sizeof value);
        /* Mitsuba 0.x has one value for all channels, Mitsuba 3 for all wavelengths. */
        if (value[0] != value[1] || value[1] != value[2] || m->is_old ||
            use_of(node) == SPECTRUM_REFLECTANCE)
            return 1;
        is_read = rt_spectrum_add(m->import, node->line, &s, 360, value[0]) &&
                  rt_spectrum_add(m->import, node->line, &s, 830, value[0]);
    }
    end_spectrum(m, node, is_read, &s, out);
    return 1;
}

int rt_mitsuba_colour(mitsuba *m, xml_node *node, const char *name, double out[3])
{
    xml_node *child = take(m, node, "rgb srgb spectrum float blackbody", name);
    if (!child)
        return 0;
    const char *text = rt_mitsuba_text(m, child, "value");
    if (strcmp(child->tag, "rgb") == 0 || strcmp(child->tag, "srgb") == 0) {
        if (read_hex(text, m->is_old && strcmp(child->tag, "rgb") == 0, out))
            return 1;
        const int is_given = take_triple(m, child, name, out);
        for (int c = 0; c < 3 && is_given && strcmp(child->tag, "srgb") == 0; c++)
            out[c] = rt_import_decode_srgb(out[c]);
        return is_given;
    } else if (strcmp(child->tag, "spectrum") == 0 &&
               (rt_xml_attribute(child, "value") || rt_xml_attribute(child, "filename"))) {
        return read_spectrum(m, child, name, text, out);
    } else if (strcmp(child->tag, "float") == 0) {
        double value;
        const char *const fault = fault_of(child, text, &value);
        if (fault)
            note_wrong(m, child, name, text, fault);
        else
            out[0] = out[1] = out[2] = value;
        return fault == NULL;
    } else if (!*rt_mitsuba_text(m, child, "type") && strcmp(child->tag, "spectrum") == 0) {
        note_wrong(m, child, name, "", NO_VALUE);
        return 0;
    } else {
        rt_mitsuba_spectrum(m, child, out);
    }
    return 1;
}

/* ---- Transforms -------------------------------------------------------------- */

/* Each step: *out; or nothing where it is wrong, which is told. */
static void read_matrix(mitsuba *m, xml_node *node, matrix *out)
{
    double values[16];
    int count = read_numbers(rt_mitsuba_text(m, node, "value"), values, 16);
    if (count != 9 && count != 16) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a <matrix> of other than 9 or 16 finite numbers is left out");
        return;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < (count == 16 ? 4 : 3); j++)
            out->m[i][j] = values[i * (count == 16 ? 4 : 3) + j];
    if (count == 16 && (values[12] != 0 || values[13] != 0 || values[14] != 0 || values[15] != 1))
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the last row of a matrix is left out");
}

static void read_lookat(mitsuba *m, xml_node *node, matrix *out)
{
    double origin[3], target[3], up[3] = {0, 1, 0}, left[3], direction[3];
    if (read_numbers(rt_mitsuba_text(m, node, "origin"), origin, 3) != 3 ||
        read_numbers(rt_mitsuba_text(m, node, "target"), target, 3) != 3 ||
        (rt_xml_attribute(node, "up") &&
         read_numbers(rt_mitsuba_text(m, node, "up"), up, 3) != 3)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a lookat is left out: its origin, target and up are three numbers each");
        return;
    }
    for (int c = 0; c < 3; c++)
        direction[c] = target[c] - origin[c];
    rt_vector_normalize(direction);
    rt_vector_cross(left, up, direction);
    const double aside = rt_vector_length(left);
    if (!rt_vector_normalize(left) || aside < 1e-6 * rt_vector_length(up)) {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a lookat is left out: it has no direction, or its up is along it");
        return;
    }
    rt_vector_cross(up, direction, left);
    for (int c = 0; c < 3; c++) {
        out->m[c][0] = left[c];
        out->m[c][1] = up[c];
        out->m[c][2] = direction[c];
        out->m[c][3] = origin[c];
    }
}

static void read_rotate(mitsuba *m, xml_node *node, const double axis[3], matrix *out)
{
    const char *const text = rt_mitsuba_text(m, node, "angle");
    const double length = rt_vector_length(axis);
    double angle = 0;
    const char *const fault = length > 0 ? fault_of(node, text, &angle) : NULL;
    if (length == 0)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a <rotate> is left out: its axis is zero");
    else if (fault)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "a <rotate> is left out: its angle '%.60s' %s", text, fault);
    else if (fabs(length - 1) < 1e-3 || m->is_old) {
        *out = rt_matrix_rotate(angle, axis);
    } else {
        /* Mitsuba 3 does so, and shears. */
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the axis of a rotation has the length %g: as in Mitsuba 3, it is not "
                          "made 1, and shapes are sheared",
                          length);
        *out = rt_matrix_rotate_as_is(angle, axis);
    }
}

static matrix read_step(mitsuba *m, xml_node *node)
{
    const int is_scale = strcmp(node->tag, "scale") == 0,
              is_rotate = strcmp(node->tag, "rotate") == 0;
    matrix out = rt_matrix_identity();
    double v[3] = {0, 0, 0};
    node->is_read = READ;
    if (is_scale || is_rotate || strcmp(node->tag, "translate") == 0) {
        const char *const wrong = find_triple(m, node, v, is_scale);
        if (wrong)
            rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                              "a <%s> is left out: '%.60s' " NO_TRIPLE, node->tag, wrong);
        else if (is_rotate)
            read_rotate(m, node, v, &out);
        else
            out = is_scale ? rt_matrix_scale(v[0], v[1], v[2])
                           : rt_matrix_translate(v[0], v[1], v[2]);
    } else if (strcmp(node->tag, "lookat") == 0 || strcmp(node->tag, "lookAt") == 0) {
        read_lookat(m, node, &out);
    } else if (strcmp(node->tag, "matrix") == 0) {
        read_matrix(m, node, &out);
    } else {
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "the step <%.40s> of a transform is unknown, and left out", node->tag);
    }
    return out;
}

matrix rt_mitsuba_transform(mitsuba *m, xml_node *node, const char *name)
{
    xml_node *transform = take(m, node, "transform", name);
    matrix out = rt_matrix_identity();
    if (!transform)
        return out;
    for (xml_node *step = transform->first; step; step = step->next) {
        matrix next = read_step(m, step);
        out = rt_matrix_multiply(&next, &out);
    }
    return out;
}

xml_node *rt_mitsuba_follow(mitsuba *m, xml_node *node)
{
    if (strcmp(node->tag, "ref") != 0 && strcmp(node->tag, "alias") != 0)
        return node;
    const char *id = rt_mitsuba_text(m, node, "id");
    const int at = rt_name_table_find(&m->ids, id);
    if (at >= 0)
        return m->named[at];
    if (node->is_read != LEFT_OUT)
        rt_import_note_at(rt_mitsuba_at(m, node), node->line,
                          "there is no element with the id '%.60s' so far: the <%s> is left out",
                          id, node->tag);
    rt_mitsuba_leave(node);
    return NULL;
}

void rt_mitsuba_read(mitsuba *m, xml_node *node, xml_node *named)
{
    node->is_read = named->is_read = READ;
    m->again += node != named ? named->size : 0;
    if (m->again > AGAIN_MAX)
        rt_import_fail(rt_mitsuba_at(m, node), node->line,
                       "references come to more than %d elements", AGAIN_MAX);
}
