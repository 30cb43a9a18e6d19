/* Runs reach-vision itself and keeps what it says. */
#ifndef TEST_PROGRAM_H
#define TEST_PROGRAM_H

#include <string>
#include <vector>

struct program_end {
    int code;            /* of its exit; -1: it was killed */
    std::string printed; /* standard output */
    std::string logged;  /* standard error */
};

/* Runs $REACH_BUILD_DIR/bin/reach-vision with these words, and with "NAME=VALUE" in its
 * environment. What it prints goes through two files in the present folder. */
program_end program_run(const std::vector<std::string> &words,
                        const std::vector<std::string> &environment);

#endif
