/* launch.h -- solver processes: several at a time, each with a log and a limit.
 *
 * Every process leads a process group of its own, with /dev/null as input and a
 * log file as output.  Beyond its limit the group gets SIGTERM, and SIGKILL
 * LAUNCH_GRACE_S later.  Whatever a process leaves behind in its group is ended
 * with it.  While a launcher exists SIGCHLD, SIGINT, SIGTERM and SIGHUP are
 * blocked and taken by launch_wait alone; children get the usual dispositions.
 */
#ifndef VALIDATION_LAUNCH_H
#define VALIDATION_LAUNCH_H

#include "common/fault.h"

#include <stdbool.h>
#include <stddef.h>

#define LAUNCH_GRACE_S 5.0

enum launch_end { LAUNCH_EXITED, LAUNCH_KILLED, LAUNCH_TIMED_OUT };

struct launch_result {
    size_t tag; /* as given to launch_start */
    enum launch_end end;
    int code;       /* exit code, or the signal's number */
    double seconds; /* wall time */
};

struct launcher; /* opaque */

/* Room for `jobs` processes at a time. `environment` is passed on to them. */
enum status launch_create(size_t jobs, char *const *environment, struct launcher **out,
                          struct fault *fault);
/* Ends what still runs (SIGTERM, grace, SIGKILL) and restores the signals; NULL is allowed. */
void launch_free(struct launcher *l);

size_t launch_running(const struct launcher *l);
bool launch_has_room(const struct launcher *l);

/* argv[0] is the path of the program.  STATUS_IO when it cannot be started. */
enum status launch_start(struct launcher *l, char *const *argv, const char *log_path,
                         double limit_s, size_t tag, struct fault *fault);

/* Wait at most patience_s for a process to end.  *got says whether one did.
 * STATUS_INTERRUPTED after SIGINT, SIGTERM or SIGHUP. */
enum status launch_wait(struct launcher *l, double patience_s, struct launch_result *out, bool *got,
                        struct fault *fault);

#endif
