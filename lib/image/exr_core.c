/* exr_core.c - collects the error messages of OpenEXRCore. */
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
