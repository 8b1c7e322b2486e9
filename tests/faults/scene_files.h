/*
 * scene_files.h - files that scenes of the tests of faults read: a.png, a.exr, a.pfm and a.ppm,
 * a.obj, a.ply, a.off and a.stl, and materials.rts.
 */
#ifndef RT_TESTS_SCENE_FILES_H
#define RT_TESTS_SCENE_FILES_H

/* cmocka's setup: enters a scratch directory and writes them there. scratch_leave ends that. */
int scene_files_enter(void **state);

/* A scene that reads all of them but the materials. */
#define SCENE_OF_FILES                                                                             \
    "texture a { file \"a.png\" }\ntexture b { file \"a.exr\" }\n"                                 \
    "texture c { file \"a.pfm\" }\ntexture d { file \"a.ppm\" }\n"                                 \
    "material a { kd_texture a }\nmaterial b { kd_texture b }\n"                                   \
    "material c { kd_texture c }\nmaterial d { kd_texture d }\n"                                   \
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45 }\n"                                           \
    "light environment { file \"a.exr\" }\n"                                                       \
    "model { file \"a.ply\"  material a }\nmodel { file \"a.off\"  material b }\n"                 \
    "model { file \"a.stl\"  material c }\nmodel { file \"a.obj\"  material d }\n"

#endif
