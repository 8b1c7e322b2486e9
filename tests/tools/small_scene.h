/*
 * small_scene.h - a scene for tests of rtc: a diffuse and a glass ball under a square area
 * light; every option can matter.
 */
#ifndef RT_TESTS_SMALL_SCENE_H
#define RT_TESTS_SMALL_SCENE_H

static const char small_scene[] =
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"
    "film { width 24  height 16 }\n"
    "material white { kd 0.7 }\n"
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material white }\n"
    "quad { corner -4 0 3  edge1 0 6 0  edge2 8 0 0  material white }\n"
    "sphere { centre -1 1 0  radius 1  material white }\n"
    "sphere { centre 1 1 0  radius 0.9  material glass }\n"
    "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material white  radiance 8 }\n";

#endif
