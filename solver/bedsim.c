/* bedsim.c -- one run file, one seed, one result file.
 *
 *     bedsim run RUN.yaml --seed N --out FILE.h5 [--set name=value]... [--quiet]
 *     bedsim models | params MODEL | datasets MODEL
 *     bedsim xdmf FILE.h5
 *
 * Exit codes: 0 done, 1 numerical fault, 2 input refused, 130 interrupted.  The
 * result appears whole or not at all (docs/contract.md).
 */
#include "common/build.h"
#include "common/file.h"
#include "common/schema.h"
#include "solver/result.h"
#include "solver/xdmf.h"

#include <argp.h>
#include <errno.h>
#include <libgen.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { MAX_SETTINGS = 64 };
static const double ROOM_BYTES = 16e6;

static volatile sig_atomic_t interrupted;

static void on_signal(int number) {
    (void)number;
    interrupted = 1;
}

struct options {
    const char *run_path, *out_path;
    const char *setting[MAX_SETTINGS]; /* setting[0 .. settings-1]: "name=value" */
    size_t settings;
    uint64_t seed;
    bool seed_given, quiet;
};

/* One run from start to end: what run() makes and frees. */
struct job {
    struct options options;
    struct runfile run;
    const struct model *model;
    struct parameter_set parameters;
    struct h5_reader *start;
    struct h5_writer *writer;
    void *state;
    struct timespec began;
    double last_shown;
    bool shows_progress;
};

static double seconds_since(const struct timespec *t) {
    struct timespec n;
    clock_gettime(CLOCK_MONOTONIC, &n);
    return (double)(n.tv_sec - t->tv_sec) + 1e-9 * (double)(n.tv_nsec - t->tv_nsec);
}

/* -- reading the input ------------------------------------------------------- */

static enum status find_model(struct job *job, struct fault *fault) {
    const char *names[16];
    size_t count;
    const struct model *const *all = models_all(&count);
    for (size_t i = 0; i < count; i++)
        names[i] = all[i]->name;
    job->model = models_find(job->run.model);
    if (job->model)
        return STATUS_OK;
    const char *near = schema_nearest(job->run.model, names, count);
    return fault_set(fault, STATUS_NOT_FOUND, "%s: model: '%s' is unknown%s%s%s",
                     job->options.run_path, job->run.model, near ? "; did you mean '" : "",
                     near ? near : "", near ? "'?" : " (see: bedsim models)");
}

static enum status check_output(const struct options *o, struct fault *fault) {
    char *copy = strdup(o->out_path);
    if (!copy)
        return fault_set(fault, STATUS_NO_MEMORY, "no memory");
    const char *folder = dirname(copy);
    if (!file_exists(folder))
        fault_set(fault, STATUS_IO, "--out %s: there is no folder %s", o->out_path, folder);
    else if (file_check_room(folder, ROOM_BYTES, fault) != STATUS_OK)
        fault_within(fault, "--out %s", o->out_path);
    free(copy);
    return fault->status;
}

/* Of a case's swept parameters: those that no --set has given. */
static void say_what_was_taken(const struct job *job) {
    const struct options *o = &job->options;
    for (const char *line = job->run.notice; *line != '\0';) {
        size_t length = strcspn(line, "\n"), name = strcspn(line, " ");
        bool set = false;
        for (size_t i = 0; i < o->settings; i++)
            set = set || (strncmp(o->setting[i], line, name) == 0 && o->setting[i][name] == '=');
        if (!set)
            fprintf(stderr, "bedsim: a case, not a run file: %.*s\n", (int)length, line);
        line += length + (line[length] == '\n');
    }
}

static enum status prepare(struct job *job, struct fault *fault) {
    struct options *o = &job->options;
    if (runfile_load(o->run_path, &job->run, fault) || find_model(job, fault) ||
        result_check_datasets(job->model, &job->run, o->run_path, fault) ||
        parameters_read(job->model, job->run.parameters, o->setting, o->settings, &job->parameters,
                        fault) ||
        check_output(o, fault))
        return fault->status;
    if (job->run.notice && !o->quiet)
        say_what_was_taken(job);
    if (job->run.start_file && h5_open(job->run.start_file, &job->start, fault) != STATUS_OK)
        return fault->status;
    if (job->model->create(&job->state, &job->parameters, job->start, o->seed, fault))
        return fault->status;
    const char *notice = job->model->notice(job->state);
    if (notice && !o->quiet)
        fprintf(stderr, "bedsim: %s\n", notice);
    return STATUS_OK;
}

/* -- running ------------------------------------------------------------------- */

static void show_progress(struct job *job, double end) {
    double elapsed = seconds_since(&job->began);
    if (!job->shows_progress || elapsed - job->last_shown < 0.5)
        return;
    job->last_shown = elapsed;
    double time = job->model->time(job->state);
    double left = time > 0 ? elapsed * (end / time - 1) : 0;
    fprintf(stderr, "\r%s %5.1f %%  t = %.2f of %g %s  %d:%02d left ", job->model->name,
            end > 0 ? 100 * time / end : 100, time, end, job->model->time_unit, (int)left / 60,
            (int)left % 60);
}

static enum status step_to(struct job *job, double time, double end, struct fault *fault) {
    if (job->model->aim)
        job->model->aim(job->state, time);
    while (!job->model->reached(job->state, time)) {
        if (interrupted)
            return fault_set(fault, STATUS_INTERRUPTED, "interrupted at t = %g %s",
                             job->model->time(job->state), job->model->time_unit);
        if (job->model->step(job->state, fault) != STATUS_OK)
            return fault->status;
        show_progress(job, end);
    }
    return STATUS_OK;
}

/* Both lists of sample times merged: step to the next, write what is due. */
static enum status run_samples(struct job *job, struct fault *fault) {
    const struct runfile *r = &job->run;
    size_t next = 0, next_particles = 0;
    double end = 0;
    if (r->sample_count > 0)
        end = r->samples[r->sample_count - 1];
    if (r->particle_sample_count > 0 && r->particle_samples[r->particle_sample_count - 1] > end)
        end = r->particle_samples[r->particle_sample_count - 1];
    while (next < r->sample_count || next_particles < r->particle_sample_count) {
        double a = next < r->sample_count ? r->samples[next] : end + 1;
        double b = next_particles < r->particle_sample_count ? r->particle_samples[next_particles]
                                                             : end + 1;
        if (step_to(job, a < b ? a : b, end, fault) != STATUS_OK)
            return fault->status;
        if (next_particles == 0 && b <= a &&
            result_sample(job->writer, job->model, job->state, r, DATASET_ONCE, fault))
            return fault->status;
        if (b <= a &&
            result_sample(job->writer, job->model, job->state, r, DATASET_PARTICLES, fault))
            return fault->status;
        if (a <= b && result_sample(job->writer, job->model, job->state, r, DATASET_SAMPLES, fault))
            return fault->status;
        next += a <= b;
        next_particles += b <= a;
    }
    return STATUS_OK;
}

static enum status write_record(const struct job *job, struct fault *fault) {
    char *path = result_record_path(job->options.out_path), *text = NULL, started[32];
    size_t length = 0;
    FILE *memory = open_memstream(&text, &length);
    if (!path || !memory) {
        if (memory)
            fclose(memory);
        free(path);
        return fault_set(fault, STATUS_NO_MEMORY, "no memory for the run's record");
    }
    time_t at = time(NULL) - (time_t)seconds_since(&job->began);
    struct tm calendar;
    strftime(started, sizeof started, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&at, &calendar));
    struct json j = json_to(memory);
    json_begin_object(&j);
    json_key(&j, "format");
    json_text(&j, "bedsim-record 1");
    json_key(&j, "started");
    json_text(&j, started);
    json_key(&j, "wall_s");
    json_real(&j, seconds_since(&job->began));
    json_key(&j, "cpu_s");
    json_real(&j, (double)clock() / CLOCKS_PER_SEC);
    json_key(&j, "build");
    json_begin_object(&j);
    build_describe(&j);
    json_end_object(&j);
    json_key(&j, "cost");
    json_begin_object(&j);
    job->model->report_cost(job->state, &j);
    json_end_object(&j);
    json_end_object(&j);
    fclose(memory);
    enum status status = file_write(path, text, length, fault);
    free(text);
    free(path);
    return status;
}

static enum status perform(struct job *job, struct fault *fault) {
    if (prepare(job, fault) || h5_create(job->options.out_path, &job->writer, fault) ||
        result_begin(job->writer, job->model, &job->parameters, job->options.seed, fault) ||
        run_samples(job, fault))
        return fault->status;
    struct h5_writer *complete = job->writer;
    job->writer = NULL;
    if (h5_commit(complete, fault) != STATUS_OK)
        return fault->status;
    return write_record(job, fault);
}

static void release(struct job *job) {
    h5_discard(job->writer);
    if (job->state)
        job->model->free(job->state);
    h5_close(job->start);
    parameters_free(&job->parameters);
    runfile_free(&job->run);
}

static int finish(const struct fault *fault) {
    if (fault->status != STATUS_OK)
        fprintf(stderr, "bedsim: %s\n", fault->text);
    return fault_exit_code(fault->status);
}

static void catch_signals(void) {
    struct sigaction action = {.sa_handler = on_signal};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static int run(const struct options *options) {
    struct fault fault = FAULT_NONE;
    struct job job = {.options = *options};
    catch_signals();
    clock_gettime(CLOCK_MONOTONIC, &job.began);
    job.shows_progress = !options->quiet && isatty(STDERR_FILENO);
    perform(&job, &fault);
    if (job.shows_progress)
        fprintf(stderr, "\r%78s\r", "");
    release(&job);
    return finish(&fault);
}

/* -- lists ------------------------------------------------------------------------ */

static const struct model *model_argument(const char *name) {
    const struct model *m = models_find(name);
    if (!m)
        fprintf(stderr, "bedsim: model '%s' is unknown (see: bedsim models)\n", name);
    return m;
}

static int list_models(void) {
    size_t count;
    const struct model *const *all = models_all(&count);
    for (size_t i = 0; i < count; i++)
        printf("%-12s %s\n             %s\n", all[i]->name, all[i]->title, all[i]->source);
    return 0;
}

static void print_range(const struct parameter *p) {
    if (p->type != PARAMETER_CHOICE) {
        printf("%g .. %g", p->min, p->max);
        return;
    }
    for (size_t c = 0; p->choices[c]; c++)
        printf("%s%s", c ? " | " : "", p->choices[c]);
}

static int list_parameters(const char *name) {
    const struct model *m = model_argument(name);
    if (!m)
        return 2;
    for (size_t i = 0; i < m->parameter_count; i++) {
        const struct parameter *p = &m->parameters[i];
        printf("%s = %s  (%s; %s", p->name, p->standard, p->unit,
               p->type == PARAMETER_REAL_LIST ? "list of " : "");
        print_range(p);
        printf(")\n    %s\n    source: %s\n", p->doc, p->source);
    }
    return 0;
}

static int list_datasets(const char *name) {
    static const char *const when[] = {"once", "particle samples", "samples"};
    const struct model *m = model_argument(name);
    if (!m)
        return 2;
    for (const struct dataset *d = m->datasets; d->name; d++)
        printf("%-36s %-16s %s\n", d->name, when[d->when], d->doc);
    return 0;
}

static int write_sidecar(const char *result_path) {
    struct fault fault = FAULT_NONE;
    struct h5_reader *result = NULL;
    char *path = NULL;
    enum status status = h5_open(result_path, &result, &fault);
    if (!status)
        status = xdmf_write(result, &path, &fault);
    if (!status)
        printf("%s\n", path);
    h5_close(result);
    free(path);
    return status ? finish(&fault) : 0;
}

/* -- command line ------------------------------------------------------------------ */

static const struct argp_option run_options[] = {
    {"seed", 's', "N", 0, "seed of every random stream (required)", 0},
    {"out", 'o', "FILE.h5", 0, "result file (required)", 0},
    {"set", 'p', "NAME=VALUE", 0, "override a parameter; may be repeated", 0},
    {"quiet", 'q', NULL, 0, "neither progress nor notices", 0},
    {0}};

static void parse_seed(const char *text, struct options *o, struct argp_state *state) {
    char *end;
    errno = 0;
    o->seed = strtoull(text, &end, 10);
    if (errno || *text < '0' || *text > '9' || *end || o->seed >> 53)
        argp_error(state, "--seed %s: not a whole number from 0 to 2^53", text);
    o->seed_given = true;
}

static error_t parse_run(int key, char *argument, struct argp_state *state) {
    struct options *o = state->input;
    switch (key) {
    case 's':
        parse_seed(argument, o, state);
        return 0;
    case 'o':
        o->out_path = argument;
        return 0;
    case 'p':
        if (o->settings == MAX_SETTINGS)
            argp_error(state, "more than %d --set", MAX_SETTINGS);
        o->setting[o->settings++] = argument;
        return 0;
    case 'q':
        o->quiet = true;
        return 0;
    case ARGP_KEY_ARG:
        if (o->run_path)
            argp_error(state, "one run file, not two: %s", argument);
        o->run_path = argument;
        return 0;
    case ARGP_KEY_END:
        if (!o->run_path || !o->out_path || !o->seed_given)
            argp_error(state, "needs RUN.yaml, --seed N and --out FILE.h5");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static int command_run(int argc, char **argv) {
    static const struct argp parser = {
        run_options, parse_run, "RUN.yaml", "Run one run file with one seed.", NULL, NULL, NULL};
    struct options o = {0};
    argv[0] = (char[]){"bedsim run"};
    argp_parse(&parser, argc, argv, 0, NULL, &o);
    return run(&o);
}

static int usage(FILE *to, int code) {
    fprintf(to,
            "Usage: bedsim run RUN.yaml --seed N --out FILE.h5 [--set NAME=VALUE]... [--quiet]\n"
            "       bedsim models\n"
            "       bedsim params MODEL\n"
            "       bedsim datasets MODEL\n"
            "       bedsim xdmf FILE.h5\n"
            "       bedsim --version | --help\n");
    return code;
}

int main(int argc, char **argv) {
    argp_err_exit_status = 2;
    if (argc >= 2 && !strcmp(argv[1], "run"))
        return command_run(argc - 1, argv + 1);
    if (argc == 2 && !strcmp(argv[1], "models"))
        return list_models();
    if (argc == 3 && !strcmp(argv[1], "params"))
        return list_parameters(argv[2]);
    if (argc == 3 && !strcmp(argv[1], "datasets"))
        return list_datasets(argv[2]);
    if (argc == 3 && !strcmp(argv[1], "xdmf"))
        return write_sidecar(argv[2]);
    if (argc == 2 && !strcmp(argv[1], "--help"))
        return usage(stdout, 0);
    if (argc == 2 && !strcmp(argv[1], "--version")) {
        char *line = build_line("bedsim");
        printf("%s\n", line ? line : "bedsim");
        free(line);
        return 0;
    }
    return usage(stderr, 2);
}
