#include "vision/answers/answers.h"

static const size_t stride = 61;

/* FNV-1a over a part of the bytes. */
static uint64_t mix(uint64_t hash, const encoded_image &image)
{
    for (size_t i = 0; i < image.size; i += stride)
        hash = (hash ^ image.data[i]) * 0x100000001b3ULL;
    return (hash ^ image.size) * 0x100000001b3ULL;
}

uint64_t answers_content_of(const encoded_image &image)
{
    return mix(0xcbf29ce484222325ULL, image);
}

uint64_t answers_content(const image_message &pair)
{
    return mix(mix(0xcbf29ce484222325ULL, pair.left), pair.right);
}

const reach_marker_t *answers_find(const answers &known, int64_t utime, uint64_t content)
{
    for (const auto &answer : known.kept)
        if (answer.marker.utime == utime && answer.content == content)
            return &answer.marker;
    return nullptr;
}

void answers_keep(answers *known, uint64_t content, const reach_marker_t &marker)
{
    known->kept[known->next].content = content;
    known->kept[known->next].marker = marker;
    known->next = (known->next + 1) % ANSWERS_KEPT;
}
