/* What every program tells as its version: the project's number and git revision. */
#ifndef REACH_COMMON_PROGRAM_VERSION_H
#define REACH_COMMON_PROGRAM_VERSION_H

#ifdef __cplusplus
extern "C" {
#endif

extern const char reach_version[]; /* "0.1.0 (c17bd48)" */

#ifdef __cplusplus
}
#endif
#endif
