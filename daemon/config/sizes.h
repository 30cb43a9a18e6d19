/* Largest sizes, fixed so that nothing is allocated after start. */
#ifndef REACH_DAEMON_CONFIG_SIZES_H
#define REACH_DAEMON_CONFIG_SIZES_H

/* Those of the messages. */
#define MAX_JOINTS 16
#define MAX_OUTPUTS 8
#define MAX_TARGETS 32

/* Periods whose commands the safety gate remembers; safety.latency must be far shorter. */
#define SAFETY_RECENT 64

/* The least that safety.loop_stall may be, in periods: the watchdog looks once a period, and a look
 * that is late by half of the standstill cannot know who is to blame (realtime/stall.h). */
#define STALL_LEAST_PERIODS 3

#endif
