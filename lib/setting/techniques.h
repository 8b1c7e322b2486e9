/* techniques.h - the techniques of mode vcm that its settings name. */
#ifndef RT_LIB_SETTING_TECHNIQUES_H
#define RT_LIB_SETTING_TECHNIQUES_H

#include "rt.h"
#include "types.h"

/* The RT_TECHNIQUE_* of a setting. */
rt_u32 rt_vcm_techniques(rt_techniques techniques);

/* Those of `techniques` whose light is added: the ones that `contribution` has, too. */
rt_u32 rt_vcm_shown(const rt_render_options *options);

/* Whether the picture holds light of merging, which has a bias. */
int rt_vcm_merges(const rt_render_options *options);

#endif
