/*
 * mtl.c - the materials of OBJ files (Alias/Wavefront, "Object Files", appendix B1).
 *
 * Kd and Ks are the albedos of the diffuse and the specular lobe, in linear light. The exponent
 * Ns of Phong's lobe becomes alpha = sqrt(2 / (Ns + 2)) of GGX (Walter et al. 2007). illum 4, 6, 7
 * and 9 are glass of index Ni, unless Pm says that it is a metal; else d below 1 is a sheet that
 * transmits the rest without refraction. Whatever else illum says, Pr, Pm and the like make the
 * surface that mtl_pbr.h tells of. A map multiplies its colour, Kd or Ke, which is white where
 * there is none, but takes the place of Pr and Pm.
 */
#include "dsl/import/mtl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/mtl_line.h"

/* A map, and whether the colour that it multiplies is given. */
typedef struct mtl_map {
    int line, has_colour; /* line: 0 for no map */
} mtl_map;

typedef struct mtl_reader {
    importer *import;
    mtl_list *list;
    char *name;                     /* of the material that is read, or NULL */
    import_material material, base; /* base: before its PBR fields */
    mtl_pbr pbr;
    double ka[3], tf[3], opacity, exponent;
    double transparency; /* by Tr, or -1 */
    int illum, line, has_exponent, has_opacity;
    int is_blender;  /* the file is by Blender */
    int has_pbr;     /* whether a line of Pr, Pm and the like was there, */
    int has_any_pbr; /* and in any material */
    mtl_map kd, ks, ke, d, pr, pm, normals;
    int begin;     /* the line of its newmtl */
    unsigned seen; /* a bit for each property that was given */
    size_t told;   /* of the import, there */
    int is_known;  /* its name is that of an earlier one */
} mtl_reader;

/* ---- Values ------------------------------------------------------------------ */

/* One to three numbers; 0 after a failure or a note. */
static int read_numbers(mtl_reader *r, char *line, double *out, int most)
{
    double read[3] = {0, 0, 0};
    int count = 0;
    char *word;
    while (count < most && (word = rt_mtl_next_word(&line)) != NULL) {
        const char *at = word;
        if (!rt_import_number(&read[count], &at) || *at) {
            rt_import_note_at(r->import, r->line,
                              count == 0 &&
                                      (strcmp(word, "spectral") == 0 || strcmp(word, "xyz") == 0)
                                  ? "material %.60s: a colour by '%.40s' is left out"
                                  : "material %.60s: a line with '%.40s', which is no number, is "
                                    "left out",
                              r->name, word);
            return 0;
        }
        count++;
    }
    if (count == 0) {
        rt_import_note_at(r->import, r->line,
                          "material %.60s: a line without its number is left out", r->name);
        return 0;
    }
    if (most == 3 && count == 2)
        rt_import_note_at(r->import, r->line, "two numbers are no colour: the third became %.9g",
                          read[0]);
    for (int c = 0; c < most; c++)
        out[c] = read[c < count ? c : 0];
    if (count == most && (word = rt_mtl_next_word(&line)) != NULL && *word != '#')
        rt_import_note_at(r->import, r->line,
                          "material %.60s: '%.40s' behind %d number%s is left out", r->name, word,
                          most, most > 1 ? "s" : "");
    return 1;
}

/* How many arguments an option of a map takes, at most; -1: unknown. */
static int option_arguments(const char *option)
{
    static const struct {
        const char *name;
        int count;
    } options[] = {{"-s", 3},       {"-o", 3},      {"-t", 3},    {"-mm", 2},    {"-bm", 1},
                   {"-blendu", 1},  {"-blendv", 1}, {"-cc", 1},   {"-clamp", 1}, {"-texres", 1},
                   {"-imfchan", 1}, {"-type", 1},   {"-boost", 1}};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcmp(option, options[i].name) == 0)
            return options[i].count;
    return -1;
}

/* Reads one option of a map into the texture. */
static void read_option(mtl_reader *r, import_texture *texture, const char *option, int is_bump,
                        char **line)
{
    int count = option_arguments(option);
    double values[3] = {0, 0, 0};
    int given = 0;
    for (; given < count; given++) {
        char *rest = *line + strspn(*line, " \t\r");
        const char *at = rest;
        if (count == 1)
            break;
        if (!rt_import_number(&values[given], &at) || !strchr(" \t\r", *at))
            break;
        rt_mtl_next_word(line);
    }
    char *word = count == 1 ? rt_mtl_next_word(line) : NULL;
    const char *number = word;
    values[1] = strcmp(option, "-s") == 0 && given == 1 ? 1 : values[1];
    if (strcmp(option, "-s") == 0 && given >= 1 && values[0] != 0 && values[1] != 0)
        memcpy(texture->scale, values, sizeof texture->scale);
    else if (strcmp(option, "-o") == 0 && given >= 1)
        memcpy(texture->offset, values, sizeof texture->offset);
    else if (strcmp(option, "-clamp") == 0 && word)
        texture->wrap = strcmp(word, "on") == 0 ? 2 : 0;
    else if (strcmp(option, "-imfchan") == 0 && word && word[0] && strchr("rgbml", word[0]) &&
             !is_bump)
        texture->channel = (char)(word[0] == 'm' ? 'a' : word[0] == 'l' ? 0 : word[0]);
    else if (strcmp(option, "-bm") == 0 && word && is_bump && rt_import_number(values, &number))
        r->material.normal_scale = values[0];
    else
        rt_import_note_at(r->import, r->line,
                          "material %.60s: the option %.20s of a map is left out", r->name, option);
}

/*
 * Whether the image of a map of bumps holds normals; heights, which have no unit, are left out. Of
 * `norm`, whose image says so by its name, it is told where it holds none.
 */
static int is_normal_map(mtl_reader *r, const char *word, const char *file)
{
    const int is_named = strcmp(word, "norm") == 0 || strcmp(word, "map_norm") == 0;
    if (!rt_import_has_file(r->import, file) || rt_mtl_holds_normals(r->import, r->line, file))
        return 1;
    if (is_named)
        rt_import_note_at(r->import, r->line,
                          "material %.60s: the image of '%.30s' holds no unit vectors, as a normal "
                          "map does",
                          r->name, word);
    else
        rt_import_note_at(r->import, r->line,
                          "material %.60s: '%.30s' is left out: its heights have no unit. Give the "
                          "scene a bump_texture with its bump_scale, or the file a normal map",
                          r->name, word);
    return is_named;
}

static int read_map(mtl_reader *r, mtl_map *map, const char *word, char *line)
{
    map->line = r->line;
    import_texture texture = {.scale = {1, 1}};
    texture.is_linear = map == &r->d || map == &r->pr || map == &r->pm || map == &r->normals;
    texture.power = map == &r->pr ? 2 : 0;
    char file[512], *rest;
    for (;;) {
        rest = line + strspn(line, " \t\r");
        if (*rest != '-')
            break;
        char *option = rt_mtl_next_word(&line);
        read_option(r, &texture, option, map == &r->normals, &line);
    }
    rest = rt_mtl_file(r->import, rest);
    if (++r->list->maps > MTL_MAPS_MAX) {
        rt_import_fail(r->import, r->line, "more than %d maps of materials", MTL_MAPS_MAX);
        return IMPORT_NONE;
    }
    if (map == &r->normals && *rest && !is_normal_map(r, word, rest))
        return IMPORT_NONE;
    if (!*rest)
        rt_import_note_at(r->import, r->line, "material %.60s: '%.30s' names no file", r->name,
                          word);
    if (!*rest || !rt_import_image_file(r->import, r->line, file, rest))
        return IMPORT_NONE;
    /* An image of colours with opacities beside them is meant by these. */
    if (map == &r->d && rt_import_file_has_alpha(r->import, rest))
        texture.channel = 'a';
    texture.file = file;
    return rt_import_add_texture(r->import, r->name, &texture);
}

/* ---- Materials --------------------------------------------------------------- */

static int is_black(const double colour[3])
{
    return !(colour[0] > 0 || colour[1] > 0 || colour[2] > 0);
}

/* What multiplies the maps: white where nothing does; tells of a map that has no effect. */
static void finish_maps(mtl_reader *r)
{
    import_material *m = &r->material;
    struct {
        const char *name;
        double *colour;
        mtl_map map;
        int is_white; /* where nothing gives it */
    } maps[] = {{"Kd", m->kd, r->kd, 1}, {"Ks", m->ks, r->ks, 0}, {"Ke", m->emission, r->ke, 1}};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        const mtl_map *map = &maps[i].map;
        if (map->line == 0)
            continue;
        if (!map->has_colour && maps[i].is_white)
            maps[i].colour[0] = maps[i].colour[1] = maps[i].colour[2] = 1;
        else if (!map->has_colour && rt_mtl_is_pbr(&r->pbr))
            continue; /* told with it */
        else if (!map->has_colour)
            rt_import_note_at(r->import, map->line,
                              "material %.60s: map_Ks is left out: it has no Ks to multiply",
                              r->name);
        else if (is_black(maps[i].colour))
            rt_import_note_at(
                r->import, map->line,
                "material %.60s: map_%s is multiplied by %s 0 0 0, and so black; other "
                "programs may show it: give %s 1 1 1",
                r->name, maps[i].name, maps[i].name, maps[i].name);
    }
}

static int is_glass(int illum)
{
    return illum == 4 || illum == 6 || illum == 7 || illum == 9;
}

/* Glass of index 1 and no colour could not be seen: it is what Maya writes for every material. */
static int is_maya_opaque(const mtl_reader *r)
{
    return r->material.ior == 1 && r->tf[0] == 1 && r->tf[1] == 1 && r->tf[2] == 1 &&
           r->opacity == 1 && r->d.line == 0;
}

/* What gives no colour at all is grey, as a material that is not there. */
static void find_colour(mtl_reader *r)
{
    double *const kd = r->material.kd;
    if (r->kd.has_colour || r->kd.line || r->ks.has_colour || r->ke.has_colour || r->ke.line ||
        is_glass(r->illum) || r->pbr.has_glass || (r->pbr.metallic > 0 && r->has_pbr))
        return;
    kd[0] = kd[1] = kd[2] = 0.7;
    rt_import_note_at(r->import, r->begin,
                      "material %.60s: it gives no colour: grey of 0.7 stands "
                      "in its place",
                      r->name);
}

static void make_glass(mtl_reader *r)
{
    import_material *m = &r->material;
    if (m->kd_texture != IMPORT_NONE || m->ks_texture != IMPORT_NONE)
        rt_import_note_at(r->import, r->begin,
                          "material %.60s: its maps are left out: illum %d is glass", r->name,
                          r->illum);
    if (r->opacity < 1 || m->opacity_texture != IMPORT_NONE)
        rt_import_note_at(r->import, r->begin,
                          "material %.60s: its d is left out: illum %d is glass", r->name,
                          r->illum);
    m->opacity_texture = IMPORT_NONE;
    memset(m->kd, 0, sizeof m->kd);
    memset(m->ks, 0, sizeof m->ks);
    memcpy(m->kt, r->tf, sizeof m->kt);
    m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
    if (!r->pbr.has_roughness)
        m->roughness = 0;
}

/* Files that know highlights alone mean a few percent by a Ks that is large here. */
static void note_highlight(mtl_reader *r)
{
    const double *const ks = r->material.ks, mean = (ks[0] + ks[1] + ks[2]) / 3;
    if (r->illum <= 2 && mean >= 0.1 && !is_black(r->material.kd))
        rt_import_note_at(
            r->import, r->begin,
            "material %.60s: its Ks of %.3g reflects that part of all light, as a metal "
            "does; for a highlight as of plastic give it 0.04",
            r->name, mean);
}

/* Adds a name with its handle to a table that lacks it. */
static void keep_name(importer *import, name_table *names, int **handles, const char *name,
                      int handle)
{
    int *moved = rt_import_grow(import, *handles, names->count, sizeof *moved);
    *handles = moved ? moved : *handles;
    const int at = moved ? rt_name_table_add(names, name) : -1;
    if (at < 0)
        rt_import_fail_memory(import);
    else
        (*handles)[at] = handle;
}

/* Glass of Blender, which may turn out to be a sheet. */
static void keep_glass(mtl_reader *r, int handle)
{
    mtl_list *const list = r->list;
    if (!r->is_blender || !rt_import_is_solid(&r->material))
        return;
    mtl_glass *const moved =
        rt_import_grow(r->import, list->glass, list->glass_count, sizeof *moved);
    if (!moved)
        return;
    list->glass = moved;
    r->pbr.is_sheet = 1;
    moved[list->glass_count++] = (mtl_glass){.solid = handle,
                                             .sheet = IMPORT_NONE,
                                             .library = (int)list->libraries.count - 1,
                                             .line = r->begin,
                                             .material = r->base,
                                             .pbr = r->pbr};
}

static void keep_default(mtl_reader *r, int handle)
{
    mtl_list *const list = r->list;
    const import_material *const m = &r->material;
    if (!r->is_blender || m->kd_texture != IMPORT_NONE || m->blend != IMPORT_NONE)
        return;
    for (int c = 0; c < 3; c++)
        if (fabs(m->kd[c] - 0.8) > 1e-6)
            return;
    mtl_default *const moved =
        rt_import_grow(r->import, list->defaults, list->default_count, sizeof *moved);
    if (!moved)
        return;
    list->defaults = moved;
    moved[list->default_count++] = (mtl_default){.plain = handle,
                                                 .coloured = IMPORT_NONE,
                                                 .library = (int)list->libraries.count - 1,
                                                 .line = r->begin,
                                                 .material = *m};
}

/*
 * Blender writes its principled materials into the fields of Phong's where it is not asked for Pr
 * and Pm, and reads them so: the mean of Ks as level, 0.5 by default, of Ka as metalness, roughness
 * as 1 - sqrt(Ns / 1000), and illum 9 for what has an opacity. What emits does so on both sides.
 */
static void read_as_blender(mtl_reader *r)
{
    mtl_pbr *const pbr = &r->pbr;
    const double *const emitted = r->material.emission;
    r->material.is_two_sided = emitted[0] > 0 || emitted[1] > 0 || emitted[2] > 0 ||
                               r->material.emission_texture != IMPORT_NONE;
    if (r->has_pbr)
        return;
    pbr->has_roughness = 1;
    pbr->roughness = r->has_exponent ? 1 - sqrt(fmin(fmax(r->exponent, 0), 1000) / 1000) : 1;
    if (r->illum >= 3 && r->illum <= 8)
        pbr->metallic = fmin((r->ka[0] + r->ka[1] + r->ka[2]) / 3, 1);
}

/* Of what Pr and Pm leave out: where there is no Pr, Ns says how rough it is, a map all of it. */
static void finish_pbr(mtl_reader *r)
{
    mtl_pbr *pbr = &r->pbr;
    if (!pbr->has_roughness)
        pbr->roughness = r->has_exponent ? sqrt(r->material.roughness) : 1;
    if (pbr->roughness_texture != IMPORT_NONE)
        pbr->roughness = 1;
    if (pbr->metallic_texture != IMPORT_NONE)
        pbr->metallic = 1;
    if (r->ks.has_colour)
        pbr->level = (r->material.ks[0] + r->material.ks[1] + r->material.ks[2]) / 3;
    if (r->material.ks_texture != IMPORT_NONE)
        rt_import_note_at(r->import, r->ks.line,
                          "material %.60s: map_Ks is left out: a plastic reflects alike all over",
                          r->name);
    pbr->transmission = (r->tf[0] + r->tf[1] + r->tf[2]) / 3;
    r->base = r->material;
    rt_mtl_make_pbr(r->import, r->begin, r->name, pbr, &r->material);
}

/* Adds the material that was read, of this handle, to the list. */
static void keep_material(mtl_reader *r, int handle)
{
    mtl_list *const list = r->list;
    keep_glass(r, handle);
    keep_default(r, handle);
    keep_name(r->import, &list->names, &list->materials, r->name, handle);
    if (rt_mtl_cut_comment(r->name) && rt_name_table_find(&list->bare, r->name) < 0)
        keep_name(r->import, &list->bare, &list->bare_materials, r->name, handle);
    free(r->name);
    r->name = NULL;
}

static void finish_material(mtl_reader *r)
{
    import_material *m = &r->material;
    if (!r->name)
        return;
    if (r->is_blender)
        read_as_blender(r);
    if (is_glass(r->illum) && !r->is_blender && is_maya_opaque(r)) {
        rt_import_note_at(r->import, r->begin,
                          "material %.60s: illum %d of Ni 1, as Maya writes what is opaque, is no "
                          "glass",
                          r->name, r->illum);
        r->illum = 2;
    }
    find_colour(r);
    finish_maps(r);
    if (r->pbr.has_roughness)
        m->roughness = r->pbr.roughness * r->pbr.roughness;
    else if (r->illum == 3 || r->illum == 5)
        m->roughness = 0;
    else if (r->has_exponent)
        m->roughness = sqrt(2 / (fmax(r->exponent, 0) + 2));
    const int is_solid = is_glass(r->illum) && !r->is_blender;
    if (is_solid && r->pbr.metallic > 0)
        rt_import_note_at(r->import, r->begin,
                          "material %.60s: illum %d, glass, is left out beside Pm, a metal",
                          r->name, r->illum);
    if (is_solid && r->pbr.metallic == 0)
        make_glass(r);
    else if (rt_mtl_is_pbr(&r->pbr))
        finish_pbr(r);
    else
        note_highlight(r);
    const int has_opacity = r->opacity < 1 || m->opacity_texture != IMPORT_NONE;
    if (has_opacity && !rt_import_is_solid(m))
        m->opacity = fmin(fmax(r->opacity, 1e-6), 1);
    else if (has_opacity && !is_solid)
        rt_import_note_at(r->import, r->begin, "material %.60s: the d of glass is left out",
                          r->name);
    if (rt_import_is_solid(m))
        m->opacity_texture = IMPORT_NONE;
    const int handle = rt_import_add_material(r->import, r->begin, r->name, m);
    rt_import_tally(r->import, r->told, r->name);
    keep_material(r, handle);
}

/* Of two materials of one name the first counts, and the lines of the other are passed over. */
static void begin_material(mtl_reader *r, char *line)
{
    finish_material(r);
    const char *const name = rt_mtl_rest(line);
    if (!*name) {
        rt_import_note_at(r->import, r->line, "a material without a name is left out");
        r->is_known = 1;
        return;
    }
    if (++r->list->begun > MTL_MATERIALS_MAX) {
        rt_import_fail(r->import, r->line, "more than %d materials", MTL_MATERIALS_MAX);
        return;
    }
    r->is_known = rt_name_table_find(&r->list->names, name) >= 0;
    if (r->is_known) {
        rt_import_note_at(r->import, r->line, "a second material %.60s is left out", name);
        return;
    }
    r->name = malloc(strlen(name) + 1);
    if (!r->name) {
        rt_import_fail_memory(r->import);
        return;
    }
    strcpy(r->name, name);
    r->begin = r->line;
    r->seen = 0;
    r->told = r->import->told;
    r->material = rt_import_material_begin();
    r->ka[0] = r->ka[1] = r->ka[2] = 0;
    r->tf[0] = r->tf[1] = r->tf[2] = r->opacity = 1;
    r->illum = 2;
    r->has_exponent = r->has_pbr = r->has_opacity = 0;
    r->transparency = -1;
    r->kd = r->ks = r->ke = r->d = r->pr = r->pm = r->normals = (mtl_map){0, 0};
    r->pbr = rt_mtl_pbr_begin();
}

/* Bounds Pr, Pm and the like, d and Tr, each of 0 to 1, Ns, of 0 on, and Ni, above 0. */
static void bound(mtl_reader *r, const char *word, double *value)
{
    const int is_exponent = strcmp(word, "Ns") == 0, is_index = strcmp(word, "Ni") == 0;
    const double most = is_exponent || is_index ? DBL_MAX : strcmp(word, "Pc") == 0 ? 4 : 1;
    const double bounded = fmin(fmax(*value, 0), most);
    if (!strchr("PadTN", word[0]) || strcmp(word, "Tf") == 0)
        return;
    if (is_index && !(*value > 0))
        rt_import_note_at(r->import, r->line,
                          "Ni %g is left out: an index of refraction is above 0", *value);
    else if (bounded != *value)
        rt_import_note_at(r->import, r->line, "%s %.9g is out of range: it became %.0f", word,
                          *value, bounded);
    *value = bounded;
}

/* Some programs write 1 as Tr of what is opaque: d counts. */
static void note_transparency(mtl_reader *r)
{
    if (r->has_opacity && r->transparency >= 0 && fabs(1 - r->transparency - r->opacity) > 1e-3)
        rt_import_note_at(r->import, r->line, "material %.60s: Tr %g is left out beside d %g",
                          r->name, r->transparency, r->opacity);
    if (r->has_opacity)
        r->transparency = -1;
}

/* `bit`: of a property that a material has once. */
static void note_second(mtl_reader *r, const char *word, unsigned bit)
{
    if (r->seen & bit)
        rt_import_note_at(r->import, r->line,
                          "material %.60s: a second %s takes the place of the first", r->name,
                          word);
    r->seen |= bit;
}

/* Numbers that go where they belong; returns whether it was one of them. */
static int read_property(mtl_reader *r, const char *word, char *line)
{
    import_material *m = &r->material;
    double value;
    const struct {
        const char *name;
        double *at;
        int count, *given;
    } properties[] = {
        {"Kd", m->kd, 3, &r->kd.has_colour},
        {"Ks", m->ks, 3, &r->ks.has_colour},
        {"Ke", m->emission, 3, &r->ke.has_colour},
        {"Tf", r->tf, 3, &r->pbr.has_glass},
        {"Ka", r->ka, 3, NULL},
        {"Ni", &m->ior, 1, NULL},
        {"Ns", &r->exponent, 1, &r->has_exponent},
        {"d", &r->opacity, 1, &r->has_opacity},
        {"Pr", &r->pbr.roughness, 1, &r->pbr.has_roughness},
        {"Pm", &r->pbr.metallic, 1, NULL},
        {"Ps", &r->pbr.sheen, 1, NULL},
        {"Pc", &r->pbr.clearcoat, 1, NULL},
        {"Pcr", &r->pbr.coat_roughness, 1, NULL},
        {"aniso", &r->pbr.anisotropy, 1, NULL},
        {"anisor", &r->pbr.rotation, 1, NULL},
    };
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++)
        if (strcmp(word, properties[i].name) == 0) {
            if (!read_numbers(r, line, properties[i].at, properties[i].count))
                return 1;
            if (properties[i].given)
                *properties[i].given = 1;
            note_second(r, word, 1u << i);
            bound(r, word, properties[i].at);
            note_transparency(r);
            return 1;
        }
    if (strcmp(word, "Tr") == 0 && read_numbers(r, line, &value, 1)) {
        bound(r, word, &value);
        r->transparency = value;
        r->opacity = r->has_opacity ? r->opacity : 1 - value;
        note_transparency(r);
    } else if (strcmp(word, "illum") == 0 && read_numbers(r, line, &value, 1)) {
        const int is_known = value >= 0 && value <= 10 && value == floor(value);
        r->illum = is_known ? (int)value : 2;
        if (!is_known)
            rt_import_note_at(r->import, r->line, "illum %g is taken as 2: it is 0 to 10", value);
    } else
        return strcmp(word, "Tr") == 0 || strcmp(word, "illum") == 0;
    return 1;
}

static int is_map_of_bumps(const char *word)
{
    static const char *const words[] = {"norm", "map_norm", "map_Bump", "map_bump", "bump"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(word, words[i]) == 0)
            return 1;
    return 0;
}

/* A map of normals, which is not seen by a scale of 0. */
static void read_normals(mtl_reader *r, const char *word, char *line)
{
    const double scale = r->material.normal_scale;
    r->material.normal_scale = 1;
    const int texture = read_map(r, &r->normals, word, line);
    if (texture == IMPORT_NONE)
        r->material.normal_scale = scale; /* another one stays, as beside heights */
    else
        r->material.normal_texture = r->material.normal_scale == 0 ? IMPORT_NONE : texture;
}

static void read_statement(mtl_reader *r, const char *word, char *line)
{
    r->has_pbr |= word[0] == 'P' || strncmp(word, "map_P", 5) == 0;
    r->has_any_pbr |= r->has_pbr;
    if (strcmp(word, "newmtl") == 0)
        begin_material(r, line);
    else if (r->is_known)
        return;
    else if (!r->name)
        rt_import_note_at(r->import, r->line, "'%.40s' before the first newmtl is left out", word);
    else if (strcmp(word, "map_Kd") == 0)
        r->material.kd_texture = read_map(r, &r->kd, word, line);
    else if (strcmp(word, "map_Ks") == 0)
        r->material.ks_texture = read_map(r, &r->ks, word, line);
    else if (strcmp(word, "map_Ke") == 0)
        r->material.emission_texture = read_map(r, &r->ke, word, line);
    else if (strcmp(word, "map_d") == 0)
        r->material.opacity_texture = read_map(r, &r->d, word, line);
    else if (strcmp(word, r->is_blender ? "map_Ns" : "map_Pr") == 0 || strcmp(word, "map_Pr") == 0)
        r->pbr.roughness_texture = read_map(r, &r->pr, word, line);
    else if (strcmp(word, "map_Pm") == 0)
        r->pbr.metallic_texture = read_map(r, &r->pm, word, line);
    else if (is_map_of_bumps(word))
        read_normals(r, word, line);
    else if (!read_property(r, word, line))
        rt_import_note_at(r->import, r->line, "material %.60s: '%.30s' is left out", r->name, word);
}

void rt_mtl_read(importer *import, mtl_list *list, const char *file, char *text)
{
    const import_place around = import->place;
    const size_t mark = rt_byte_order_mark(text, strlen(text));
    mtl_reader r = {.import = import,
                    .list = list,
                    .is_blender = strncmp(text + mark, "# Blender ", strlen("# Blender ")) == 0};
    char *line;

    import->place = (import_place){.file = file, .concern = IMPORT_MATERIAL};
    import->is_relative |= r.is_blender;
    while (!import->failed && (line = rt_mtl_next_line(&text, &r.line)) != NULL) {
        char *word = rt_mtl_next_word(&line);
        if (word)
            read_statement(&r, word, line);
    }
    finish_material(&r);
    if (r.is_blender && !r.has_any_pbr && list->begun > 0)
        rt_import_note_at(import, 0,
                          "Blender wrote it without PBR Extensions: glass, coats and sheen are not "
                          "in it");
    free(r.name);
    import->place = around;
}

int rt_mtl_find(importer *import, const mtl_list *list, const char *name)
{
    int at = rt_name_table_find(&list->names, name);
    if (at >= 0)
        return list->materials[at];
    char *bare = malloc(strlen(name) + 1);
    if (!bare) {
        rt_import_fail_memory(import);
        return IMPORT_NONE;
    }
    const int is_cut = rt_mtl_cut_comment(strcpy(bare, name));
    const int whole = is_cut ? rt_name_table_find(&list->names, bare) : -1;
    at = rt_name_table_find(&list->bare, bare);
    free(bare);
    return whole >= 0 ? list->materials[whole] : at >= 0 ? list->bare_materials[at] : IMPORT_NONE;
}

static mtl_glass *find_glass(const mtl_list *list, int solid)
{
    for (size_t i = 0; i < list->glass_count; i++)
        if (list->glass[i].solid == solid)
            return &list->glass[i];
    return NULL;
}

int rt_mtl_may_be_sheet(const mtl_list *list, int solid)
{
    return find_glass(list, solid) != NULL;
}

int rt_mtl_sheet(importer *import, mtl_list *list, int solid, const char *name)
{
    mtl_glass *const glass = find_glass(list, solid);
    if (glass && glass->sheet == IMPORT_NONE) {
        const size_t told = import->told;
        const import_place before = import->place;
        import->place.file = list->libraries.names[glass->library];
        rt_mtl_make_pbr(import, glass->line, name, &glass->pbr, &glass->material);
        glass->sheet = rt_import_add_material(import, glass->line, name, &glass->material);
        rt_import_tally(import, told, name);
        import->place = before;
    }
    return glass ? glass->sheet : IMPORT_NONE;
}

int rt_mtl_coloured(importer *import, mtl_list *list, int handle, const char *name)
{
    size_t i = 0;
    while (i < list->default_count && list->defaults[i].plain != handle)
        i++;
    if (i == list->default_count)
        return handle;
    mtl_default *const found = &list->defaults[i];
    if (found->coloured == IMPORT_NONE) {
        const import_place before = import->place;
        import->place.file = list->libraries.names[found->library];
        found->material.kd[0] = found->material.kd[1] = found->material.kd[2] = 1;
        found->coloured = rt_import_add_material(import, found->line, name, &found->material);
        import->place = before;
    }
    return found->coloured;
}

void rt_mtl_free(mtl_list *list)
{
    free(list->defaults);
    free(list->glass);
    rt_name_table_free(&list->names);
    rt_name_table_free(&list->bare);
    rt_name_table_free(&list->libraries);
    free(list->materials);
    free(list->bare_materials);
}
