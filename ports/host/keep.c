/* Data that outlives the image: files. A new one is written beside the old one and then takes its name, so that one of them is whole. */
#include "cairn_port.h"

#include <stdio.h>

enum { NAME_SIZE = 128 };

int32_t cairn_port_load(const char *name, uint32_t offset, void *data, uint32_t size)
{
    FILE *file = fopen(name, "rb");
    if (file == NULL)
        return -1;
    int32_t result = -1;
    if (fseek(file, (long)offset, SEEK_SET) == 0) {
        const size_t count = fread(data, 1, size, file);
        result = ferror(file) != 0 ? -1 : (int32_t)count;
    }
    (void)fclose(file);
    return result;
}

int32_t cairn_port_save(const char *name, const void *data, uint32_t size)
{
    char fresh[NAME_SIZE];
    const int length = snprintf(fresh, sizeof fresh, "%s.new", name);
    if (length < 0 || length >= NAME_SIZE)
        return -1;
    FILE *file = fopen(fresh, "wb");
    if (file == NULL)
        return -1;
    const size_t count = fwrite(data, 1, size, file);
    if (fclose(file) != 0 || count != size)
        return -1;
    return rename(fresh, name) == 0 ? 0 : -1;
}
