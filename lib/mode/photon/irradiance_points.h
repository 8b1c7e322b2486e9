/*
 * irradiance_points.h - points of known irradiance, for the final gather.
 *
 * Reference: Christensen: "Faster Photon Map Global Illumination", Journal of Graphics Tools 4(3),
 * 1999. The irradiance is estimated at every n-th photon once, by the k nearest, and the final
 * gather takes that of the nearest point instead of gathering k photons itself.
 */
#ifndef RT_LIB_MODE_PHOTON_IRRADIANCE_POINTS_H
#define RT_LIB_MODE_PHOTON_IRRADIANCE_POINTS_H

#include "device/device.h"
#include "photon/photon_map.h"

/*
 * Estimates, by the settings of a render, the irradiance of the photons of all lists of a map at
 * every options->irradiance_step-th of the global ones. They are appended to `out`, an empty list,
 * as photons whose flux is the irradiance, W/m^2, at 1 emitted path.
 */
rt_status rt_irradiance_points_make(rt_photon_list *out, const rt_photon_map *map,
                                    rt_device *device, const rt_render_options *options,
                                    rt_error *error);

#endif
