/* What the library tells its host. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "fmi3.h"
#include "instance.h"

enum { MESSAGE_LENGTH = 1024 };

void axcomp_log_as_wanted(Instance *instance, bool on, unsigned categories)
{
    instance->logging = on;
    instance->categories = categories;
}

fmi2Status axcomp_say(const Instance *instance, fmi2Status status, const char *format, ...)
{
    int category = status == fmi2OK ? CATEGORY_ALL : status == fmi2Warning ? CATEGORY_WARNING : CATEGORY_ERROR;
    bool wanted = instance->logging && (instance->categories >> category & 1u) != 0;
    bool heard = instance->callbacks.logger != NULL || instance->log != NULL;
    if (!heard || (!wanted && category != CATEGORY_ERROR)) {
        return status;
    }
    char message[MESSAGE_LENGTH] = "";
    char doubled[2 * MESSAGE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (instance->log != NULL) {
        if (memcmp(message, "fmi2", 4) == 0) {
            message[3] = '3';
        }
        ((fmi3LogMessageCallback)instance->log)(instance->callbacks.componentEnvironment, (fmi3Status)status,
                                                axcomp_log_categories[category], message);
        return status;
    }
    /* The host takes the message for a format. */
    size_t length = 0;
    for (const char *from = message; *from != 0; from++) {
        if (*from == '%') {
            doubled[length++] = '%';
        }
        doubled[length++] = *from;
    }
    doubled[length] = 0;
    instance->callbacks.logger(instance->callbacks.componentEnvironment, instance->name, status,
                               axcomp_log_categories[category], doubled);
    return status;
}
