/* Room for whole pairs in the socket: two raw pictures are some 29 fragments that come at once. */
#ifndef VISION_RECEIVE_BUFFER_H
#define VISION_RECEIVE_BUFFER_H

#include <cstddef>
#include <string>

/* The URL (nullptr or "": $LCM_DEFAULT_URL, else this machine's own bus) with the size of the
 * receive buffer added, where it is UDP multicast and names none itself. */
std::string receive_buffer_url(const char *url);

/* Warns when the system does not grant a buffer that `bytes` of pictures fit in. */
void receive_buffer_check(size_t bytes);

#endif
