/* texture.cl - evaluates textures at given coordinates. */
#include "entry.h"
#include "material/texture.h"

/* One texture and its texels at many points. */
kernel void colours(uint count, global const rt_texture_data *texture, global const uchar *texels,
                    global const float2 *uv, global float4 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = (float4)(texture_value(texture, texels, uv[i].x, uv[i].y), 0.0f);
}

kernel void slopes(uint count, global const rt_texture_data *texture, global const uchar *texels,
                   global const float2 *uv, global float2 *out)
{
    const uint i = item_number();
    if (i < count)
        out[i] = texture_slope(texture, texels, uv[i].x, uv[i].y);
}
