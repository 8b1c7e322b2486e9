/*
 * photon_emit_media.cl - photon tracing in scenes with media that scatter, all of them homogeneous,
 * as photon_emit.cl.
 */
#include "entry.h"
#include "photon/media_light_path.h"

KERNEL photon_emit_media(const rt_params params, global const rt_scene_header *header,
                         global const rt_light_share *shares, global rt_photon *slots,
                         global rt_path_account *accounts)
{
    emit_item(&params, header, shares, slots, accounts);
}
