/*
 * mtl.c - the materials of OBJ files (Alias/Wavefront, "Object Files", appendix B1).
 *
 * Kd and Ks are the albedos of the diffuse and the specular lobe, in linear light. The exponent Ns
 * of Phong's lobe becomes alpha = sqrt(2 / (Ns + 2)) of GGX (Walter et al. 2007), Pr and Pm are
 * roughness and metalness as in glTF. illum 4, 6, 7 and 9 are glass of index Ni; d below 1 is a
 * sheet that transmits the rest without refraction.
 */
#include "mtl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct mtl_reader {
    importer *import;
    mtl_list *list;
    char *name; /* of the material that is read, or NULL */
    import_material material;
    double tf[3], opacity, exponent, metallic, pbr_roughness;
    int illum, line, has_exponent, has_pbr, has_kd;
    int begin;    /* the line of its newmtl */
    int is_known; /* its name is that of an earlier one */
} mtl_reader;

/* ---- Lines ------------------------------------------------------------------- */

char *mtl_next_line(char **text, int *line)
{
    char *start = *text;
    if (!*start)
        return NULL;
    ++*line;
    char *at = start;
    for (; *at && *at != '\n'; at++)
        if (*at == '\\' && (at[1] == '\n' || (at[1] == '\r' && at[2] == '\n'))) {
            *at++ = ' ';
            if (*at == '\r')
                *at++ = ' ';
            *at = ' ';
            ++*line;
        }
    *text = *at ? at + 1 : at;
    *at = '\0';
    return start;
}

char *mtl_next_word(char **line)
{
    char *start = *line + strspn(*line, " \t\r");
    if (!*start || *start == '#')
        return NULL;
    char *end = start + strcspn(start, " \t\r");
    *line = *end ? end + 1 : end;
    *end = '\0';
    return start;
}

/* ---- Values ------------------------------------------------------------------ */

/* One to three numbers; 0 after a failure or a note. */
static int read_numbers(mtl_reader *r, char *line, double *out, int most)
{
    int count = 0;
    char *word;
    while (count < most && (word = mtl_next_word(&line)) != NULL) {
        const char *at = word;
        if (!import_number(&out[count], &at) || *at) {
            if (count > 0 || strcmp(word, "spectral") != 0)
                return import_fail(r->import, r->line, "'%.40s' is no number", word);
            import_note_at(r->import, r->line, "material %.60s: a spectral colour is left out",
                           r->name);
            return 0;
        }
        count++;
    }
    if (count == 0)
        return import_fail(r->import, r->line, "a number is missing");
    for (int c = count; c < most; c++)
        out[c] = out[0];
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
static void read_option(mtl_reader *r, import_texture *texture, const char *option, char **line)
{
    int count = option_arguments(option);
    double values[3] = {0, 0, 0};
    int given = 0;
    for (; given < count; given++) {
        char *rest = *line + strspn(*line, " \t\r");
        const char *at = rest;
        if (count == 1)
            break;
        if (!import_number(&values[given], &at) || !strchr(" \t\r", *at))
            break;
        mtl_next_word(line);
    }
    char *word = count == 1 ? mtl_next_word(line) : NULL;
    if (strcmp(option, "-s") == 0 && given >= 2 && values[0] != 0 && values[1] != 0)
        memcpy(texture->scale, values, sizeof texture->scale);
    else if (strcmp(option, "-o") == 0 && given >= 1)
        memcpy(texture->offset, values, sizeof texture->offset);
    else if (strcmp(option, "-clamp") == 0 && word)
        texture->wrap = strcmp(word, "on") == 0 ? 2 : 0;
    else
        import_note_at(r->import, r->line, "material %.60s: the option %.20s of a map is left out",
                       r->name, option);
}

static int read_map(mtl_reader *r, char *line)
{
    import_texture texture = {.scale = {1, 1}};
    char file[512], *rest;
    for (;;) {
        rest = line + strspn(line, " \t\r");
        if (*rest != '-')
            break;
        char *option = mtl_next_word(&line);
        read_option(r, &texture, option, &line);
    }
    size_t length = strlen(rest);
    while (length > 0 && strchr(" \t\r", rest[length - 1]))
        rest[--length] = '\0';
    for (char *at = rest; *at; at++)
        *at = *at == '\\' ? '/' : *at;
    if (++r->list->maps > MTL_MAPS_MAX) {
        import_fail(r->import, r->line, "more than %d maps of materials", MTL_MAPS_MAX);
        return IMPORT_NONE;
    }
    if (length == 0 || !import_image_file(r->import, r->line, file, rest))
        return IMPORT_NONE;
    texture.file = file;
    return import_add_texture(r->import, r->name, &texture);
}

/* ---- Materials --------------------------------------------------------------- */

/* Diffuse where it is no metal, specular by its colour where it is. */
static void make_pbr(mtl_reader *r)
{
    import_material *m = &r->material;
    double metal = r->metallic < 0 ? 0 : r->metallic > 1 ? 1 : r->metallic;
    for (int c = 0; c < 3; c++) {
        m->ks[c] = metal * m->kd[c];
        m->kd[c] *= 1 - metal;
    }
    m->ks_texture = m->kd_texture;
    m->roughness = metal > 0 ? r->pbr_roughness * r->pbr_roughness : 0;
}

static void keep_material(mtl_reader *r, int handle)
{
    mtl_list *const list = r->list;
    int *moved = realloc(list->materials, (list->names.count + 1) * sizeof *moved);
    list->materials = moved ? moved : list->materials;
    const int at = moved ? name_table_add(&list->names, r->name) : -1;
    if (at < 0)
        import_fail_memory(r->import);
    else
        list->materials[at] = handle;
}

static void finish_material(mtl_reader *r)
{
    import_material *m = &r->material;
    if (!r->name)
        return;
    if (m->kd_texture != IMPORT_NONE && !r->has_kd)
        m->kd[0] = m->kd[1] = m->kd[2] = 1;
    if (r->has_exponent && (m->ks[0] > 0 || m->ks[1] > 0 || m->ks[2] > 0))
        m->roughness = sqrt(2 / (fmax(r->exponent, 0) + 2));
    if (r->has_pbr)
        make_pbr(r);
    if (r->illum == 4 || r->illum == 6 || r->illum == 7 || r->illum == 9) {
        memset(m->kd, 0, sizeof m->kd);
        memset(m->ks, 0, sizeof m->ks);
        memcpy(m->kt, r->tf, sizeof m->kt);
        m->fresnel = IMPORT_FRESNEL_DIELECTRIC;
        m->roughness = 0;
    } else if (r->illum == 3 || r->illum == 5) {
        m->roughness = 0;
    }
    if (r->illum <= 3 && r->opacity < 1) {
        for (int c = 0; c < 3; c++) {
            m->kd[c] *= r->opacity;
            m->ks[c] *= r->opacity;
            m->kt[c] = 1 - r->opacity;
        }
        m->ior = 1;
        m->roughness = 0;
        import_note_at(r->import, r->begin,
                       "material %.60s: d below 1 is a sheet that transmits the rest", r->name);
    }
    keep_material(r, import_add_material(r->import, r->begin, r->name, m));
    free(r->name);
    r->name = NULL;
}

/* Of two materials of one name the first counts, and the lines of the other are passed over. */
static void begin_material(mtl_reader *r, char *line)
{
    finish_material(r);
    char *word = mtl_next_word(&line);
    if (!word) {
        import_fail(r->import, r->line, "newmtl has no name");
        return;
    }
    if (++r->list->begun > MTL_MATERIALS_MAX) {
        import_fail(r->import, r->line, "more than %d materials", MTL_MATERIALS_MAX);
        return;
    }
    r->is_known = name_table_find(&r->list->names, word) >= 0;
    if (r->is_known) {
        import_note_at(r->import, r->line, "a second material %.60s is left out", word);
        return;
    }
    r->name = malloc(strlen(word) + 1);
    if (!r->name) {
        import_fail_memory(r->import);
        return;
    }
    strcpy(r->name, word);
    r->begin = r->line;
    r->material = import_material_begin();
    r->tf[0] = r->tf[1] = r->tf[2] = r->opacity = 1;
    r->illum = 2;
    r->has_exponent = r->has_pbr = r->has_kd = 0;
    r->metallic = 0;
    r->pbr_roughness = 1;
}

/* Numbers that go where they belong; returns whether it was one of them. */
static int read_property(mtl_reader *r, const char *word, char *line)
{
    import_material *m = &r->material;
    double value, unused[3];
    const struct {
        const char *name;
        double *at;
        int count, *given;
    } properties[] = {
        {"Kd", m->kd, 3, &r->has_kd},
        {"Ks", m->ks, 3, NULL},
        {"Ke", m->emission, 3, NULL},
        {"Tf", r->tf, 3, NULL},
        {"Ka", unused, 3, NULL},
        {"Ni", &m->ior, 1, NULL},
        {"Ns", &r->exponent, 1, &r->has_exponent},
        {"d", &r->opacity, 1, NULL},
        {"Pr", &r->pbr_roughness, 1, &r->has_pbr},
        {"Pm", &r->metallic, 1, &r->has_pbr},
    };
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++)
        if (strcmp(word, properties[i].name) == 0) {
            if (read_numbers(r, line, properties[i].at, properties[i].count) && properties[i].given)
                *properties[i].given = 1;
            return 1;
        }
    if (strcmp(word, "Tr") == 0 && read_numbers(r, line, &value, 1))
        r->opacity = 1 - value;
    else if (strcmp(word, "illum") == 0 && read_numbers(r, line, &value, 1))
        r->illum = value >= 0 && value <= 10 ? (int)value : 2;
    else
        return strcmp(word, "Tr") == 0 || strcmp(word, "illum") == 0;
    return 1;
}

static void read_statement(mtl_reader *r, const char *word, char *line)
{
    if (strcmp(word, "newmtl") == 0)
        begin_material(r, line);
    else if (r->is_known)
        return;
    else if (!r->name)
        import_fail(r->import, r->line, "'%.40s' stands before newmtl", word);
    else if (strcmp(word, "map_Kd") == 0)
        r->material.kd_texture = read_map(r, line);
    else if (strcmp(word, "map_Ks") == 0)
        r->material.ks_texture = read_map(r, line);
    else if (strcmp(word, "map_Ke") == 0)
        r->material.emission_texture = read_map(r, line);
    else if (!read_property(r, word, line))
        import_note_at(r->import, r->line, "material %.60s: '%.30s' is left out", r->name, word);
}

void mtl_read(importer *import, mtl_list *list, const char *file, char *text)
{
    const import_place around = import->place;
    mtl_reader r = {.import = import, .list = list};
    char *line;

    import->place = (import_place){.file = file};
    while (!import->failed && (line = mtl_next_line(&text, &r.line)) != NULL) {
        char *word = mtl_next_word(&line);
        if (word)
            read_statement(&r, word, line);
    }
    finish_material(&r);
    free(r.name);
    import->place = around;
}

int mtl_find(const mtl_list *list, const char *name)
{
    const int at = name_table_find(&list->names, name);
    return at < 0 ? IMPORT_NONE : list->materials[at];
}

void mtl_free(mtl_list *list)
{
    name_table_free(&list->names);
    name_table_free(&list->libraries);
    free(list->materials);
}
