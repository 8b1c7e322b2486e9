/* blocks.c - the tables of the language: blocks and fields, but for those of shapes in shapes.c. */
#include "dsl/rows.h"

static const rt_word projections[] = {RT_CAMERA_KINDS(RT_WORD) RT_WORD_END};
static const rt_word patterns[] = {RT_TEXTURE_KINDS(RT_WORD) RT_WORD_END};
static const rt_word wraps[] = {RT_WRAPS(RT_WORD) RT_WORD_END};
static const rt_word grid_wraps[] = {RT_GRID_WRAPS(RT_WORD) RT_WORD_END};
static const rt_word texture_filters[] = {RT_TEXTURE_FILTERS(RT_WORD) RT_WORD_END};
static const rt_word falloffs[] = {RT_FALLOFFS(RT_WORD) RT_WORD_END};
static const rt_word beam_sections[] = {RT_BEAM_SECTIONS(RT_WORD) RT_WORD_END};
static const rt_word texture_channels[] = {RT_TEXTURE_CHANNELS(RT_WORD) RT_WORD_END};
static const rt_word fresnels[] = {RT_FRESNELS(RT_WORD) RT_WORD_END};
static const rt_word distributions[] = {RT_DISTRIBUTIONS(RT_WORD) RT_WORD_END};
static const rt_word facet_scatterings[] = {RT_FACET_SCATTERINGS(RT_WORD) RT_WORD_END};
static const rt_word metals[] = {RT_METALS(RT_WORD) RT_WORD_END};
static const rt_word glasses[] = {RT_GLASSES(RT_WORD) RT_WORD_END};

/* ---- Fields -------------------------------------------------------------- */

static const rt_field camera_fields[] = {
    {"projection", CHOICE, OPTIONAL, ANY, "", "perspective", projections, AT(rt_camera, kind),
     "which rays the pixels stand for"},
    {"eye", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, eye), "position of the camera"},
    {"look_at", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_camera, look_at),
     "the point in the middle of the picture, without shift"},
    {"up", VECTOR, OPTIONAL, DIRECTION, "", "0 1 0", NULL, AT(rt_camera, up),
     "the direction that points up in the picture; not along the view"},
    {"fov", NUMBER, OPTIONAL, BETWEEN(0, 180), "degrees", "45", NULL, AT(rt_camera, fov),
     "full horizontal angle of view of a perspective camera"},
    {"width", NUMBER, OPTIONAL, LENGTH, "m", "2", NULL, AT(rt_camera, width),
     "width of what an orthographic camera sees"},
    {"aperture", NUMBER, OPTIONAL, LENGTH_OR_ZERO, "m", "0", NULL, AT(rt_camera, aperture),
     "radius of the lens; 0 is a pinhole, which has everything in focus"},
    {"focal_distance", NUMBER, OPTIONAL, LENGTH, "m", "that of look_at", NULL,
     AT(rt_camera, focal_distance), "distance along the view to the plane in focus"},
    {"blades", INTEGER, OPTIONAL, FROM_TO(3, 64), "", "round", NULL, AT(rt_camera, blades),
     "edges of the aperture, seen in what is out of focus; left out, it is round"},
    {"blade_rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_camera, blade_rotation),
     "turns the aperture counter-clockwise in the picture; at 0 a corner points to the right"},
    {"shift", PAIR, OPTIONAL, FROM_TO(-1000, 1000), "", "0 0", NULL, AT(rt_camera, shift),
     "moves the picture over what is seen, to the right by this part of its width and up by this "
     "part of its height: verticals stay upright where a camera that is turned makes them meet"},
    {"mirror", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_camera, mirror),
     "whether left and right of the picture are exchanged"},
    {"hide_emitters", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_camera, hide_emitters),
     "whether the picture shows what lies behind shapes that emit, and black for the environment; "
     "both light the scene, and are seen in mirrors and through glass, as ever. Albedo, normals "
     "and depth are of what is shown"},
};

static const rt_field texture_fields[] = {
    {"pattern", CHOICE, OPTIONAL, ANY, "", "image", patterns, AT(rt_texture, kind),
     "where the colours come from"},
    {"file", FILE_NAME, OPTIONAL, ANY, "", "required of an image", NULL, AT(rt_texture, path),
     "image file:" RT_IMAGE_FORMATS(RT_IMAGE_EXTENSION)},
    {"linear", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_texture, linear),
     "of an image: true: the file holds linear values, such as radiance or heights; false: files "
     "of 8 and 16 bits hold sRGB"},
    {"channel", CHOICE, OPTIONAL, ANY, "", "all", texture_channels, AT(rt_texture, channel),
     "what of an image is read: files for games keep roughness in green, masks in alpha"},
    {"power", NUMBER, OPTIONAL, FROM_TO(0.1, 10), "", "1", NULL, AT(rt_texture, power),
     "of an image: its linear values are raised to this: 2 makes alpha of GGX of a roughness whose "
     "square it is, as glTF and Blender have it"},
    {"a", COLOUR, OPTIONAL, LIGHT, "", "0", NULL, AT(rt_texture, a),
     "of a checker: the first square; of a gradient: the colour at v = 0; of a constant: its "
     "colour; of a product: one factor; of a mixture: the one, of part 1 - weight"},
    {"b", COLOUR, OPTIONAL, LIGHT, "", "0", NULL, AT(rt_texture, b),
     "of a checker: the other square; of a gradient: the colour at v = 1; of a product: the other "
     "factor; of a mixture: the other, of part weight"},
    {"a_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_texture, a_texture),
     "a texture inside of this one, of any pattern: multiplies a; replaces it where a is left out"},
    {"b_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_texture, b_texture),
     "multiplies b; replaces it where b is left out"},
    {"weight", NUMBER, OPTIONAL, FROM_TO(1e-6, 1), "", "0.5, or 1 with weight_texture", NULL,
     AT(rt_texture, weight), "of a mixture: the part of b"},
    {"weight_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_texture, weight_texture),
     "of a mixture: the mean of its channels multiplies weight"},
    {"wrap", CHOICE, OPTIONAL, ANY, "", "repeat", wraps, AT(rt_texture, wrap),
     "how an image or gradient continues beyond 0 to 1"},
    {"filter", CHOICE, OPTIONAL, ANY, "", "bilinear", texture_filters, AT(rt_texture, filter),
     "what an image has between the centres of its texels"},
    {"scale", PAIR, OPTIONAL, NOT_ZERO, "", "1 1", NULL, AT(rt_texture, scale),
     "u and v are multiplied by this: 4 4 repeats the texture four times along u and along "
     "v"},
    {"offset", PAIR, OPTIONAL, ANY, "", "0 0", NULL, AT(rt_texture, offset),
     "and, at last, moved by this"},
    {"rotate", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_texture, rotate),
     "between the two, (u, v) is turned counter-clockwise about (0, 0), so that the picture turns "
     "clockwise, and the normals of a normal map with it"},
    {"shear", NUMBER, OPTIONAL, ANY, "", "0", NULL, AT(rt_texture, shear),
     "before the rotation, this times v is added to u, which makes squares slant"},
    {"layer", STRING, OPTIONAL, ANY, "", "the picture itself", NULL, AT(rt_texture, layer),
     "of an .exr image: the layer that is read, such as `\"albedo\"` or "
     "`\"ViewLayer.Combined\"`"},
    {"attribute", STRING, OPTIONAL, ANY, "", "u and v", NULL, AT(rt_texture, attribute),
     "an attribute of meshes (see [`mesh`](#mesh)): one of two numbers takes the place of u and v "
     "of an image, checker or gradient, as a second set of texture coordinates"},
};

static const rt_field grid_fields[] = {
    {"file", FILE_NAME, REQUIRED, ANY, "", "", NULL, AT(rt_grid, path),
     "the densities or albedos; .vdb and .nvdb are read by OpenVDB"},
    {"layer", STRING, OPTIONAL, ANY, "", "`\"density\"`, or the only one", NULL, AT(rt_grid, layer),
     "of a .vdb or .nvdb: the grid that is read"},
    {"lo", VECTOR, ALL_OR_NONE, ANY, "m", "0 0 0", NULL, AT(rt_grid, lo),
     "corner of the box where voxel 0 0 0 begins; give this and `hi` or neither. A .vdb has a "
     "place "
     "of its own"},
    {"hi", VECTOR, ALL_OR_NONE, ANY, "m", "1 1 1", NULL, AT(rt_grid, hi),
     "the opposite corner, greater along each axis"},
    {"wrap", CHOICE, OPTIONAL, ANY, "", "clamp", grid_wraps, AT(rt_grid, wrap),
     "how an albedo continues outside of the box"},
    TRANSFORM(rt_grid, transform),
};

/* The inputs of a material, and their textures. */
#define INPUT(TYPE, name, RANGE, NEED, unit, help)                                                 \
    ROW(#name, TYPE, OPTIONAL, RANGE, unit, "0", NULL, AT(rt_material, name), help),
#define COLOUR_FACTOR ""
#define NUMBER_FACTOR "the mean of its channels "
#define INPUT_TEXTURE(TYPE, name, RANGE, NEED, unit, help)                                         \
    ROW(#name "_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL,                                \
        AT(rt_material, name##_texture),                                                           \
        TYPE##_FACTOR "multiplies " #name "; replaces it where " #name " is left out"),

static const rt_field material_fields[] = {
    RT_MATERIAL_INPUTS(INPUT){"ior", NUMBER, OPTIONAL, FROM_TO(0.1, 10), "", "1.5, or by specular",
                              NULL, AT(rt_material, ior), "index of refraction of the inside"},
    {"relative_ior", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, relative_ior),
     "ior, coat_ior, eta and k are those over the index outside, whatever medium is there: as in "
     "Mitsuba and pbrt"},
    {"abbe", NUMBER, OPTIONAL, FROM_TO(1, 1000), "", "no dispersion", NULL, AT(rt_material, abbe),
     "of a solid: its Abbe number V_d = (n_d - 1) / (n_F - n_C), with ior as n_d: light is "
     "dispersed, the index being A + B / l^2 at the wavelength l"},
    {"cauchy", PAIR, OPTIONAL, NOT_ZERO, "", "no dispersion", NULL, AT(rt_material, cauchy),
     "in place of ior: A and B of the index A + B / l^2, l in micrometres"},
    {"sellmeier_b", VECTOR, OPTIONAL, ANY, "", "no dispersion", NULL, AT(rt_material, sellmeier_b),
     "in place of ior: B of the index n^2 = 1 + sum of B l^2 / (l^2 - C), l in micrometres, as "
     "makers of glass state it"},
    {"sellmeier_c", VECTOR, OPTIONAL, ANY, "micrometres^2", "0 0 0", NULL,
     AT(rt_material, sellmeier_c), "C of that"},
    {"dispersion", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, dispersion),
     "true: `glass` has the index that was measured at each wavelength; ethanol, glycerol and "
     "borosilicate have none"},
    {"specular", NUMBER, OPTIONAL, UNIT, "", "by ior", NULL, AT(rt_material, specular),
     "principled, in place of ior: reflectance of what is no metal, straight on 0.08 of it; 0.5 is "
     "that of ior 1.5"},
    {"distribution", CHOICE, OPTIONAL, ANY, "", "ggx", distributions, AT(rt_material, distribution),
     "of the microfacets of ks and kt, and of the coat"},
    {"facet_scattering", CHOICE, OPTIONAL, ANY, "", "multiple", facet_scatterings,
     AT(rt_material, facet_scattering),
     "of rough ks and kt, and of a rough coat: what becomes of light that meets more than one "
     "microfacet. kt without fresnel, and roughness_v with a texture of roughness, lose it in any "
     "case"},
    {"anisotropy_rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL,
     AT(rt_material, anisotropy_rotation),
     "turns the directions of roughness and roughness_v about the normal, from u towards v"},
    {"coat_ior", NUMBER, OPTIONAL, FROM_TO(1, 3), "", "1.5", NULL, AT(rt_material, coat_ior),
     "of the coat: index of refraction"},
    {"coat_linear", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, coat_linear),
     "true: colours below the coat stay those of kd; false: they are deepened by the light that "
     "goes to and fro below it"},
    {"thin", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, thin),
     "true: a thin sheet, as a pane or a soap film: what it transmits goes straight on, and it "
     "reflects by both of its sides"},
    {"fresnel", CHOICE, OPTIONAL, ANY, "", "off", fresnels, AT(rt_material, fresnel),
     "how reflection and refraction depend on the angle; dielectric between two media where that "
     "of either is"},
    {"eta", COLOUR, OPTIONAL, FROM_TO(0, 100), "", "required of a conductor", NULL,
     AT(rt_material, eta), "of a conductor: index of refraction, by channel"},
    {"k", COLOUR, OPTIONAL, FROM_TO(0, 100), "", "0", NULL, AT(rt_material, k),
     "of a conductor: extinction, by channel"},
    {"metal", CHOICE, OPTIONAL, ANY, "", "none", metals, AT(rt_material, metal),
     "fresnel conductor with the eta and k of a metal, by which ks 1 has the colour that the metal "
     "has by daylight (D65); ks is 1 where it is left out; without fresnel, eta, k and ior. Each "
     "with who measured it"},
    {"glass", CHOICE, OPTIONAL, ANY, "", "none", glasses, AT(rt_material, glass),
     "fresnel dielectric with the ior of a glass or another clear medium at 587.56 nm, or at each "
     "wavelength with dispersion; kt is 1 where ks and kt are left out; without fresnel and ior. "
     "Each with who measured it"},
    {"exponent", NUMBER, OPTIONAL, FROM_TO(1, 1e4), "", "none", NULL, AT(rt_material, exponent),
     "of ks: n of the modified Phong lobe, ks (n + 2) / (2 pi) times the n-th power of the cosine "
     "about the mirror direction (Lafortune and Willems 1994), for scenes made with it; without "
     "kt, roughness, distribution and fresnel. Light towards grazing angles is lost; GGX keeps it"},
    {"absorption", COLOUR, OPTIONAL, LIGHT, "1/m", "0", NULL, AT(rt_material, absorption),
     "of the inside, by channel: light is attenuated to exp(-absorption) per metre; colours thick "
     "glass"},
    {"scattering", COLOUR, OPTIONAL, LIGHT, "1/m", "0", NULL, AT(rt_material, scattering),
     "of the inside, by channel: scattering coefficient, as of milk or smoke"},
    {"g", NUMBER, OPTIONAL, FROM_TO(-0.99, 0.99), "", "0", NULL, AT(rt_material, g),
     "of scattering: mean cosine of the angle; above 0 forward, below 0 backward"},
    {"density", GRID, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, density),
     "multiplies absorption and scattering; left out, they are the same everywhere inside"},
    {"albedo", GRID, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, albedo),
     "the part of scattering that scatters, the rest being absorbed; without absorption, that is "
     "the albedo of single scattering. Left out, all of it scatters"},
    {"interface", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, interface),
     "true: no surface; light passes unchanged, and only the medium inside has an effect"},
    {"opacity", NUMBER, OPTIONAL, FROM_TO(1e-6, 1), "", "1", NULL, AT(rt_material, opacity),
     "the part of all rays that meet the surface, which is not there for the others: leaves, "
     "grilles, gauze. What it emits counts as much. Not of solids: kt needs thin"},
    {"opacity_cutoff", NUMBER, OPTIONAL, FROM_TO(1e-6, 1), "", "none", NULL,
     AT(rt_material, opacity_cutoff), "opacities from there on count as 1, others as 0"},
    {"two_sided", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, two_sided),
     "true: both sides emit"},
    {"priority", INTEGER, OPTIONAL, FROM_TO(0, INTEGER_LAST), "", "0", NULL,
     AT(rt_material, priority),
     "where solids overlap, the material of higher priority fills the overlap, among equals the "
     "one that light entered last"},
    RT_MATERIAL_INPUTS(INPUT_TEXTURE){"opacity_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL,
                                      AT(rt_material, opacity_texture),
                                      "the mean of its channels multiplies opacity"},
    {"bump_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, bump_texture),
     "its brightness is a height that perturbs the shading normal"},
    {"bump_scale", NUMBER, OPTIONAL, NOT_ZERO, "m", "1", NULL, AT(rt_material, bump_scale),
     "height of a brightness of 1"},
    {"normal_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, normal_texture),
     "a normal map in tangent space, `linear true`: 2 rgb - 1 is the shading normal, x along u, y "
     "along v and z along the normal without it; bumps lie on top of it"},
    {"normal_scale", NUMBER, OPTIONAL, NOT_ZERO, "", "1", NULL, AT(rt_material, normal_scale),
     "of x and y of the normal map"},
    {"normal_flip", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, normal_flip),
     "true: y of the normal map, its green, is against v, as DirectX has it; false: along v, as "
     "OpenGL, glTF and Blender do"},
    {"bump_shadowing", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(rt_material, bump_shadowing),
     "whether bumps and normal maps shadow themselves: light that grazes the surface is weaker, "
     "the "
     "more so the farther they tilt its normal, and its terminator is soft, as in Mitsuba 3"},
    {"blend", PART, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, blend),
     "a blend of this material and that of `with`: light meets one or the other. Lobes and inside "
     "are those of the two, emission, opacity, bumps and normal map those of the blend"},
    {"with", PART, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, with),
     "the other material of a blend"},
    {"weight", NUMBER, OPTIONAL, FROM_TO(1e-6, 1), "", "0.5, or 1 with weight_texture", NULL,
     AT(rt_material, weight), "of a blend: the part of `with`"},
    {"weight_texture", TEXTURE, OPTIONAL, ANY, "", "none", NULL, AT(rt_material, weight_texture),
     "the mean of its channels multiplies weight"},
    {"back", PART, OPTIONAL, ANY, "", "the same", NULL, AT(rt_material, back),
     "the material on the side against the normal; `black` reflects nothing. Of opaque materials "
     "alone"},
};

static const rt_field point_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_point_light, position),
     "position of the light"},
    {"intensity", COLOUR, ONE_OF, LIGHT, "W/sr", "this or power is required", NULL,
     AT(rt_point_light, intensity), "radiant intensity, the same in every direction"},
    {"power", COLOUR, ONE_OF, LIGHT, "W", "this or intensity is required", NULL,
     AT(rt_point_light, power), "emitted flux; 4 pi times the intensity"},
};

#define LIGHT_FORMATS ".exr, .hdr, .pfm, .png or another that textures have"
#define LIGHT_IMAGE(type, need, fallback, help)                                                    \
    {"file", FILE_NAME, need, ANY, "", fallback, NULL, AT(type, path), help},                      \
        {"layer",                                                                                  \
         STRING,                                                                                   \
         OPTIONAL,                                                                                 \
         ANY,                                                                                      \
         "",                                                                                       \
         "the picture itself",                                                                     \
         NULL,                                                                                     \
         AT(type, layer),                                                                          \
         "of an .exr image: the layer that is read, such as `\"Gobo\"`"},                          \
    {                                                                                              \
        "filter", CHOICE, OPTIONAL, ANY, "", "bilinear", texture_filters, AT(type, filter),        \
            "between the centres of the image's pixels, its texels"                                \
    }
#define LIGHT_REPEAT(type)                                                                         \
    {                                                                                              \
        "repeat", BOOLEAN, OPTIONAL, ANY, "", "false", NULL, AT(type, repeat),                     \
            "true: the image is mixed at its edges with what lies at the opposite ones, as one "   \
            "that repeats"                                                                         \
    }
#define LIGHT_UP(type, help)                                                                       \
    {                                                                                              \
        "up", VECTOR, OPTIONAL, DIRECTION, "", "0 1 0, or 0 0 -1 along y", NULL, AT(type, up),     \
            help                                                                                   \
    }

static const rt_field spot_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_spot_light, position),
     "position of the light"},
    {"target", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_spot_light, target),
     "a point on its axis"},
    {"intensity", COLOUR, REQUIRED, LIGHT, "W/sr", "", NULL, AT(rt_spot_light, intensity),
     "radiant intensity on the axis"},
    {"outer", NUMBER, OPTIONAL, HALF_TURN, "degrees", "30", NULL, AT(rt_spot_light, outer),
     "angle from the axis beyond which nothing is emitted"},
    {"inner", NUMBER, OPTIONAL, FROM_TO(0, 180), "degrees", "0", NULL, AT(rt_spot_light, inner),
     "angle from the axis up to which the intensity is full; at most `outer`"},
    {"falloff", CHOICE, OPTIONAL, ANY, "", "smooth", falloffs, AT(rt_spot_light, falloff),
     "between the two, at the angle a, the part of the intensity"},
    LIGHT_IMAGE(rt_spot_light, OPTIONAL, "none",
                "an image that multiplies the intensity: " LIGHT_FORMATS
                "; it fills the square around the cone on a plane across the axis"),
    LIGHT_REPEAT(rt_spot_light),
    LIGHT_UP(rt_spot_light, "of the image: where its top is; not along the axis"),
};

static const rt_field projector_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_projector_light, position),
     "position of the light"},
    {"target", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_projector_light, target),
     "a point on its axis, which the middle of the image is shown at"},
    {"irradiance", COLOUR, ONE_OF, LIGHT, "W/m^2", "this or intensity is required", NULL,
     AT(rt_projector_light, irradiance),
     "where the image is 1, that of a plane across the axis 1 m away; it falls by the square of "
     "the distance of such planes"},
    {"intensity", COLOUR, ONE_OF, LIGHT, "W/sr", "this or irradiance is required", NULL,
     AT(rt_projector_light, intensity),
     "where the image is 1; such planes are then darker away from the axis, by the cube of the "
     "cosine"},
    {"fov", NUMBER, OPTIONAL, FROM_TO(0.001, 179), "degrees", "45", NULL,
     AT(rt_projector_light, fov), "full angle across the image; down it, by its pixels"},
    LIGHT_IMAGE(rt_projector_light, REQUIRED, "", "the image: " LIGHT_FORMATS),
    LIGHT_REPEAT(rt_projector_light),
    LIGHT_UP(rt_projector_light, "where the top of the image is; not along the axis"),
};

static const rt_field goniometric_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_goniometric_light, position),
     "position of the light"},
    {"target", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_goniometric_light, target),
     "a point on its axis, which has the vertical angle 0 or the top row of the image: below a "
     "luminaire on a ceiling"},
    {"intensity", COLOUR, OPTIONAL, LIGHT, "W/sr", "1/179 of an IES file, 1 of an image", NULL,
     AT(rt_goniometric_light, intensity), "of a candela in the IES file, or where the image is 1"},
    LIGHT_IMAGE(rt_goniometric_light, REQUIRED, "",
                "an IES file, .ies, or an image of latitude and longitude: " LIGHT_FORMATS),
    LIGHT_UP(rt_goniometric_light,
             "towards which the horizontal angle 0 and the left edge of the image lie; not along "
             "the axis"),
};

static const rt_field beam_light_fields[] = {
    {"position", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_beam_light, position),
     "the middle of the cross section that it starts from"},
    {"target", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_beam_light, target),
     "a point on its axis"},
    {"irradiance", COLOUR, ONE_OF, LIGHT, "W/m^2", "this or power is required", NULL,
     AT(rt_beam_light, irradiance), "irradiance of a surface across the beam, at any distance"},
    {"power", COLOUR, ONE_OF, LIGHT, "W", "this or irradiance is required", NULL,
     AT(rt_beam_light, power), "emitted flux; the irradiance times the area of the cross section"},
    {"width", NUMBER, REQUIRED, FROM_TO(1e-15, 1e15), "m", "", NULL, AT(rt_beam_light, width),
     "width of the cross section; of a disc its diameter"},
    {"height", NUMBER, OPTIONAL, FROM_TO(1e-15, 1e15), "m", "the width", NULL,
     AT(rt_beam_light, height), "height of the cross section"},
    {"cross_section", CHOICE, OPTIONAL, ANY, "", "round", beam_sections,
     AT(rt_beam_light, cross_section), "its shape"},
    LIGHT_UP(rt_beam_light, "along which the height is; not along the axis"),
};

static const rt_field directional_light_fields[] = {
    {"direction", VECTOR, REQUIRED, DIRECTION, "", "", NULL, AT(rt_directional_light, direction),
     "direction in which the light travels; of any length"},
    {"irradiance", COLOUR, REQUIRED, LIGHT, "W/m^2", "", NULL, AT(rt_directional_light, irradiance),
     "irradiance of a surface that faces the light"},
};

static const rt_field environment_light_fields[] = {
    {"radiance", COLOUR, OPTIONAL, LIGHT, "W/(m^2 sr)", "1 with an image, else 0", NULL,
     AT(rt_environment, radiance), "radiance from every direction; multiplies the image"},
    {"file", FILE_NAME, OPTIONAL, ANY, "", "none", NULL, AT(rt_environment, path),
     "an image of latitude and longitude: .exr, .hdr, .pfm, .png or another that textures have; "
     "its middle column is seen towards -z, its top row is +y"},
    {"rotation", NUMBER, OPTIONAL, ANY, "degrees", "0", NULL, AT(rt_environment, rotation),
     "turns the image about y, to the left as seen from inside, before its transform"},
    {"rotate", RT_FIELD_ROTATE, OPTIONAL, DIRECTION, "degrees", "none", NULL,
     AT(rt_environment, transform),
     "turns the image about an axis (three numbers) by an angle, counter-clockwise seen against "
     "the "
     "axis; see [Transforms](#transforms)"},
    {"scale", RT_FIELD_SCALE, OPTIONAL, NOT_ZERO, "", "none", NULL, AT(rt_environment, transform),
     "mirrors the image where negative, alike or by x, y and z; of one size, which does not "
     "matter"},
    {"matrix", RT_FIELD_MATRIX, OPTIONAL, ANY, "", "none", NULL, AT(rt_environment, transform),
     "a rotation, a mirroring or both: three rows of four, the last column 0"},
    {"layer", STRING, OPTIONAL, ANY, "", "the picture itself", NULL, AT(rt_environment, layer),
     "of an .exr image: the layer that is read, such as `\"ViewLayer.Env\"`"},
};

static const rt_field portal_fields[] = {
    {"corner", VECTOR, REQUIRED, ANY, "m", "", NULL, AT(rt_portal, corner),
     "one corner of the opening"},
    {"edge1", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(rt_portal, edge1),
     "from it to the next corner"},
    {"edge2", VECTOR, REQUIRED, DIRECTION, "m", "", NULL, AT(rt_portal, edge2),
     "from it to the other neighbour"},
};

static const rt_field medium_fields[] = {
    {"absorption", COLOUR, OPTIONAL, LIGHT, "1/m", "0", NULL, AT(rt_medium, absorption),
     "absorption coefficient, by channel"},
    {"scattering", COLOUR, OPTIONAL, LIGHT, "1/m", "0", NULL, AT(rt_medium, scattering),
     "scattering coefficient, by channel"},
    {"g", NUMBER, OPTIONAL, FROM_TO(-0.99, 0.99), "", "0", NULL, AT(rt_medium, g),
     "mean cosine of the angle by which it scatters, of the phase function of Henyey and "
     "Greenstein: above 0 forward, below 0 backward"},
    {"density", GRID, OPTIONAL, ANY, "", "none", NULL, AT(rt_medium, density),
     "multiplies absorption and scattering; left out, they are the same everywhere"},
    {"albedo", GRID, OPTIONAL, ANY, "", "none", NULL, AT(rt_medium, albedo),
     "the part of scattering that scatters, the rest being absorbed; left out, all of it scatters"},
};

/* ---- Blocks -------------------------------------------------------------- */

const rt_block rt_blocks[RT_BLOCK_MESH] = {
    {RT_BLOCK_CAMERA, "camera", NULL, RT_BLOCK_ONCE, FIELDS(camera_fields), NULL},
    {RT_BLOCK_FILM, "film", NULL, RT_BLOCK_ONCE, NULL, 0, NULL},
    {RT_BLOCK_RENDER, "render", NULL, RT_BLOCK_ONCE, NULL, 0, NULL},
    {RT_BLOCK_TEXTURE, "texture", NULL, RT_BLOCK_NAMED, FIELDS(texture_fields), NULL},
    {RT_BLOCK_GRID, "grid", NULL, RT_BLOCK_NAMED, FIELDS(grid_fields), NULL},
    {RT_BLOCK_MATERIAL, "material", NULL, RT_BLOCK_NAMED, FIELDS(material_fields), NULL},
    {RT_BLOCK_POINT_LIGHT, "light", "point", 0, FIELDS(point_light_fields), NULL},
    {RT_BLOCK_SPOT_LIGHT, "light", "spot", 0, FIELDS(spot_light_fields), NULL},
    {RT_BLOCK_PROJECTOR_LIGHT, "light", "projector", 0, FIELDS(projector_light_fields), NULL},
    {RT_BLOCK_GONIOMETRIC_LIGHT, "light", "goniometric", 0, FIELDS(goniometric_light_fields), NULL},
    {RT_BLOCK_BEAM_LIGHT, "light", "beam", 0, FIELDS(beam_light_fields), NULL},
    {RT_BLOCK_DIRECTIONAL_LIGHT, "light", "directional", 0, FIELDS(directional_light_fields), NULL},
    {RT_BLOCK_ENVIRONMENT_LIGHT, "light", "environment", RT_BLOCK_ONCE,
     FIELDS(environment_light_fields), NULL},
    {RT_BLOCK_PORTAL, "portal", NULL, 0, FIELDS(portal_fields), NULL},
    {RT_BLOCK_MEDIUM, "medium", NULL, RT_BLOCK_ONCE, FIELDS(medium_fields), NULL},
};
