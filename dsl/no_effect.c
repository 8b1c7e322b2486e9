/*
 * no_effect.c - fields that are given but have no effect beside the others of their block.
 *
 * Those of `film` and `render` are settings, whose needs stand in the table of rt/setting.h.
 */
#include "dsl/no_effect.h"

#include <stdio.h>
#include <string.h>

/* ---- What a field may need ------------------------------------------------ */

static int is_black(const float colour[3])
{
    return colour[0] == 0 && colour[1] == 0 && colour[2] == 0;
}

static int is_conductor(const rt_block_fields *fields)
{
    return fields->material.fresnel == RT_FRESNEL_CONDUCTOR || fields->material.metal;
}

static int is_specular(const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    return !is_black(m->ks) || !is_black(m->kt) || m->ks_texture || m->kt_texture || m->metal ||
           m->glass;
}

#define IS_GIVEN_COLOUR(name) !is_black(m->name)
#define IS_GIVEN_NUMBER(name) m->name != 0
#define IS_GIVEN_INPUT(TYPE, name, RANGE, NEED, unit, help)                                        \
    || IS_GIVEN_##TYPE(name) || m->name##_texture
static int is_principled(const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    return m->specular != 0 RT_PRINCIPLED_INPUTS(IS_GIVEN_INPUT)
                              RT_PRINCIPLED_NUMBERS(IS_GIVEN_INPUT);
}

static int is_clear(const rt_block_fields *fields)
{
    return fields->material.spec_trans > 0 || fields->material.spec_trans_texture;
}

static int is_transparent(const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    return is_clear(fields) || !is_black(m->kt) || m->kt_texture || m->glass ||
           (m->fresnel == RT_FRESNEL_DIELECTRIC && (!is_black(m->ks) || m->ks_texture));
}

static int can_be_thin(const rt_block_fields *fields)
{
    return is_transparent(fields) || !fields->material.thin || is_principled(fields);
}

/* What goes straight through a sheet without Fresnel's equations knows no index. */
static int refracts(const rt_block_fields *fields)
{
    return !fields->material.thin || fields->material.fresnel != RT_FRESNEL_OFF ||
           is_principled(fields);
}

static int has_boundary(const rt_block_fields *fields)
{
    return is_transparent(fields) || fields->material.interface;
}

static int is_solid(const rt_block_fields *fields)
{
    return is_transparent(fields) && !fields->material.thin;
}

static int has_glass(const rt_block_fields *fields)
{
    return fields->material.glass != RT_GLASS_NONE;
}

static int has_terms(const rt_block_fields *fields)
{
    return !is_black(fields->material.sellmeier_b);
}

static int scatters(const rt_block_fields *fields)
{
    return !is_black(fields->material.scattering);
}

static int has_coefficients(const rt_block_fields *fields)
{
    return !is_black(fields->material.absorption) || scatters(fields);
}

static int fills_space(const rt_block_fields *fields)
{
    return !is_black(fields->medium.absorption) || !is_black(fields->medium.scattering);
}

static int is_turbid(const rt_block_fields *fields)
{
    return !is_black(fields->medium.scattering);
}

int rt_block_has_kd(const rt_block_fields *fields)
{
    return !is_black(fields->material.kd) || fields->material.kd_texture != 0 ||
           !is_black(fields->material.base_color) || fields->material.base_color_texture != 0 ||
           fields->material.blend != 0;
}

int rt_block_emits(const rt_block_fields *fields)
{
    return !is_black(fields->material.emission) || fields->material.emission_texture;
}

static int has_colour(const rt_block_fields *fields)
{
    return rt_block_has_kd(fields) || is_specular(fields) || is_principled(fields);
}

static int has_index(const rt_block_fields *fields)
{
    return is_transparent(fields) || is_principled(fields);
}

static int has_sheen(const rt_block_fields *fields)
{
    return fields->material.sheen > 0 || fields->material.sheen_texture;
}

static int has_clearcoat(const rt_block_fields *fields)
{
    return fields->material.clearcoat > 0 || fields->material.clearcoat_texture;
}

static int needs_nothing(const rt_block_fields *fields)
{
    (void)fields;
    return 1;
}

static int is_blend(const rt_block_fields *fields)
{
    return fields->material.blend != 0;
}

static int has_coat(const rt_block_fields *fields)
{
    return fields->material.coat > 0 || fields->material.coat_texture;
}

/* Metals have an index, too, whatever lies outside. */
static int may_be_relative(const rt_block_fields *fields)
{
    return has_index(fields) || has_coat(fields) || is_conductor(fields);
}

static int has_directions(const rt_block_fields *fields)
{
    return fields->material.roughness_v > 0 || fields->material.roughness_v_texture ||
           fields->material.anisotropic > 0 || fields->material.anisotropic_texture;
}

static int is_rough_specular(const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    return is_specular(fields) && (m->roughness > 0 || m->roughness_texture);
}

static int has_facets(const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    return is_rough_specular(fields) ||
           (has_coat(fields) && (m->coat_roughness > 0 || m->coat_roughness_texture));
}

static int has_bumps(const rt_block_fields *fields)
{
    return fields->material.bump_texture != 0;
}

static int has_opacity(const rt_block_fields *fields)
{
    return fields->material.opacity_texture != 0 ||
           (fields->material.opacity > 0 && fields->material.opacity < 1);
}

static int has_normals(const rt_block_fields *fields)
{
    return fields->material.normal_texture != 0;
}

static int is_tilted(const rt_block_fields *fields)
{
    return has_bumps(fields) || has_normals(fields);
}

static int is_orthographic(const rt_block_fields *fields)
{
    return fields->camera.kind == RT_CAMERA_ORTHOGRAPHIC;
}

static int is_perspective(const rt_block_fields *fields)
{
    return fields->camera.kind == RT_CAMERA_PERSPECTIVE;
}

static int may_have_lens(const rt_block_fields *fields)
{
    return fields->camera.kind != RT_CAMERA_ENVIRONMENT;
}

static int has_lens(const rt_block_fields *fields)
{
    return fields->camera.aperture > 0;
}

static int has_blades(const rt_block_fields *fields)
{
    return fields->camera.blades > 0;
}

static int is_image(const rt_block_fields *fields)
{
    return fields->texture.kind == RT_TEXTURE_IMAGE;
}

static int has_edges(const rt_block_fields *fields)
{
    return is_image(fields) || fields->texture.kind == RT_TEXTURE_GRADIENT;
}

static int is_attribute(const rt_block_fields *fields)
{
    return fields->texture.kind == RT_TEXTURE_ATTRIBUTE;
}

static int has_place(const rt_block_fields *fields)
{
    return fields->texture.kind != RT_TEXTURE_CONSTANT && !is_attribute(fields);
}

/* Of a multiply or mix, a map moves the textures that it is made of. */
static int has_parts_to_move(const rt_block_fields *fields)
{
    const rt_texture *t = &fields->texture;
    return (t->kind != RT_TEXTURE_MULTIPLY && t->kind != RT_TEXTURE_MIX) || t->a_texture ||
           t->b_texture || t->weight_texture;
}

static int has_two_colours(const rt_block_fields *fields)
{
    return has_place(fields) && !is_image(fields);
}

static int is_mixture(const rt_block_fields *fields)
{
    return fields->texture.kind == RT_TEXTURE_MIX;
}

static int may_have_attribute(const rt_block_fields *fields)
{
    return has_edges(fields) || fields->texture.kind == RT_TEXTURE_CHECKER || is_attribute(fields);
}

static int has_colour_a(const rt_block_fields *fields)
{
    return !is_image(fields) && !is_attribute(fields);
}

static int has_sky_image(const rt_block_fields *fields)
{
    return fields->environment.path != NULL;
}

static int has_spot_image(const rt_block_fields *fields)
{
    return fields->spot_light.path != NULL;
}

static int has_luminaire_image(const rt_block_fields *fields)
{
    const char *path = fields->goniometric_light.path, *dot = path ? strrchr(path, '.') : NULL;
    return !dot || strcmp(dot, ".ies") != 0;
}

/* ---- The table ------------------------------------------------------------ */

/* What inputs of materials need: the columns of the table below. */
#define NEED_NOTHING needs_nothing, ""
#define NEED_COLOUR has_colour, "'kd', 'ks' or 'kt'"
#define NEED_SPECULAR is_specular, "'ks' or 'kt'"
#define NEED_DIRECTIONS has_directions, "'roughness_v' or 'anisotropic'"
#define NEED_COAT has_coat, "'coat'"
#define NEED_SHEEN has_sheen, "'sheen'"
#define NEED_CLEARCOAT has_clearcoat, "'clearcoat'"
#define NEED_OF_INPUT(TYPE, name, RANGE, NEED, unit, help)                                         \
    {RT_BLOCK_MATERIAL, #name, NEED_##NEED}, {RT_BLOCK_MATERIAL, #name "_texture", NEED_##NEED},

#define FACETS "'coat_roughness', or 'ks' or 'kt' and 'roughness'"
#define PARTS "'a_texture' or 'b_texture'"
#define BOUNDARY "'kt', 'interface', 'spec_trans', or 'ks' and 'fresnel dielectric'"

/*
 * A field of a block, and without what it has no effect. It is left out of what is written, too, so
 * that a row has to hold whatever else the block has.
 */
static const struct {
    rt_block_id block;
    const char *field;
    int (*has_effect)(const rt_block_fields *fields);
    const char *without;
} needs[] = {
    {RT_BLOCK_MATERIAL, "eta", is_conductor, "'fresnel conductor'"},
    {RT_BLOCK_MATERIAL, "k", is_conductor, "'fresnel conductor'"},
    {RT_BLOCK_MATERIAL, "anisotropy_rotation", NEED_DIRECTIONS},
    {RT_BLOCK_MATERIAL, "distribution", has_facets, FACETS},
    {RT_BLOCK_MATERIAL, "facet_scattering", has_facets, FACETS},
    {RT_BLOCK_MATERIAL, "fresnel", is_specular, "'ks' or 'kt'"},
    {RT_BLOCK_MATERIAL, "coat_ior", NEED_COAT},
    {RT_BLOCK_MATERIAL, "coat_linear", NEED_COAT},
    {RT_BLOCK_MATERIAL, "thin", can_be_thin, "'kt', or 'ks' and 'fresnel dielectric'"},
    {RT_BLOCK_MATERIAL, "exponent", is_specular, "'ks'"},
    {RT_BLOCK_MATERIAL, "ior", refracts, "'fresnel dielectric'"},
    {RT_BLOCK_MATERIAL, "ior", has_index, "'kt', 'base_color', or 'ks' and 'fresnel dielectric'"},
    {RT_BLOCK_MATERIAL, "relative_ior", may_be_relative,
     "'kt', 'coat', a metal, or 'ks' and 'fresnel dielectric'"},
    {RT_BLOCK_MATERIAL, "abbe", is_solid, "a solid of 'kt'"},
    {RT_BLOCK_MATERIAL, "cauchy", is_solid, "a solid of 'kt'"},
    {RT_BLOCK_MATERIAL, "sellmeier_b", is_solid, "a solid of 'kt'"},
    {RT_BLOCK_MATERIAL, "sellmeier_c", has_terms, "'sellmeier_b'"},
    {RT_BLOCK_MATERIAL, "dispersion", has_glass, "'glass'"},
    {RT_BLOCK_MATERIAL, "dispersion", is_solid, "a solid of 'glass'"},
    {RT_BLOCK_MATERIAL, "absorption", has_boundary, BOUNDARY},
    {RT_BLOCK_MATERIAL, "scattering", has_boundary, BOUNDARY},
    {RT_BLOCK_MATERIAL, "g", scatters, "'scattering'"},
    {RT_BLOCK_MATERIAL, "priority", has_boundary, BOUNDARY},
    {RT_BLOCK_MATERIAL, "density", has_boundary, BOUNDARY},
    {RT_BLOCK_MATERIAL, "density", has_coefficients, "'absorption' or 'scattering'"},
    {RT_BLOCK_MATERIAL, "albedo", has_boundary, BOUNDARY},
    {RT_BLOCK_MATERIAL, "albedo", scatters, "'scattering'"},
    {RT_BLOCK_MEDIUM, "albedo", is_turbid, "'scattering'"},
    {RT_BLOCK_MEDIUM, "density", fills_space, "'absorption' or 'scattering'"},
    {RT_BLOCK_MEDIUM, "g", is_turbid, "'scattering'"},
    {RT_BLOCK_MATERIAL, "opacity_cutoff", has_opacity, "'opacity' or 'opacity_texture'"},
    {RT_BLOCK_MATERIAL, "bump_scale", has_bumps, "'bump_texture'"},
    {RT_BLOCK_MATERIAL, "normal_scale", has_normals, "'normal_texture'"},
    {RT_BLOCK_MATERIAL, "normal_flip", has_normals, "'normal_texture'"},
    {RT_BLOCK_MATERIAL, "bump_shadowing", is_tilted, "'bump_texture' or 'normal_texture'"},
    {RT_BLOCK_MATERIAL, "weight", is_blend, "'blend'"},
    {RT_BLOCK_MATERIAL, "weight_texture", is_blend, "'blend'"},
    {RT_BLOCK_CAMERA, "width", is_orthographic, "'projection orthographic'"},
    {RT_BLOCK_CAMERA, "fov", is_perspective, "'projection perspective'"},
    {RT_BLOCK_CAMERA, "aperture", may_have_lens, "another 'projection'"},
    {RT_BLOCK_CAMERA, "shift", may_have_lens, "another 'projection'"},
    {RT_BLOCK_CAMERA, "focal_distance", has_lens, "'aperture'"},
    {RT_BLOCK_CAMERA, "blades", has_lens, "'aperture'"},
    {RT_BLOCK_CAMERA, "blade_rotation", has_blades, "'blades'"},
    {RT_BLOCK_TEXTURE, "file", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "linear", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "layer", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "filter", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "channel", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "power", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "wrap", has_edges, "'pattern image' or 'pattern gradient'"},
    {RT_BLOCK_TEXTURE, "a", has_colour_a, "a 'pattern' of colours"},
    {RT_BLOCK_TEXTURE, "b", has_two_colours, "a 'pattern' of two colours"},
    {RT_BLOCK_TEXTURE, "a_texture", has_two_colours, "a 'pattern' of two colours"},
    {RT_BLOCK_TEXTURE, "b_texture", has_two_colours, "a 'pattern' of two colours"},
    {RT_BLOCK_TEXTURE, "weight", is_mixture, "'pattern mix'"},
    {RT_BLOCK_TEXTURE, "weight_texture", is_mixture, "'pattern mix'"},
    {RT_BLOCK_TEXTURE, "scale", has_place, "a 'pattern' other than constant or attribute"},
    {RT_BLOCK_TEXTURE, "scale", has_parts_to_move, PARTS},
    {RT_BLOCK_TEXTURE, "offset", has_place, "a 'pattern' other than constant or attribute"},
    {RT_BLOCK_TEXTURE, "offset", has_parts_to_move, PARTS},
    {RT_BLOCK_TEXTURE, "rotate", has_place, "a 'pattern' other than constant or attribute"},
    {RT_BLOCK_TEXTURE, "rotate", has_parts_to_move, PARTS},
    {RT_BLOCK_TEXTURE, "attribute", may_have_attribute,
     "'pattern image', 'checker', 'gradient' or 'attribute'"},
    {RT_BLOCK_TEXTURE, "shear", has_place, "a 'pattern' other than constant or attribute"},
    {RT_BLOCK_TEXTURE, "shear", has_parts_to_move, PARTS},
    {RT_BLOCK_SPOT_LIGHT, "up", has_spot_image, "'file'"},
    {RT_BLOCK_SPOT_LIGHT, "filter", has_spot_image, "'file'"},
    {RT_BLOCK_GONIOMETRIC_LIGHT, "filter", has_luminaire_image, "an image"},
    {RT_BLOCK_ENVIRONMENT_LIGHT, "rotation", has_sky_image, "'file'"},
    {RT_BLOCK_ENVIRONMENT_LIGHT, "rotate", has_sky_image, "'file'"},
    {RT_BLOCK_ENVIRONMENT_LIGHT, "scale", has_sky_image, "'file'"},
    {RT_BLOCK_ENVIRONMENT_LIGHT, "matrix", has_sky_image, "'file'"},
    RT_MATERIAL_INPUTS(NEED_OF_INPUT)};

/* Whether a row is that of a field, or of the input that it is the texture of. */
static int is_row_of(const char *row, const char *field)
{
    const size_t length = strlen(row);
    return strncmp(row, field, length) == 0 &&
           (field[length] == '\0' || strcmp(field + length, "_texture") == 0);
}

/* What a field would need to have an effect, or NULL. */
static const char *missing(const rt_block *block, const rt_field *field,
                           const rt_block_fields *fields)
{
    for (size_t i = 0; i < sizeof needs / sizeof *needs && block->id < RT_BLOCK_MESH; i++)
        if (needs[i].block == block->id && is_row_of(needs[i].field, field->name) &&
            !needs[i].has_effect(fields))
            return needs[i].without;
    return NULL;
}

int rt_field_has_effect(const rt_block *block, const rt_field *field, const rt_block_fields *fields)
{
    return !missing(block, field, fields);
}

/* ---- For calls ------------------------------------------------------------ */

static const char *lacks(rt_block_id id, const rt_block_fields *fields, const char *name)
{
    const rt_block *block = &rt_blocks[id];
    const rt_field *field = rt_schema_field(block, (rt_text){name, strlen(name)});
    return field ? missing(block, field, fields) : NULL;
}

const char *rt_camera_lacks(const rt_camera *camera, const char *field)
{
    const rt_block_fields fields = {.camera = *camera};
    return lacks(RT_BLOCK_CAMERA, &fields, field);
}

const char *rt_texture_lacks(const rt_texture *texture, const char *field)
{
    const rt_block_fields fields = {.texture = *texture};
    return lacks(RT_BLOCK_TEXTURE, &fields, field);
}

const char *rt_material_lacks(const rt_material *material, const char *field)
{
    const rt_block_fields fields = {.material = *material};
    return lacks(RT_BLOCK_MATERIAL, &fields, field);
}

const char *rt_medium_lacks(const rt_medium *medium, const char *field)
{
    const rt_block_fields fields = {.medium = *medium};
    return lacks(RT_BLOCK_MEDIUM, &fields, field);
}

/* ---- Warnings ------------------------------------------------------------- */

/* The texture beside an input of a material, whose zero the library takes for one left out. */
#define TEXTURE_BESIDE(TYPE, name, RANGE, NEED, unit, help)                                        \
    strcmp(field, #name) == 0 ? &fields->material.name##_texture:
static uint32_t *texture_beside(rt_block_id block, const char *field, rt_block_fields *fields)
{
    if (block == RT_BLOCK_MATERIAL)
        return RT_MATERIAL_INPUTS(TEXTURE_BESIDE) NULL;
    return block != RT_BLOCK_TEXTURE ? NULL
           : strcmp(field, "a") == 0 ? &fields->texture.a_texture
           : strcmp(field, "b") == 0 ? &fields->texture.b_texture
                                     : NULL;
}

/* Whether an entry is a colour or a number, and zero. */
static int is_zero(const rt_entry *entry, const rt_block_fields *fields)
{
    float value[3] = {0, 0, 0};
    if (entry->field->type != RT_FIELD_COLOUR && entry->field->type != RT_FIELD_NUMBER)
        return 0;
    memcpy(value, (const unsigned char *)fields + entry->field->offset, entry->field->size);
    return is_black(value);
}

/* Whether a light is one of an image or a table, which it has times this colour. */
static int is_factor(rt_block_id block, const rt_entry *entry, const rt_block_fields *fields)
{
    return entry->field->type == RT_FIELD_COLOUR &&
           ((block == RT_BLOCK_ENVIRONMENT_LIGHT && fields->environment.path) ||
            block == RT_BLOCK_GONIOMETRIC_LIGHT);
}

int rt_no_effect_settle(const rt_statement *statement, rt_block_fields *fields, rt_reports *reports)
{
    const rt_block_id block = statement->block->id;
    int is_dark = 0;
    for (int i = 0; i < statement->entry_count; i++) {
        const rt_entry *const entry = &statement->entries[i];
        const char *const name = entry->field->name;
        if (entry->is_broken || !is_zero(entry, fields))
            continue;
        uint32_t *const texture = texture_beside(block, name, fields);
        if (texture && *texture) {
            *texture = 0;
            if (reports)
                rt_report_warning(reports, entry->name, "'%s' of 0 leaves nothing of '%s_texture'",
                                  name, name);
        } else if (is_factor(block, entry, fields)) {
            is_dark = 1;
            if (reports)
                rt_report_warning(reports, entry->name, "'%s' of 0: the light is left out", name);
        }
    }
    return !is_dark;
}

/* Whether an entry is a value of 0 that counts as left out: another field stands for it. */
static int is_zero_left_out(const rt_entry *entry, const rt_block_fields *fields)
{
    const rt_field *const field = entry->field;
    return field->type == RT_FIELD_COLOUR && field->need == RT_NEED_AT_MOST_ONE &&
           is_zero(entry, fields);
}

/* Whether a need is about the mode, which the command line often chooses. */
static int concerns_mode(const rt_setting_need *need)
{
    for (int i = 0; i < RT_CONDITIONS_MAX; i++)
        if (need->any[i].test != RT_TEST_NONE && strcmp(need->any[i].setting, "mode") == 0)
            return 1;
    return 0;
}

/* Warns where an entry of a `render` block needs another setting. */
static void warn_setting(const rt_entry *entry, const rt_render_options *options,
                         rt_reports *reports)
{
    const rt_setting *setting = rt_setting_find(entry->field->name);
    char phrase[RT_PHRASE_SIZE];
    for (const rt_setting_need *need = setting->needs; need && need->otherwise; need++)
        if (!concerns_mode(need) && !rt_setting_need_met(need, options))
            rt_report_warning(
                reports, entry->name, "'%s' has no effect %s", entry->field->name,
                rt_setting_text(phrase, sizeof phrase, need->otherwise, RT_NAME_QUOTED));
}

/* Whether a block has a field that holds a colour other than 0. */
static int emits_by(const rt_block *block, const char *name, const rt_block_fields *fields)
{
    const rt_field *field = rt_schema_field(block, (rt_text){name, strlen(name)});
    float colour[3] = {0, 0, 0};
    if (field)
        memcpy(colour, (const unsigned char *)fields + field->offset, sizeof colour);
    return !is_black(colour);
}

/*
 * Warns where the texture of a shape has neither a diffuse albedo nor emission to multiply, and
 * where a shape emits instead of its material.
 */
static void warn_shape(const rt_statement *statement, const rt_entry *entry,
                       const rt_block_fields *fields, const rt_scope *scope, rt_reports *reports)
{
    const rt_block *block = statement->block;
    char quote[RT_QUOTE_SIZE];
    const rt_field *field = rt_schema_field(block, (rt_text){"material", strlen("material")});
    const rt_entry *given = field ? rt_statement_entry(statement, field) : NULL;
    const rt_text word = given ? rt_place_text(&given->word) : (rt_text){"", 0};
    const size_t found = given ? rt_names_find(&scope->materials, word) : RT_NAME_NONE;
    if (found == RT_NAME_NONE)
        return;
    const rt_name *material = &scope->materials.items[found];
    const int emits = emits_by(block, "radiance", fields) || emits_by(block, "power", fields);
    if (entry->field->type == RT_FIELD_TEXTURE && !emits && !material->has_kd)
        rt_report_warning(reports, entry->name, "'%s' has no effect: material '%s' has no 'kd'",
                          entry->field->name, rt_text_quote(quote, word));
    if (emits && material->emits && emits_by(block, entry->field->name, fields) &&
        entry->field->need == RT_NEED_AT_MOST_ONE)
        rt_report_warning(reports, entry->name,
                          "'%s' replaces the emission of material '%s', which has no effect here",
                          entry->field->name, rt_text_quote(quote, word));
}

/* Whether a field that a phrase names is given by an expression, which --set may change. */
static int may_change(const rt_statement *statement, const char *phrase)
{
    for (int i = 0; i < statement->entry_count; i++) {
        char quoted[64];
        const rt_entry *entry = &statement->entries[i];
        snprintf(quoted, sizeof quoted, "'%s'", entry->field->name);
        if (entry->value_count > 0 && entry->values[0].count > 0 && strstr(phrase, quoted))
            return 1;
    }
    return 0;
}

/* Whether a pattern is left without colours, which are black unless they are given. */
static int is_black_pattern(const rt_statement *statement, const rt_entry *entry,
                            const rt_block_fields *fields)
{
    const rt_texture *t = &fields->texture;
    const rt_field *a = rt_schema_field(statement->block, (rt_text){"a", strlen("a")});
    const int is_black_all_over =
        is_black(t->a) && is_black(t->b) && !t->a_texture && !t->b_texture;
    const int has_two = t->kind == RT_TEXTURE_CHECKER || t->kind == RT_TEXTURE_GRADIENT;
    const int takes_black = t->kind == RT_TEXTURE_CONSTANT || t->kind == RT_TEXTURE_MIX;
    return strcmp(entry->field->name, "pattern") == 0 && is_black_all_over &&
           (has_two || (takes_black && !rt_statement_entry(statement, a)));
}

static void warn_entry(const rt_statement *statement, const rt_entry *entry,
                       const rt_block_fields *fields, rt_reports *reports)
{
    const rt_block_id block = statement->block->id;
    if (block == RT_BLOCK_FILM || block == RT_BLOCK_RENDER)
        warn_setting(entry, &fields->options, reports);
    const char *without = missing(statement->block, entry->field, fields);
    if (without && !may_change(statement, without))
        rt_report_warning(reports, entry->name, "'%s' has no effect without %s", entry->field->name,
                          without);
    if (without && block == RT_BLOCK_MATERIAL && strcmp(entry->field->name, "ior") == 0 &&
        has_coat(fields))
        rt_report_hint(reports, "the index of a coat is 'coat_ior'");
    if (without && block == RT_BLOCK_MATERIAL && strcmp(without, "'coat'") == 0 &&
        is_principled(fields))
        rt_report_hint(reports, "a principled material has its coat by 'clearcoat'");
    if (block == RT_BLOCK_TEXTURE && is_black_pattern(statement, entry, fields))
        rt_report_warning(reports, entry->word, "this pattern is black all over: it has its %s",
                          fields->texture.kind == RT_TEXTURE_CONSTANT ? "colour by 'a'"
                                                                      : "colours by 'a' and 'b'");
    if (is_zero_left_out(entry, fields))
        rt_report_warning(reports, entry->name,
                          "'%s' of 0 has no effect: it counts as left out, and the emission of the "
                          "material holds",
                          entry->field->name);
}

void rt_no_effect_warn(const rt_statement *statement, const rt_block_fields *fields,
                       const rt_scope *scope, rt_reports *reports)
{
    for (int i = 0; i < statement->entry_count; i++) {
        warn_entry(statement, &statement->entries[i], fields, reports);
        warn_shape(statement, &statement->entries[i], fields, scope, reports);
    }
}

void rt_no_effect_warn_materials(const rt_statement *statement, rt_reports *reports)
{
    for (int i = 0; i < statement->entry_count; i++)
        if (statement->entries[i].field->type == RT_FIELD_FILE) {
            rt_report_warning(reports, statement->entries[i].word,
                              "the materials that this file names (mtllib, usemtl) are left out");
            rt_report_hint(reports, "every triangle has the 'material' and 'texture' of its block");
        }
}

void rt_no_effect_warn_mesh(const rt_statement *statement, const rt_mesh_warnings *warnings,
                            rt_reports *reports)
{
    for (int i = 0; i < statement->entry_count; i++)
        for (int k = 0; k < warnings->count; k++)
            if (statement->entries[i].field->type == RT_FIELD_FILE)
                rt_report_warning(reports, statement->entries[i].word, "%s", warnings->text[k]);
}

void rt_no_effect_warn_rest(const rt_statement *statement, rt_reports *reports)
{
    for (int i = 0; i < statement->entry_count; i++)
        if (statement->entries[i].field->type == RT_FIELD_FILE) {
            rt_report_warning(reports, statement->entries[i].word,
                              "this file goes on after the elements that its header announces: the "
                              "rest is left out");
            rt_report_hint(reports, "its line `element face N` gives the number of its faces");
        }
}
