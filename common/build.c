/* build.c -- see build.h.  BUILD_VERSION and BUILD_FLAGS come from the command
 * line, BUILD_COMMIT and BUILD_DIRTY from build_facts.h, written at every build. */
#include "common/build.h"

#include "build_facts.h"
#include "common/digest.h"

#include <gnu/libc-version.h>
#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <yaml.h>

const char *build_version(void) {
    return BUILD_VERSION;
}

const char *build_commit(void) {
    return BUILD_COMMIT;
}

const char *build_dirty(void) {
    return BUILD_DIRTY;
}

#define TEXT_OF(x) #x
#define TEXT(x)    TEXT_OF(x)

const char *build_compiler(void) {
#ifdef __clang__
    return "clang " TEXT(__clang_major__) "." TEXT(__clang_minor__) "." TEXT(__clang_patchlevel__);
#else
    return "gcc " TEXT(__GNUC__) "." TEXT(__GNUC_MINOR__) "." TEXT(__GNUC_PATCHLEVEL__);
#endif
}

const char *build_flags(void) {
    return BUILD_FLAGS;
}

char *build_line(const char *program) {
    char *line;
    int length = asprintf(&line, "%s %s (commit %s, %s, %s)", program, build_version(),
                          build_commit(), build_dirty(), build_compiler());
    return length < 0 ? NULL : line;
}

/* The processor's name as Linux tells it, or "unknown". */
static void cpu_model(char *out, size_t size) {
    snprintf(out, size, "unknown");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (file == NULL)
        return;
    char line[512];
    while (fgets(line, sizeof line, file) != NULL) {
        char *value = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || value == NULL)
            continue;
        value += 1 + strspn(value + 1, " \t");
        value[strcspn(value, "\n")] = '\0';
        snprintf(out, size, "%s", value);
        break;
    }
    fclose(file);
}

/* "glibc 2.36 1a2b3c4d": the library picks its code by the processor, and the digits are a
 * digest of what some thousand arguments give, for another choice gives other last bits. */
static void library(char *out, size_t size) {
    enum { ARGUMENTS = 2048, FUNCTIONS = 6 };
    double value[ARGUMENTS * FUNCTIONS];
    struct digest d;
    for (size_t i = 0; i < ARGUMENTS; i++) {
        double x = 1.37e-3 + 7.919e-3 * (double)i;
        double *at = &value[i * FUNCTIONS];
        at[0] = exp(x);
        at[1] = log(x);
        at[2] = sin(x);
        at[3] = cos(x);
        at[4] = pow(x, 1.7);
        at[5] = atan2(x, 3.1);
    }
    digest_bytes(value, sizeof value, &d);
    snprintf(out, size, "glibc %s %.8s", gnu_get_libc_version(), d.hex);
}

void build_describe(struct json *j) {
    char text[256];
    json_put_text(j, "version", build_version());
    json_put_text(j, "commit", build_commit());
    json_put_text(j, "dirty", build_dirty());
    json_put_text(j, "compiler", build_compiler());
    json_put_text(j, "flags", build_flags());
    json_put_text(j, "gsl", gsl_version);
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
    snprintf(text, sizeof text, "%u.%u.%u", major, minor, release);
    json_put_text(j, "hdf5", text);
    json_put_text(j, "libyaml", yaml_get_version_string());
    struct utsname machine;
    json_put_text(j, "machine", uname(&machine) == 0 ? machine.machine : "unknown");
    library(text, sizeof text);
    json_put_text(j, "libc", text);
    cpu_model(text, sizeof text);
    json_put_text(j, "cpu", text);
    if (gethostname(text, sizeof text) != 0)
        snprintf(text, sizeof text, "unknown");
    text[sizeof text - 1] = '\0';
    json_put_text(j, "host", text);
}
