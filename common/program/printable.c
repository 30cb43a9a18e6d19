#include "common/program/printable.h"

#include <stdio.h>

enum { ESCAPED = 4 }; /* characters of \xNN */

const char *printable(const char *text, size_t most, char *out, size_t out_size)
{
    size_t length = 0;

    for (size_t i = 0; i < most && text[i]; i++) {
        unsigned char c = (unsigned char)text[i];
        size_t wants = c >= ' ' && c <= '~' ? 1 : ESCAPED;
        if (length + wants >= out_size)
            break;
        if (wants == 1)
            out[length] = (char)c;
        else
            snprintf(out + length, out_size - length, "\\x%02x", c);
        length += wants;
    }
    out[length] = '\0';
    return out;
}
