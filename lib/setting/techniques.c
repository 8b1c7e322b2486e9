/* techniques.c - the words of `techniques` and `contribution` as sets of RT_TECHNIQUE_*. */
#include "setting/techniques.h"

rt_u32 rt_vcm_techniques(rt_techniques techniques)
{
    const rt_u32 path = RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_NEE;
    switch (techniques) {
    case RT_TECHNIQUES_VCM:
        return path | RT_TECHNIQUE_CAMERA | RT_TECHNIQUE_CONNECTION | RT_TECHNIQUE_MERGING;
    case RT_TECHNIQUES_BPM:
        return RT_TECHNIQUE_EMISSION | RT_TECHNIQUE_MERGING;
    case RT_TECHNIQUES_BPT:
        return path | RT_TECHNIQUE_CAMERA | RT_TECHNIQUE_CONNECTION;
    case RT_TECHNIQUES_PT:
        return path;
    case RT_TECHNIQUES_EMISSION:
        return RT_TECHNIQUE_EMISSION;
    case RT_TECHNIQUES_NEE:
        return RT_TECHNIQUE_NEE;
    case RT_TECHNIQUES_CAMERA:
        return RT_TECHNIQUE_CAMERA;
    case RT_TECHNIQUES_CONNECTION:
        return RT_TECHNIQUE_CONNECTION;
    case RT_TECHNIQUES_MERGING:
        return RT_TECHNIQUE_MERGING;
    }
    return 0;
}

rt_u32 rt_vcm_shown(const rt_render_options *options)
{
    return rt_vcm_techniques(options->techniques) & rt_vcm_techniques(options->contribution);
}

int rt_vcm_merges(const rt_render_options *options)
{
    return options->mode == RT_MODE_VCM && (rt_vcm_shown(options) & RT_TECHNIQUE_MERGING) != 0;
}
