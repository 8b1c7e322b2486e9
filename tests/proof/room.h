/*
 * room.h - a closed room: coloured walls, an area light in the ceiling, a diffuse, a glossy and a
 * mirror ball.
 */
#ifndef RT_TESTS_PROOF_ROOM_H
#define RT_TESTS_PROOF_ROOM_H

#define ROOM                                                                                       \
    "camera { eye 0 1 -0.95  look_at 0 0.9 0  fov 75 }\n"                                          \
    "material white { kd 0.7 }\nmaterial red { kd 0.7 0.2 0.1 }\nmaterial green { kd 0.1 0.6 0.2 " \
    "}\n"                                                                                          \
    "material emitter { emission 3 }\nmaterial mirror { ks 0.9 }\nmaterial gloss { kd 0.2  ks "    \
    "0.5  "                                                                                        \
    "roughness 0.3 }\n"                                                                            \
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"                          \
    "quad { corner -1 2 -1  edge1 2 0 0  edge2 0 0 2  material white }\n"                          \
    "quad { corner -1 0 1  edge1 0 2 0  edge2 2 0 0  material white }\n"                           \
    "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 2 0  material white }\n"                          \
    "quad { corner -1 0 -1  edge1 0 2 0  edge2 0 0 2  material red }\n"                            \
    "quad { corner 1 0 -1  edge1 0 0 2  edge2 0 2 0  material green }\n"                           \
    "quad { corner -0.5 1.95 -0.5  edge1 1 0 0  edge2 0 0 1  material emitter }\n"                 \
    "sphere { centre -0.5 0.3 0.4  radius 0.3  material mirror }\n"                                \
    "sphere { centre 0.5 0.3 0.5  radius 0.3  material gloss }\n"                                  \
    "sphere { centre 0 0.2 -0.1  radius 0.2  material white }\n"

#endif
