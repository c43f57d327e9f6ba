/* Data that outlives the image, and a seed, on a board under a debugger or QEMU: its files, by semihosting. See ports/host/keep.c. */
#include "cairn_port.h"

#include "semihosting.h"

#include <stdbool.h>

enum { NAME_LIMIT = 120, NAME_SIZE = NAME_LIMIT + 8 };

int32_t cairn_port_load(const char *name, uint32_t offset, void *data, uint32_t size)
{
    const int32_t file = cairn_semihosting_open(name, CAIRN_SEMIHOSTING_READ);
    if (file == -1)
        return -1;
    int32_t result = -1;
    if (cairn_semihosting_seek(file, offset) == 0) {
        const uint32_t missed = cairn_semihosting_read(file, data, size);
        result = missed > size ? -1 : (int32_t)(size - missed);
    }
    cairn_semihosting_close(file);
    return result;
}

/* The name of the file that is written first; false if it is too long. */
static bool name_fresh(char *fresh, const char *name)
{
    static const char ending[] = ".new";
    uint32_t length = 0;
    for (; name[length] != '\0'; length++) {
        if (length == NAME_LIMIT)
            return false;
        fresh[length] = name[length];
    }
    for (uint32_t i = 0; i < sizeof ending; i++)
        fresh[length + i] = ending[i];
    return true;
}

int32_t cairn_port_save(const char *name, const void *data, uint32_t size)
{
    char fresh[NAME_SIZE];
    if (!name_fresh(fresh, name))
        return -1;
    const int32_t file = cairn_semihosting_open(fresh, CAIRN_SEMIHOSTING_WRITE);
    if (file == -1)
        return -1;
    const uint32_t missed = cairn_semihosting_send(file, data, size);
    cairn_semihosting_close(file);
    return missed == 0 && cairn_semihosting_rename(fresh, name) == 0 ? 0 : -1;
}

/* Nothing on these boards differs from start to start. */
uint32_t cairn_port_seed(void)
{
    return 1;
}
