/* Largest sizes, fixed so that nothing is allocated after start. They are those of the messages. */
#ifndef REACH_DAEMON_CONFIG_SIZES_H
#define REACH_DAEMON_CONFIG_SIZES_H

#define MAX_JOINTS 16
#define MAX_OUTPUTS 8
#define MAX_TARGETS 32

#endif
