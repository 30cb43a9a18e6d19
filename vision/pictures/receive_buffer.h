/* Room for whole pairs in the socket: two raw pictures are some 29 fragments that come at once. */
#ifndef VISION_PICTURES_RECEIVE_BUFFER_H
#define VISION_PICTURES_RECEIVE_BUFFER_H

#include <cstddef>

/* Warns when the system does not grant a buffer that `bytes` of pictures fit in. */
void receive_buffer_check(size_t bytes);

#endif
