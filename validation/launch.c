#include "validation/launch.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>

struct child {
    pid_t pid; /* 0: free place */
    size_t tag;
    double begun_s, limit_s;
    double ended_s; /* when SIGTERM was sent; NAN: not yet */
    bool killed;    /* SIGKILL was sent */
};

struct launcher {
    char *const *environment; /* borrowed */
    sigset_t taken, before;   /* signals that launch_wait takes; the mask as it was */
    struct sigaction child_before;
    size_t jobs;
    struct child child[]; /* child[0 .. jobs-1] */
};

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

enum status launch_create(size_t jobs, char *const *environment, struct launcher **out,
                          struct fault *fault) {
    struct launcher *l = calloc(1, sizeof *l + jobs * sizeof *l->child);
    *out = l;
    if (l == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "launcher: out of memory");
    l->jobs = jobs;
    l->environment = environment;
    sigemptyset(&l->taken);
    sigaddset(&l->taken, SIGCHLD);
    sigaddset(&l->taken, SIGINT);
    sigaddset(&l->taken, SIGTERM);
    sigaddset(&l->taken, SIGHUP);
    /* An ignored SIGCHLD, inherited from a parent, would reap children unseen. */
    struct sigaction usual = {.sa_handler = SIG_DFL};
    sigaction(SIGCHLD, &usual, &l->child_before);
    sigprocmask(SIG_BLOCK, &l->taken, &l->before);
    return STATUS_OK;
}

size_t launch_running(const struct launcher *l) {
    size_t running = 0;
    for (size_t i = 0; i < l->jobs; i++)
        running += l->child[i].pid != 0;
    return running;
}

bool launch_has_room(const struct launcher *l) {
    return launch_running(l) < l->jobs;
}

static int set_up_files(posix_spawn_file_actions_t *files, const char *log_path) {
    int error = posix_spawn_file_actions_addopen(files, 0, "/dev/null", O_RDONLY, 0);
    if (error == 0)
        error = posix_spawn_file_actions_addopen(files, 1, log_path, O_WRONLY | O_CREAT | O_TRUNC,
                                                 0644);
    return error != 0 ? error : posix_spawn_file_actions_adddup2(files, 1, 2);
}

static int set_up_signals(posix_spawnattr_t *attributes, const sigset_t *mask) {
    sigset_t usual;
    sigemptyset(&usual);
    const int number[] = {SIGCHLD, SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT};
    for (size_t i = 0; i < sizeof number / sizeof *number; i++)
        sigaddset(&usual, number[i]);
    int error = posix_spawnattr_setsigdefault(attributes, &usual);
    if (error == 0)
        error = posix_spawnattr_setsigmask(attributes, mask);
    if (error == 0)
        error = posix_spawnattr_setpgroup(attributes, 0);
    if (error == 0)
        error = posix_spawnattr_setflags(
            attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    return error;
}

static int spawn(const struct launcher *l, char *const *argv, const char *log_path, pid_t *pid) {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    int error = posix_spawn_file_actions_init(&files);
    if (error != 0)
        return error;
    error = posix_spawnattr_init(&attributes);
    if (error == 0) {
        error = set_up_files(&files, log_path);
        if (error == 0)
            error = set_up_signals(&attributes, &l->before);
        if (error == 0)
            error = posix_spawn(pid, argv[0], &files, &attributes, argv, l->environment);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&files);
    return error;
}

enum status launch_start(struct launcher *l, char *const *argv, const char *log_path,
                         double limit_s, size_t tag, struct fault *fault) {
    struct child *free_place = NULL;
    for (size_t i = 0; i < l->jobs && free_place == NULL; i++) {
        if (l->child[i].pid == 0)
            free_place = &l->child[i];
    }
    if (free_place == NULL)
        return fault_set(fault, STATUS_BAD_INPUT, "launcher: no room for another process");
    pid_t pid = 0;
    int error = spawn(l, argv, log_path, &pid);
    if (error != 0)
        return fault_set(fault, STATUS_IO, "%s (log %s): cannot be started: %s", argv[0], log_path,
                         strerror(error));
    *free_place = (struct child){
        .pid = pid, .tag = tag, .begun_s = now_s(), .limit_s = limit_s, .ended_s = NAN};
    return STATUS_OK;
}

/* Ask, and after the grace time insist. */
static void press(struct child *c, double now) {
    if (isnan(c->ended_s)) {
        c->ended_s = now;
        kill(-c->pid, SIGTERM);
    } else if (!c->killed && now - c->ended_s > LAUNCH_GRACE_S) {
        c->killed = true;
        kill(-c->pid, SIGKILL);
    }
}

/* Has it ended?  The group's remains are killed before the leader's number is
 * given back to the system, so that no stranger can be hit. */
static bool reap(struct child *c, struct launch_result *out) {
    siginfo_t about = {0};
    if (waitid(P_PID, (id_t)c->pid, &about, WEXITED | WNOHANG | WNOWAIT) != 0 || about.si_pid == 0)
        return false;
    kill(-c->pid, SIGKILL);
    int state = 0;
    while (waitpid(c->pid, &state, 0) < 0 && errno == EINTR)
        continue;
    bool exited = WIFEXITED(state);
    *out = (struct launch_result){.tag = c->tag,
                                  .end = exited ? LAUNCH_EXITED : LAUNCH_KILLED,
                                  .code = exited ? WEXITSTATUS(state) : WTERMSIG(state),
                                  .seconds = now_s() - c->begun_s};
    if (!isnan(c->ended_s))
        out->end = LAUNCH_TIMED_OUT;
    c->pid = 0;
    return true;
}

/* One that has ended, after pressing those beyond their limit. */
static bool look(struct launcher *l, struct launch_result *out) {
    double now = now_s();
    for (size_t i = 0; i < l->jobs; i++) {
        struct child *c = &l->child[i];
        if (c->pid == 0)
            continue;
        if (reap(c, out))
            return true;
        if (now - c->begun_s > c->limit_s)
            press(c, now);
    }
    return false;
}

static int wait_for_signal(const struct launcher *l, double patience_s) {
    struct timespec t = {.tv_sec = (time_t)patience_s};
    t.tv_nsec = (long)(1e9 * (patience_s - (double)t.tv_sec));
    return sigtimedwait(&l->taken, NULL, &t);
}

enum status launch_wait(struct launcher *l, double patience_s, struct launch_result *out, bool *got,
                        struct fault *fault) {
    double until = now_s() + patience_s;
    for (;;) {
        *got = look(l, out);
        double left = until - now_s();
        if (*got || left <= 0)
            return STATUS_OK;
        /* Never long: limits pass without a signal. */
        int number = wait_for_signal(l, left < 0.2 ? left : 0.2);
        if (number == SIGINT || number == SIGTERM || number == SIGHUP)
            return fault_set(fault, STATUS_INTERRUPTED, "interrupted by SIG%s",
                             sigabbrev_np(number));
    }
}

void launch_free(struct launcher *l) {
    if (l == NULL)
        return;
    while (launch_running(l) > 0) {
        struct launch_result dropped;
        for (size_t i = 0; i < l->jobs; i++) {
            if (l->child[i].pid != 0 && !reap(&l->child[i], &dropped))
                press(&l->child[i], now_s());
        }
        if (launch_running(l) > 0)
            wait_for_signal(l, 0.05);
    }
    while (wait_for_signal(l, 0) > 0)
        continue; /* a second Ctrl-C must not strike while results are put in order */
    sigaction(SIGCHLD, &l->child_before, NULL);
    sigprocmask(SIG_SETMASK, &l->before, NULL);
    free(l);
}
