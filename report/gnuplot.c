/* gnuplot.c -- see gnuplot.h. */
#include "report/gnuplot.h"

#include "report/escape.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/pidfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { FILE_IN, FILE_OUT, FILE_ERROR, FILE_COUNT };

enum status gnuplot_check_text(const char *text, const char *what, struct fault *fault) {
    if (!text || escape_is_plain(text))
        return STATUS_OK;
    return fault_set(fault, STATUS_BAD_INPUT,
                     "%s: control characters or bytes that are not UTF-8 cannot be drawn", what);
}

void gnuplot_put_text(FILE *script, const char *text) {
    fputc('\'', script);
    for (const char *s = text ? text : ""; *s; s++) {
        if (*s == '\'')
            fputc('\'', script);
        fputc(*s, script);
    }
    fputc('\'', script);
}

static enum status system_fault(const char *doing, int error, struct fault *fault) {
    return fault_set(fault, STATUS_IO, "gnuplot: %s: %s", doing, strerror(error));
}

static enum status write_all(int file, const char *text, size_t length, struct fault *fault) {
    while (length > 0) {
        ssize_t written = write(file, text, length);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return system_fault("writing the script", errno, fault);
        text += written;
        length -= (size_t)written;
    }
    return STATUS_OK;
}

static enum status read_all(int file, char **out, size_t *length, struct fault *fault) {
    struct stat info;
    if (fstat(file, &info) != 0)
        return system_fault("reading its output", errno, fault);
    char *text = malloc((size_t)info.st_size + 1);
    if (!text)
        return fault_set(fault, STATUS_NO_MEMORY, "gnuplot: out of memory");
    size_t have = 0;
    ssize_t got;
    while (have < (size_t)info.st_size &&
           (got = pread(file, text + have, (size_t)info.st_size - have, (off_t)have)) > 0)
        have += (size_t)got;
    text[have] = '\0';
    *out = text;
    *length = have;
    return STATUS_OK;
}

static bool begins(const char *text, const char *start) {
    return strncmp(text, start, strlen(start)) == 0;
}

/* This process's environment, but with the locale fixed and without what changes gnuplot's
 * defaults: the same report must come out on every account. */
static char **child_environment(char *locale) {
    size_t count = 0, kept = 0;
    while (environ && environ[count])
        count++;
    char **list = calloc(count + 2, sizeof *list);
    if (!list)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        if (!begins(environ[i], "LC_ALL=") && !begins(environ[i], "GNUPLOT") &&
            !begins(environ[i], "GNUTERM=") && !begins(environ[i], "GDFONTPATH="))
            list[kept++] = environ[i];
    }
    list[kept] = locale;
    return list;
}

static enum status start(const int *files, pid_t *pid, struct fault *fault) {
    char program[] = "gnuplot", no_startup[] = "-d", standard_input[] = "-";
    char locale[] = "LC_ALL=C.UTF-8";
    char *const arguments[] = {program, no_startup, standard_input, NULL};
    char **environment = child_environment(locale);
    if (!environment)
        return fault_set(fault, STATUS_NO_MEMORY, "gnuplot: out of memory");
    posix_spawn_file_actions_t actions;
    int error = posix_spawn_file_actions_init(&actions);
    if (error == 0) {
        for (int i = 0; i < FILE_COUNT && error == 0; i++)
            error = posix_spawn_file_actions_adddup2(&actions, files[i], i);
        if (error == 0)
            error = posix_spawnp(pid, program, &actions, NULL, arguments, environment);
        posix_spawn_file_actions_destroy(&actions);
    }
    free(environment);
    if (error == ENOENT)
        return fault_set(fault, STATUS_NOT_FOUND,
                         "gnuplot is not installed or not on PATH, and the report's figures need "
                         "it: run ci/setup (Debian package gnuplot-nox)");
    return error ? system_fault("cannot be started", error, fault) : STATUS_OK;
}

/* Wait for the end; beyond the limit the child is killed. */
static enum status finish(pid_t pid, int *state, struct fault *fault) {
    int ready = 1, child = pidfd_open(pid, 0);
    if (child >= 0) {
        struct pollfd end = {.fd = child, .events = POLLIN};
        do
            ready = poll(&end, 1, GNUPLOT_LIMIT_S * 1000);
        while (ready < 0 && errno == EINTR);
        close(child);
    }
    if (ready == 0)
        kill(pid, SIGKILL);
    while (waitpid(pid, state, 0) < 0) {
        if (errno != EINTR)
            return system_fault("waiting for it", errno, fault);
    }
    if (ready == 0)
        return fault_set(fault, STATUS_IO, "gnuplot: no picture within %d s", GNUPLOT_LIMIT_S);
    return STATUS_OK;
}

/* What it printed on its standard error is the best there is to say. */
static enum status judge(int state, int error_file, struct fault *fault) {
    char *words = NULL;
    size_t length;
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0)
        return STATUS_OK;
    if (read_all(error_file, &words, &length, fault))
        return fault->status;
    if (WIFSIGNALED(state))
        fault_set(fault, STATUS_IO, "gnuplot: ended by signal %d: %.2000s", WTERMSIG(state), words);
    else
        fault_set(fault, STATUS_IO, "gnuplot: exit code %d: %.2000s", WEXITSTATUS(state), words);
    free(words);
    return STATUS_IO;
}

enum status gnuplot_run(const struct sheet *script, char **out, size_t *length,
                        struct fault *fault) {
    int files[FILE_COUNT] = {-1, -1, -1}, state = 0;
    pid_t pid;
    enum status status = STATUS_OK;
    *out = NULL;
    *length = 0;
    for (int i = 0; i < FILE_COUNT; i++) {
        files[i] = memfd_create("bedcheck-gnuplot", MFD_CLOEXEC);
        if (files[i] < 0) {
            status = system_fault("no file in memory", errno, fault);
            goto done;
        }
    }
    if ((status = write_all(files[FILE_IN], script->text, script->length, fault)))
        goto done;
    if (lseek(files[FILE_IN], 0, SEEK_SET) != 0) {
        status = system_fault("rewinding the script", errno, fault);
        goto done;
    }
    if ((status = start(files, &pid, fault)) || (status = finish(pid, &state, fault)) ||
        (status = judge(state, files[FILE_ERROR], fault)))
        goto done;
    status = read_all(files[FILE_OUT], out, length, fault);
    if (!status && *length == 0) {
        free(*out);
        *out = NULL;
        status = fault_set(fault, STATUS_IO, "gnuplot: it drew nothing");
    }
done:
    for (int i = 0; i < FILE_COUNT; i++) {
        if (files[i] >= 0)
            close(files[i]);
    }
    return status;
}
