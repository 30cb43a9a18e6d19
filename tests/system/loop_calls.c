/* Preloaded into reachd: notes what the loop thread calls in the C library that it must not, from
 * the moment on at which it has named itself. The notes are written at the end, one name a line, to
 * the file that REACH_LOOP_CALLS names; a first line says that the thread was seen. */
#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

enum { MOST = 64 };

static __thread bool in_loop;
static bool seen;
static const char *called[MOST]; /* the loop thread alone writes, the end reads */
static int n_called;

static void note(const char *name)
{
    if (in_loop && n_called < MOST)
        called[n_called++] = name;
}

static void *next(const char *name)
{
    return dlsym(RTLD_NEXT, name);
}

/* `name` as in the library, with a note. */
#define INTERCEPT(result, name, parameters, arguments)                                             \
    result name parameters;                                                                        \
    result name parameters                                                                         \
    {                                                                                              \
        static result(*real) parameters;                                                           \
        if (!real)                                                                                 \
            *(void **)&real = next(#name);                                                         \
        note(#name);                                                                               \
        return real arguments;                                                                     \
    }

#pragma GCC diagnostic ignored "-Wpedantic"
INTERCEPT(void *, malloc, (size_t size), (size))
INTERCEPT(void *, realloc, (void *old, size_t size), (old, size))
INTERCEPT(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
INTERCEPT(int, posix_memalign, (void **block, size_t alignment, size_t size),
          (block, alignment, size))
INTERCEPT(int, pthread_mutex_lock, (pthread_mutex_t * mutex), (mutex))
INTERCEPT(int, pthread_rwlock_rdlock, (pthread_rwlock_t * lock), (lock))
INTERCEPT(int, pthread_rwlock_wrlock, (pthread_rwlock_t * lock), (lock))
INTERCEPT(int, pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t *mutex),
          (condition, mutex))
INTERCEPT(int, close, (int file), (file))
INTERCEPT(int, fsync, (int file), (file))
INTERCEPT(ssize_t, read, (int file, void *bytes, size_t size), (file, bytes, size))
INTERCEPT(ssize_t, write, (int file, const void *bytes, size_t size), (file, bytes, size))
INTERCEPT(ssize_t, send, (int file, const void *bytes, size_t size, int flags),
          (file, bytes, size, flags))
INTERCEPT(ssize_t, sendto,
          (int file, const void *bytes, size_t size, int flags, const struct sockaddr *to,
           socklen_t to_size),
          (file, bytes, size, flags, to, to_size))
INTERCEPT(ssize_t, sendmsg, (int file, const struct msghdr *message, int flags),
          (file, message, flags))
INTERCEPT(FILE *, fopen, (const char *path, const char *mode), (path, mode))
INTERCEPT(int, fflush, (FILE * file), (file))
INTERCEPT(int, vfprintf, (FILE * file, const char *format, va_list arguments),
          (file, format, arguments))
INTERCEPT(int, open, (const char *path, int flags, mode_t mode), (path, flags, mode))

/* dlsym itself allocates by calloc, so that this one cannot be looked up by it; glibc's own name.
 */
void *__libc_calloc(size_t n, size_t size);
void *calloc(size_t n, size_t size)
{
    note("calloc");
    return __libc_calloc(n, size);
}

void __libc_free(void *block);
void free(void *block)
{
    if (block)
        note("free");
    __libc_free(block);
}

int pthread_setname_np(pthread_t thread, const char *name)
{
    static int (*real)(pthread_t, const char *);

    if (!real)
        *(void **)&real = next("pthread_setname_np");
    if (strcmp(name, "reachd-loop") == 0)
        in_loop = seen = true;
    return real(thread, name);
}

__attribute__((destructor)) static void write_notes(void)
{
    const char *path = getenv("REACH_LOOP_CALLS");
    FILE *file = path ? fopen(path, "w") : NULL;

    if (!file)
        return;
    fprintf(file, "%s\n", seen ? "seen" : "no loop thread");
    for (int i = 0; i < n_called; i++)
        fprintf(file, "%s\n", called[i]);
    fclose(file);
}
