/* word.c - lists of words, and the known name that a mistyped one probably meant. */
#include <stdio.h>
#include <string.h>

#include "rt/field.h"

#define LENGTH_MAX 48   /* longer names get no suggestion */
#define BEGINNING_MIN 4 /* letters of a word that may stand for a name that it begins */

/* ---- Lists ---------------------------------------------------------------- */

static int is_same(char a, char b)
{
    return (a == '_' ? '-' : a) == (b == '_' ? '-' : b);
}

const rt_word *rt_word_find(const rt_word *words, const char *text, size_t length)
{
    for (; words && words->name; words++) {
        size_t i = 0;
        while (i < length && words->name[i] && is_same(words->name[i], text[i]))
            i++;
        if (i == length && !words->name[i])
            return words;
    }
    return NULL;
}

const char *rt_words_join(char *out, size_t size, const rt_word *words)
{
    size_t used = 0;
    out[0] = '\0';
    for (size_t i = 0; words[i].name && used < size; i++) {
        const char *before = i == 0 ? "" : words[i + 1].name ? ", " : " or ";
        used += (size_t)snprintf(out + used, size - used, "%s%s", before, words[i].name);
    }
    return out;
}

/* ---- The nearest name ------------------------------------------------------- */

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

size_t rt_edit_distance(const char *a, size_t a_length, const char *b, size_t b_length,
                        size_t limit)
{
    size_t gap = a_length > b_length ? a_length - b_length : b_length - a_length;
    if (a_length > LENGTH_MAX || b_length > LENGTH_MAX || gap > limit)
        return limit + 1;

    /* rows[i % 3][j]: distance of the first i letters of a and the first j of b. */
    size_t rows[3][LENGTH_MAX + 1];
    for (size_t j = 0; j <= b_length; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *above2 = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            char x = lower(a[i - 1]), y = lower(b[j - 1]);
            row[j] = least(above[j - 1] + (x != y), 1 + least(above[j], row[j - 1]));
            if (i > 1 && j > 1 && x == lower(b[j - 2]) && y == lower(a[i - 2]))
                row[j] = least(row[j], above2[j - 2] + 1);
        }
    }
    return least(rows[a_length % 3][b_length], limit + 1);
}

/* How far a name of this length may be from the one it meant. */
static size_t tolerance(size_t length)
{
    return length < 3 ? 0 : length < 5 ? 1 : length < 9 ? 2 : 3;
}

/* What other programs call a thing, and what it is called here: as near as if it were mistyped. */
static const struct {
    const char *other, *name;
} synonyms[] = {
    {"cube", "box"},
    {"ball", "sphere"},
    {"rectangle", "quad"},
    {"disk", "disc"},
    {"albedo", "kd"},
    {"diffuse", "kd"},
    {"color", "kd"},
    {"colour", "kd"},
    {"color", "radiance"},
    {"colour", "radiance"},
    {"color", "intensity"},
    {"colour", "intensity"},
    {"color", "irradiance"},
    {"colour", "irradiance"},
    {"specular", "ks"},
    {"transmission", "kt"},
    {"emit", "emission"},
    {"emissive", "emission"},
    {"samples", "spp"},
    {"output", "out"},
    {"depth", "max_depth"},
    {"bounces", "max_depth"},
    {"max_bounces", "max_depth"},
    {"samples_per_pixel", "spp"},
    {"integrator", "mode"},
    {"algorithm", "mode"},
    {"resolution", "width"},
    {"res", "width"},
    {"size", "width"},
    {"gpu", "device"},
    {"cpu", "device"},
    {"jobs", "threads"},
    {"position", "eye"},
    {"from", "eye"},
    {"target", "look_at"},
    {"lookat", "look_at"},
    {"position", "centre"},
    {"color", "material"},
    {"colour", "material"},
    {"bsdf", "material"},
    {"shader", "material"},
    {"sun", "directional"},
    {"distant", "directional"},
    {"laser", "beam"},
    {"collimated", "beam"},
    {"infinite", "environment"},
    {"sky", "environment"},
    {"dome", "environment"},
    {"envmap", "environment"},
    {"spotlight", "spot"},
    {"omni", "point"},
    {"on", "dielectric"},
    {"true", "dielectric"},
    {"yes", "dielectric"},
    {"false", "off"},
    {"no", "off"},
    {"none", "off"},
    {"pathtrace", "path"},
    {"pathtracer", "path"},
    {"pathtracing", "path"},
    {"path-tracing", "path"},
    {"photon-mapping", "photon"},
    {"photonmap", "photon"},
    {"sppm", "photon"},
    {"normal", "normals"},
    {"normal_map", "normal_texture"},
    {"normalmap", "normal_texture"},
    {"bump_map", "bump_texture"},
    {"metalness", "metallic"},
    {"specular_tint", "spec_tint"},
    {"clearcoat_roughness", "coat_roughness"},
    {"sheen_roughness", "fuzz_roughness"},
    {"int_ior", "ior"},
    {"radiance", "emission"},
    {"intensity", "radiance"},
    {"translate", "offset"},
    {"interpolation", "filter"},
    {"srgb", "linear"},
    {"gamma", "linear"},
    {"color1", "a"},
    {"color2", "b"},
    {"ppm", "photon"},
    {"one_sided", "back"},
    {"transparency", "kt"},
    {"alpha", "opacity"},
    {"shininess", "exponent"},
    {"smoothness", "roughness"},
    {"glossiness", "roughness"},
    {"albedo_texture", "kd_texture"},
    {"diffuse_texture", "kd_texture"},
    {"coat_color", "coat_absorption"},
    {"coat_colour", "coat_absorption"},
    {"emission_strength", "emission"},
    {"direction", "target"},
    {"angle", "outer"},
    {"index", "ior"},
    {"filename", "file"},
    {"image", "file"},
    {"checkerboard", "checker"},
    {"tile", "repeat"},
    {"clamp_to_edge", "clamp"},
    {"steel", "stainless_steel"},
};

static int is_text(const char *text, size_t length, const char *word)
{
    size_t i = 0;
    while (i < length && word[i] && is_same(lower(text[i]), word[i]))
        i++;
    return i == length && !word[i];
}

static int is_synonym(const char *other, size_t other_length, const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; i++)
        if (is_text(other, other_length, synonyms[i].other) &&
            is_text(name, length, synonyms[i].name))
            return 1;
    return 0;
}

/* Whether a word of some letters is the beginning of a name, as `ortho` is. */
static int is_beginning(const char *text, size_t text_length, const char *name, size_t length)
{
    size_t i = 0;
    while (i < text_length && i < length && lower(text[i]) == lower(name[i]))
        i++;
    return i == text_length && text_length >= BEGINNING_MIN;
}

void rt_nearest_begin(rt_nearest *search, const char *wanted, size_t length)
{
    memset(search, 0, sizeof *search);
    search->wanted = wanted;
    search->wanted_length = length;
    search->distance = tolerance(length) + 1;
}

void rt_nearest_offer(rt_nearest *search, const char *name, size_t length)
{
    if (search->distance == 0)
        return;
    size_t distance =
        rt_edit_distance(search->wanted, search->wanted_length, name, length, search->distance - 1);
    if (is_synonym(search->wanted, search->wanted_length, name, length))
        distance = 0;
    else if (is_beginning(search->wanted, search->wanted_length, name, length) && distance > 1)
        distance = 1;
    if (distance < search->distance) {
        search->distance = distance;
        search->best = name;
        search->best_length = length;
    }
}

void rt_nearest_offer_words(rt_nearest *search, const rt_word *words)
{
    for (; words && words->name; words++)
        rt_nearest_offer(search, words->name, strlen(words->name));
}
