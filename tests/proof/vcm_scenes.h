/* vcm_scenes.h - the scenes in which the techniques of mode vcm are compared. */
#ifndef RT_TESTS_PROOF_VCM_SCENES_H
#define RT_TESTS_PROOF_VCM_SCENES_H

/* A closed room, 2 m each way, with a quad in its ceiling that emits; the camera looks down. */
#define WALLS                                                                                      \
    "material white { kd 0.7 }\nmaterial red { kd 0.7 0.2 0.1 }\nmaterial green { kd 0.1 0.6 0.2 " \
    "}\n"                                                                                          \
    "quad { corner -1 2 -1  edge1 2 0 0  edge2 0 0 2  material white }\n"                          \
    "quad { corner -1 0 1  edge1 0 2 0  edge2 2 0 0  material white }\n"                           \
    "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 2 0  material white }\n"                          \
    "quad { corner -1 0 -1  edge1 0 2 0  edge2 0 0 2  material red }\n"                            \
    "quad { corner 1 0 -1  edge1 0 0 2  edge2 0 2 0  material green }\n"                           \
    "material emitter { emission 3 }\n"                                                            \
    "quad { corner -0.5 1.95 -0.5  edge1 1 0 0  edge2 0 0 1  material emitter }\n"

/* What stands in it is diffuse. */
static const char vcm_diffuse[] =
    "camera { eye 0 1.2 -0.95  look_at 0 0.2 0.6  fov 55 }\n" WALLS
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"
    "sphere { centre -0.4 0.3 0.3  radius 0.3  material white }\n"
    "sphere { centre 0.5 0.25 0.1  radius 0.25  material red }\n";

/* A smooth ball of glass over a glossy floor, on which a rough one lies. */
static const char vcm_glass[] =
    "camera { eye 0 0.7 -0.9  look_at 0 0 0.2  fov 55 }\n" WALLS
    "material gloss { kd 0.3  ks 0.4  roughness 0.3 }\n"
    "material clear { kt 1  ior 1.5  fresnel dielectric }\n"
    "material frosted { kt 1  ior 1.4  fresnel dielectric  roughness 0.4 }\n"
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material gloss }\n"
    "sphere { centre 0.1 1.3 0.1  radius 0.4  material clear }\n"
    "sphere { centre -0.15 0.31 0.2  radius 0.3  material frosted }\n";

/*
 * A transparent ball that emits on both sides lies partly in a box of what absorbs its light, and a
 * lamp of two sides in the bottom of that. A point light lies in a sheet, and behind a screen: what
 * it sends through the ball and the box, path tracing would not find.
 */
static const char vcm_enclosed[] =
    "camera { eye 0 0.7 -0.9  look_at 0 0 0.2  fov 55 }\n" WALLS
    "material liquid { kt 1  ior 1  absorption 4 1 0.5  priority 1 }\n"
    "material lamp { kt 0.3  ior 1  emission 8 6 4  two_sided true }\n"
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"
    "box { centre 0 1.4 0.1  size 0.6 0.6 0.6  material liquid }\n"
    "sphere { centre 0.3 1.4 0.1  radius 0.3  material lamp }\n"
    "material plate { emission 4  two_sided true }\n"
    "quad { corner -0.25 1.1 0  edge1 0 0 0.2  edge2 0.2 0 0  material plate }\n"
    "material sheet { kt 0.5  ior 1 }\n"
    "quad { corner -0.9 1.5 -0.3  edge1 0 0 0.5  edge2 0.5 0 0  material sheet }\n"
    "light point { position -0.65 1.5 -0.05  intensity 6 }\n"
    "quad { corner -0.35 1 -0.6  edge1 0 0 1.5  edge2 0 0.95 0  material white }\n";

/* The sky over a floor and a wall, and an endless solid above that absorbs a part of it or all. */
static const char vcm_half_space[] =
    "camera { eye 0 1.2 -1.6  look_at 0 0 1  fov 46 }\n"
    "material white { kd 0.6 }\nmaterial liquid { kt 1  ior 1  absorption 1 2 3  priority 1 }\n"
    "light environment { radiance 1 }\n"
    "quad { corner -2 0 -2  edge1 0 0 4  edge2 4 0 0  material white }\n"
    "quad { corner -2 0 2  edge1 0 3 0  edge2 4 0 0  material white }\n"
    "plane { point 0 3.5 0  normal 0 -1 0  material liquid }\n";

/* Textures on quads and on a mesh, which has normals and texture coordinates of its own, bumps. */
static const char vcm_textures[] =
    "camera { eye 0 1.2 -0.95  look_at 0 0.2 0.6  fov 55 }\n" WALLS
    "texture squares { pattern checker  a 0.95  b 0.05  scale 3 3 }\n"
    "texture steps { pattern gradient  a 0  b 1  wrap mirror  scale 1 8 }\n"
    "material tiles { kd 0.9  kd_texture squares }\n"
    "material ribbed { kd 0.8 0.6 0.3  kd_texture squares  bump_texture steps  bump_scale 0.02 }\n"
    "mesh knot { file \"scenes/meshes/knot.ply\" }\n"
    "instance knot { material ribbed  scale 0.5  translate 0 0.5 0.3 }\n"
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material tiles }\n";

/* The room with something whose shading normals lean far from its faces, as %s says. */
static const char vcm_leaning[] =
    "camera { eye 0 1.2 -0.95  look_at 0 0.3 0.6  fov 55 }\n" WALLS
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"
    "material gloss { kd 0.3  ks 0.5  roughness 0.4 }\n"
    "material frosted { kt 1  ior 1.4  fresnel dielectric  roughness 0.4 }\n"
    "material clear { kt 1  ior 1.5  fresnel dielectric }\n"
    "texture ridges { pattern gradient  a 0  b 1  wrap mirror  scale 6 32 }\n"
    "material bumpy { kd 0.7  bump_texture ridges  bump_scale 0.05 }\n"
    "%s\n";

#define SMOOTH_CUBE(material)                                                                      \
    "model { file \"tests/proof/cube.off\" shading smooth  material " material                     \
    "  scale 0.35  rotate 0 1 0 30  translate 0 0.5 0.3 }"
#define SMOOTH_BALL(material)                                                                      \
    "model { file \"tests/proof/ball.off\" shading smooth  material " material                     \
    "  scale 0.45  translate 0 0.5 0.3 }"

/*
 * Light from an image all around, and from a small sphere, seen through a thin lens that is
 * shifted, in a mirror.
 */
static const char vcm_lens[] =
    "camera { eye 0 3 0.5  look_at 0 0 0  up 0 0 -1  fov 40  aperture 0.3  focal_distance 1.5 "
    "shift 0.06 -0.04  mirror true }\n"
    "light environment { file \"scenes/textures/bricks.png\"  radiance 1.5 }\n"
    "material grey { kd 0.5 }\nmaterial ochre { kd 0.7 0.4 0.1 }\n"
    "material gloss { kd 0.3  ks 0.4  roughness 0.5 }\nmaterial black { }\n"
    "quad { corner -1.6 0 -1.3  edge1 0 0 2.4  edge2 3.2 0 0  material grey }\n"
    "sphere { centre -0.6 0.4 0  radius 0.4  material ochre }\n"
    "sphere { centre 0.5 0.5 0.2  radius 0.5  material gloss }\n"
    "sphere { centre 1.3 1.2 0  radius 0.15  material black  radiance 8 }\n";

/* A sun, and openings beside what it shows and above, one of them edge on to the light. */
static const char vcm_portals[] = "light directional { direction 0.5 -1 0.2  irradiance 2 }\n"
                                  "portal { corner -1 1.5 -1  edge1 2 0 0  edge2 0 0 2 }\n"
                                  "portal { corner 2 0 -1  edge1 0 0 2  edge2 0 2 0 }\n"
                                  "portal { corner -2 0.2 -1  edge1 1 2 0  edge2 0 0 1 }\n";

#endif
