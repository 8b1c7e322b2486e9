#include "dsl/idle.h"

#include <string.h>

/* ---- What a field may need ------------------------------------------------ */

static int is_black(const float colour[3])
{
    return colour[0] == 0 && colour[1] == 0 && colour[2] == 0;
}

static int is_conductor(const rt_block_fields *fields)
{
    return fields->material.fresnel == RT_FRESNEL_CONDUCTOR;
}

static int is_specular(const rt_block_fields *fields)
{
    const rt_material *m = &fields->material;
    return !is_black(m->ks) || !is_black(m->kt) || m->ks_texture || m->kt_texture;
}

static int has_bumps(const rt_block_fields *fields)
{
    return fields->material.bump_texture != 0;
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

static int is_no_image(const rt_block_fields *fields)
{
    return fields->texture.kind != RT_TEXTURE_IMAGE;
}

static int has_disc(const rt_block_fields *fields)
{
    return fields->options.area == RT_AREA_DISC;
}

static int has_cone(const rt_block_fields *fields)
{
    return fields->options.kernel == RT_DENSITY_CONE ||
           fields->options.caustic_kernel == RT_DENSITY_CONE;
}

/* ---- The table ------------------------------------------------------------ */

/* A field of a block, and what it does nothing without. */
static const struct {
    rt_block_id block;
    const char *field;
    int (*has_effect)(const rt_block_fields *fields);
    const char *without;
} needs[] = {
    {RT_BLOCK_MATERIAL, "eta", is_conductor, "'fresnel conductor'"},
    {RT_BLOCK_MATERIAL, "k", is_conductor, "'fresnel conductor'"},
    {RT_BLOCK_MATERIAL, "roughness", is_specular, "'ks' or 'kt'"},
    {RT_BLOCK_MATERIAL, "ior", is_specular, "'ks' or 'kt'"},
    {RT_BLOCK_MATERIAL, "absorption", is_specular, "'ks' or 'kt'"},
    {RT_BLOCK_MATERIAL, "bump_scale", has_bumps, "'bump_texture'"},
    {RT_BLOCK_CAMERA, "width", is_orthographic, "'projection orthographic'"},
    {RT_BLOCK_CAMERA, "fov", is_perspective, "'projection perspective'"},
    {RT_BLOCK_CAMERA, "aperture", may_have_lens, "another 'projection'"},
    {RT_BLOCK_CAMERA, "focal_distance", has_lens, "'aperture'"},
    {RT_BLOCK_CAMERA, "blades", has_lens, "'aperture'"},
    {RT_BLOCK_CAMERA, "blade_rotation", has_blades, "'blades'"},
    {RT_BLOCK_TEXTURE, "file", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "linear", is_image, "'pattern image'"},
    {RT_BLOCK_TEXTURE, "a", is_no_image, "'pattern checker' or 'pattern gradient'"},
    {RT_BLOCK_TEXTURE, "b", is_no_image, "'pattern checker' or 'pattern gradient'"},
    {RT_BLOCK_RENDER, "kernel", has_disc, "'area disc'"},
    {RT_BLOCK_RENDER, "caustic_kernel", has_disc, "'area disc'"},
    {RT_BLOCK_RENDER, "cone_k", has_disc, "'area disc'"},
    {RT_BLOCK_RENDER, "cone_k", has_cone, "'kernel cone' or 'caustic_kernel cone'"},
};

/* The texture that stands for a colour of a material when that is black, or 0. */
static uint32_t texture_beside(const char *field, const rt_material *m)
{
    return strcmp(field, "kd") == 0         ? m->kd_texture
           : strcmp(field, "ks") == 0       ? m->ks_texture
           : strcmp(field, "kt") == 0       ? m->kt_texture
           : strcmp(field, "emission") == 0 ? m->emission_texture
                                            : 0;
}

/*
 * Whether a setting is a colour for which 0 counts as left out: something else, which is not black,
 * stands for it.
 */
static int is_idle_black(const rt_statement *statement, const rt_setting *setting,
                         const rt_block_fields *fields)
{
    const rt_field *field = rt_schema_field(statement->block, rt_place_text(&setting->name));
    float colour[3];
    int is_lamp = field->need == RT_NEED_AT_MOST_ONE;
    int is_sky = statement->block->id == RT_BLOCK_ENVIRONMENT_LIGHT && fields->environment.path;
    int is_textured = statement->block->id == RT_BLOCK_MATERIAL &&
                      texture_beside(field->name, &fields->material) != 0;
    if (field->type != RT_FIELD_COLOUR || !(is_lamp || is_sky || is_textured))
        return 0;
    memcpy(colour, (const unsigned char *)fields + field->offset, sizeof colour);
    return is_black(colour);
}

void rt_idle_warn(const rt_statement *statement, const rt_block_fields *fields, rt_reports *reports)
{
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        if (needs[i].block != statement->block->id || needs[i].has_effect(fields))
            continue;
        for (int j = 0; j < statement->setting_count; j++)
            if (rt_text_equal(rt_place_text(&statement->settings[j].name), needs[i].field))
                rt_report_warning(reports, statement->settings[j].name,
                                  "'%s' has no effect without %s", needs[i].field,
                                  needs[i].without);
    }
    for (int j = 0; j < statement->setting_count; j++) {
        char quote[RT_QUOTE_SIZE];
        if (is_idle_black(statement, &statement->settings[j], fields))
            rt_report_warning(reports, statement->settings[j].name,
                              "'%s' of 0 has no effect: it counts as left out",
                              rt_text_quote(quote, rt_place_text(&statement->settings[j].name)));
    }
}
