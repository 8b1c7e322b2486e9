/* exr_core.c - collects the error messages of OpenEXRCore, and matches channels. */
#include "image/exr_core.h"

#include <stdio.h>

void rt_exr_on_error(exr_const_context_t context, exr_result_t code, const char *text)
{
    void *user = NULL;
    (void)code;
    if (!context || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || !user)
        return;
    rt_exr_message *message = user;
    if (message->text[0] == '\0')
        snprintf(message->text, sizeof message->text, "%s", text);
}

const char *rt_exr_reason(const rt_exr_message *message, exr_result_t code)
{
    return message->text[0] ? message->text : exr_get_default_error_message(code);
}

uint32_t rt_exr_lay_out(exr_coding_channel_info_t *channel, const rt_image *image)
{
    channel->user_data_type = EXR_PIXEL_FLOAT;
    channel->user_bytes_per_element = sizeof(float);
    channel->user_pixel_stride = (int32_t)(image->channel_count * sizeof(float));
    channel->user_line_stride = (int32_t)(image->width * image->channel_count * sizeof(float));
    return rt_image_channel(image, channel->channel_name);
}
