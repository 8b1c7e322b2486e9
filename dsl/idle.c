#include "dsl/idle.h"

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
};

void rt_idle_warn(const rt_statement *statement, const rt_block_fields *fields, rt_reports *reports)
{
    for (size_t i = 0; i < sizeof needs / sizeof *needs; i++) {
        if (needs[i].block != statement->block->id || needs[i].has_effect(fields))
            continue;
        for (int j = 0; j < statement->setting_count; j++)
            if (rt_text_equal(rt_place_text(&statement->settings[j].name), needs[i].field))
                rt_report_warning(reports, statement->settings[j].name, "'%s' has no effect without %s",
                                  needs[i].field, needs[i].without);
    }
}
