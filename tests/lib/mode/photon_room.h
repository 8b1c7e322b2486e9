/*
 * photon_room.h - a room that photon mode renders, and what its scenes are made of. Any failure
 * fails the test.
 */
#ifndef RT_TESTS_LIB_MODE_PHOTON_ROOM_H
#define RT_TESTS_LIB_MODE_PHOTON_ROOM_H

#include "rt.h"

enum { side = 48 }; /* of the films */

/* A material of these parts, glass that refracts when kt is above 0; returns its index. */
uint32_t room_material(rt_scene *scene, float kd, float ks, float kt);

/* The quad at corner c with edges a and b. */
void room_quad(rt_scene *scene, uint32_t material, float radiance, const float c[3],
               const float a[3], const float b[3]);

/*
 * A room of half-white walls, open to the camera, with a mirror and a glass sphere under an area
 * light.
 */
rt_renderer *room_renderer(rt_device *device);

rt_render_options room_options(void);

rt_film *room_render(rt_renderer *renderer, const rt_render_options *options);

#endif
