#include "program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

static const char printed[] = "test_vision_printed.txt";
static const char logged[] = "test_vision_logged.txt";

static std::string take_file(const char *path)
{
    std::ifstream in(path);
    std::stringstream text;

    text << in.rdbuf();
    unlink(path);
    return text.str();
}

[[noreturn]] static void become(const std::vector<std::string> &words,
                                const std::vector<std::string> &environment)
{
    const char *build = std::getenv("REACH_BUILD_DIR");
    const std::string program = std::string(build ? build : "build") + "/bin/reach-vision";
    std::vector<char *> argv = {const_cast<char *>(program.c_str())};

    for (const std::string &word : words)
        argv.push_back(const_cast<char *>(word.c_str()));
    argv.push_back(nullptr);
    for (const std::string &one : environment)
        putenv(const_cast<char *>(one.c_str()));
    if (dup2(open(printed, O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO) >= 0 &&
        dup2(open(logged, O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO) >= 0)
        execv(program.c_str(), argv.data());
    _exit(127);
}

program_end program_run(const std::vector<std::string> &words,
                        const std::vector<std::string> &environment)
{
    const pid_t child = fork();
    int status = 0;

    if (child == 0)
        become(words, environment);
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, take_file(printed), take_file(logged)};
}
