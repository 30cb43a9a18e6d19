#include "tools/reachctl/view/terminal.h"

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

static struct termios before;
static bool entered;
static volatile sig_atomic_t ended;

static void note(int signal_number)
{
    (void)signal_number;
    ended = 1;
}

int terminal_enter(void)
{
    struct termios now;
    struct sigaction action = {.sa_handler = note};

    if (!isatty(STDOUT_FILENO) || tcgetattr(STDIN_FILENO, &before))
        return -1;
    now = before;
    now.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    now.c_cc[VSUSP] = _POSIX_VDISABLE; /* stopped, it would leave its screen behind */
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    entered = true;
    atexit(terminal_leave);
    if (tcsetattr(STDIN_FILENO, TCSANOW, &now))
        return -1;
    fputs("\033[?1049h\033[?25l", stdout); /* the other screen, no cursor */
    return 0;
}

void terminal_leave(void)
{
    if (!entered)
        return;
    entered = false;
    fputs("\033[?25h\033[?1049l", stdout);
    fflush(stdout);
    tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

bool terminal_ended(void)
{
    return ended != 0;
}

void terminal_size(int *width, int *height)
{
    struct winsize size;

    *width = 80;
    *height = 24;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0) {
        *width = size.ws_col;
        *height = size.ws_row;
    }
}

char terminal_key(void)
{
    struct pollfd input = {STDIN_FILENO, POLLIN, 0};
    char key = 0;

    if (poll(&input, 1, 0) <= 0)
        return 0;
    if (read(STDIN_FILENO, &key, 1) <= 0)
        ended = 1; /* nobody is at the other end */
    return key;
}
