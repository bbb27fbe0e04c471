/* bedcheck.c -- the program: validation cases run, judged and reported.
 *
 *     bedcheck list | show | recipes | claims | run | check | report | clean
 *     bedcheck calibrate | accept | compare | history
 *
 * Only the command line is read here, one parser a command; command_*.c do the
 * work.  Exit codes: 0 all checks pass, 1 a check failed, 3 inconclusive, 2
 * trouble of bedcheck's own, 130 interrupted.
 */
#include "common/build.h"
#include "validation/command.h"

#include <argp.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_WORDS = 256 };

enum key {
    KEY_CASES = 256,
    KEY_TIER,
    KEY_OUT,
    KEY_SOLVER,
    KEY_TAG,
    KEY_SKIP,
    KEY_SET,
    KEY_DRY_RUN,
    KEY_FAILED,
    KEY_TIMEOUT,
    KEY_SEED_OFFSET,
    KEY_STALE,
    KEY_REFERENCES,
    KEY_SEEDS,
    KEY_CASE,
    KEY_ALL_CHANGED,
    KEY_CLAIMS,
    KEY_REASON,
    KEY_JSON,
    KEY_MARKDOWN,
    KEY_LEVEL,
    KEY_FILE,
    KEY_PLOT
};

/* Lists that the options point into. */
struct line {
    struct command_options o;
    const char *pattern[MAX_WORDS], *tag[MAX_WORDS], *skip[MAX_WORDS], *setting[MAX_WORDS];
    const char *chosen[MAX_WORDS];
    size_t folders; /* how many folders of results are its arguments; 0: they are cases */
    size_t patterns_needed;
};

static void add_word(struct argp_state *state, const char **list, size_t *count, const char *word) {
    if (*count == MAX_WORDS)
        argp_error(state, "more than %d of a kind: %s", (int)MAX_WORDS, word);
    else
        list[(*count)++] = word;
}

static double read_number(struct argp_state *state, const char *option, const char *text,
                          double min, double max, bool whole) {
    char *end;
    errno = 0;
    double value = strtod(text, &end);
    if (end == text || *end != '\0' || errno != 0 || !(value >= min && value <= max) ||
        (whole && floor(value) != value))
        argp_error(state, "%s %s: must be a %snumber from %g to %g", option, text,
                   whole ? "whole " : "", min, max);
    return value;
}

static void read_tier(struct argp_state *state, struct command_options *o, const char *text) {
    struct fault fault = FAULT_NONE;
    o->tier_given = true;
    if (case_tier_find(text, &o->tier, &fault) != STATUS_OK)
        argp_error(state, "--%s", fault.text);
}

static void take_argument(struct argp_state *state, struct line *l, const char *word) {
    if (l->folders == 0)
        add_word(state, l->pattern, &l->o.pattern_count, word);
    else if (l->o.out == NULL)
        l->o.out = word;
    else if (l->folders == 2 && l->o.other == NULL)
        l->o.other = word;
    else
        argp_error(state, "%s: %s", l->folders == 2 ? "two folders" : "one folder at a time", word);
}

static void check_arguments(struct argp_state *state, const struct line *l) {
    if (l->folders > 0 && l->o.out == NULL)
        argp_error(state, "which folder of results?");
    if (l->o.pattern_count < l->patterns_needed)
        argp_error(state, "which case?");
    if (l->o.failed && l->o.pattern_count > 0)
        argp_error(state, "--failed chooses the cases by itself");
    if (l->o.out != NULL && *l->o.out == '\0')
        argp_error(state, "the folder's name is empty");
}

static error_t parse_choice(int key, char *text, struct line *l, struct argp_state *state) {
    struct command_options *o = &l->o;
    switch (key) {
    case KEY_TAG:
        add_word(state, l->tag, &o->tag_count, text);
        return 0;
    case KEY_SKIP:
        add_word(state, l->skip, &o->skip_count, text);
        return 0;
    case KEY_SET:
        add_word(state, l->setting, &o->setting_count, text);
        return 0;
    case 'j':
        o->jobs = (size_t)read_number(state, "--jobs", text, 1, 1024, true);
        return 0;
    case KEY_TIMEOUT:
        o->limit_s = read_number(state, "--timeout", text, 0.001, 1e9, false);
        return 0;
    case KEY_CASE:
        add_word(state, l->chosen, &o->chosen_count, text);
        return 0;
    case KEY_ALL_CHANGED:
        o->all_changed = true;
        return 0;
    case KEY_CLAIMS:
        o->claims = true;
        return 0;
    case KEY_REASON:
        o->reason = text;
        return 0;
    case KEY_SEEDS:
        o->seed_count = (size_t)read_number(state, "--seeds", text, 1, 100000, true);
        return 0;
    case KEY_SEED_OFFSET:
        o->seed_offset = (long long)read_number(state, "--seed-offset", text, 0, 1e15, true);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_comparison(int key, char *text, struct line *l, struct argp_state *state) {
    struct command_options *o = &l->o;
    switch (key) {
    case KEY_JSON:
    case KEY_MARKDOWN:
        if (o->format != FORMAT_TEXT)
            argp_error(state, "one of --json and --markdown");
        o->format = key == KEY_JSON ? FORMAT_JSON : FORMAT_MARKDOWN;
        return 0;
    case KEY_LEVEL:
        o->level = read_number(state, "--level", text, 1e-12, 0.5, false);
        return 0;
    case KEY_FILE:
        o->file = text;
        return 0;
    case KEY_PLOT:
        o->plot = text;
        return 0;
    default:
        return parse_choice(key, text, l, state);
    }
}

static error_t parse(int key, char *text, struct argp_state *state) {
    struct line *l = state->input;
    struct command_options *o = &l->o;
    switch (key) {
    case KEY_CASES:
        o->cases_folder = text;
        return 0;
    case KEY_REFERENCES:
        o->references_folder = text;
        return 0;
    case KEY_TIER:
        read_tier(state, o, text);
        return 0;
    case KEY_OUT:
        o->out = text;
        return 0;
    case KEY_SOLVER:
        o->solver = text;
        return 0;
    case KEY_DRY_RUN:
        o->dry_run = true;
        return 0;
    case KEY_FAILED:
        o->failed = true;
        return 0;
    case KEY_STALE:
        o->stale = true;
        return 0;
    case 'x':
        o->stop_at_failure = true;
        return 0;
    case ARGP_KEY_ARG:
        take_argument(state, l, text);
        return 0;
    case ARGP_KEY_END:
        check_arguments(state, l);
        return 0;
    default:
        return parse_comparison(key, text, l, state);
    }
}

#define OPTION_CASES                                                                               \
    { "cases", KEY_CASES, "DIR", 0, "Folder of case files", 0 }
#define OPTION_REFERENCES                                                                          \
    {                                                                                              \
        "references", KEY_REFERENCES, "DIR", 0,                                                    \
            "Folder of stored references (default with our own cases: ours)", 0                    \
    }
#define OPTION_REFERENCES_OF_RUN                                                                   \
    {                                                                                              \
        "references", KEY_REFERENCES, "DIR", 0,                                                    \
            "Folder of stored references (default: the one that the run named)", 0                 \
    }
#define OPTION_TIER                                                                                \
    { "tier", KEY_TIER, "TIER", 0, "smoke (default), paper or large", 0 }
#define OPTION_ANY_TIER                                                                            \
    { "tier", KEY_TIER, "TIER", 0, "smoke, paper or large (default: all)", 0 }
#define OPTION_TAG                                                                                 \
    { "tag", KEY_TAG, "TAG", 0, "Only cases with this tag (may be repeated)", 0 }

static const struct argp_option list_options[] = {
    OPTION_CASES, OPTION_REFERENCES, OPTION_ANY_TIER, OPTION_TAG, {0}};
static const struct argp_option show_options[] = {OPTION_CASES, OPTION_ANY_TIER, {0}};
static const struct argp_option check_options[] = {OPTION_CASES, OPTION_REFERENCES_OF_RUN, {0}};
static const struct argp_option calibrate_options[] = {
    OPTION_CASES,
    OPTION_REFERENCES,
    OPTION_TIER,
    OPTION_TAG,
    {"out", KEY_OUT, "DIR", 0, "Folder of results (default bedcheck-out/calibrate-TIER)", 0},
    {"solver", KEY_SOLVER, "COMMAND", 0, "The solver (default: bedsim beside bedcheck)", 0},
    {"jobs", 'j', "J", 0, "Runs at a time (default: the processors)", 0},
    {"dry-run", KEY_DRY_RUN, 0, 0, "Show runs, what is reused, minutes and bytes; run nothing", 0},
    {"timeout", KEY_TIMEOUT, "S", 0, "Wall-clock limit of each run instead of its case's", 0},
    {"seeds", KEY_SEEDS, "K", 0, "K seeds for every point; an ensemble needs 32", 0},
    {0}};
static const struct argp_option accept_options[] = {
    OPTION_CASES,
    OPTION_REFERENCES_OF_RUN,
    {"case", KEY_CASE, "CASE|GLOB", 0, "Accept this case (may be repeated)", 0},
    {"all-changed", KEY_ALL_CHANGED, 0, 0, "Accept every case of DIR whose references change", 0},
    {"claims", KEY_CLAIMS, 0, 0, "Accept the verdicts of the papers' claims, and no numbers", 0},
    {"reason", KEY_REASON, "TEXT", 0, "Why they change, in one line", 0},
    {"dry-run", KEY_DRY_RUN, 0, 0, "Show old and new; write nothing", 0},
    {0}};
static const struct argp_option claims_options[] = {OPTION_CASES, {0}};
static const struct argp_option no_options[] = {{0}};
static const struct argp_option clean_options[] = {
    {"stale", KEY_STALE, 0, 0, "Only results of other solver builds than the last run's", 0}, {0}};
static const struct argp_option compare_options[] = {
    OPTION_REFERENCES_OF_RUN,
    {"json", KEY_JSON, 0, 0, "For programs", 0},
    {"markdown", KEY_MARKDOWN, 0, 0, "For a pull request", 0},
    {"level", KEY_LEVEL, "L", 0,
     "Probability of any false alarm in the whole comparison (default 0.001)", 0},
    {0}};
static const struct argp_option history_options[] = {
    {"file", KEY_FILE, "FILE", 0, "Append a line on DIR to FILE (JSON lines)", 0},
    {"plot", KEY_PLOT, "FILE", 0, "Draw what FILE holds", 0},
    {"out", KEY_OUT, "FOLDER", 0, "Where to (default bedcheck-out/history)", 0},
    {0}};
static const struct argp_option run_options[] = {
    OPTION_CASES,
    OPTION_REFERENCES,
    OPTION_TIER,
    OPTION_TAG,
    {"out", KEY_OUT, "DIR", 0, "Folder of results (default bedcheck-out/TIER)", 0},
    {"solver", KEY_SOLVER, "COMMAND", 0, "The solver (default: bedsim beside bedcheck)", 0},
    {"jobs", 'j', "J", 0, "Runs at a time (default: the processors)", 0},
    {"dry-run", KEY_DRY_RUN, 0, 0, "Show runs, what is reused, minutes and bytes; run nothing", 0},
    {"failed", KEY_FAILED, 0, 0, "Only the cases of DIR with a check that did not pass", 0},
    {"exitfirst", 'x', 0, 0, "Start no more runs after the first failed check", 0},
    {"skip", KEY_SKIP, "CASE=reason", 0, "Leave a case out, and say so in the report", 0},
    {"timeout", KEY_TIMEOUT, "S", 0, "Wall-clock limit of each run instead of its case's", 0},
    {"seeds", KEY_SEEDS, "K", 0, "K seeds for every point, whatever its case says", 0},
    {"seed-offset", KEY_SEED_OFFSET, "K", 0, "Add K to every seed: fresh seeds", 0},
    {"set", KEY_SET, "parameter=value", 0,
     "Override the solver behind the judge's back: expectations stay, the report is MODIFIED", 0},
    {0}};

/* -- commands ------------------------------------------------------------------------ */

static int run_list(const struct command_options *o, const struct console *c) {
    return command_list(o, c);
}

static int run_recipes(const struct command_options *o, const struct console *c) {
    (void)o;
    return command_recipes(c);
}

static int run_claims(const struct command_options *o, const struct console *c) {
    return command_claims(o, c);
}

static int run_check(const struct command_options *o, const struct console *c) {
    return command_check(o, false, c);
}

static int run_report(const struct command_options *o, const struct console *c) {
    return command_check(o, true, c);
}

struct command {
    const char *name, *arguments, *doc;
    const struct argp_option *options;
    size_t folders; /* that are its arguments */
    size_t patterns_needed;
    int (*run)(const struct command_options *o, const struct console *c);
};

static const struct command commands[] = {
    {"list", "[CASE|GLOB]...", "Name the cases.", list_options, 0, 0, run_list},
    {"show", "CASE|GLOB...", "Show question, sources, points and checks of cases.", show_options, 0,
     1, command_show},
    {"recipes", "", "Name the observables, predictions, fits and figures that a case may use.",
     no_options, 0, 0, run_recipes},
    {"claims", "", "Name the papers' claims and the checks that decide them.", claims_options, 0, 0,
     run_claims},
    {"run", "[CASE|GLOB]...", "Run cases, judge them and write the report.", run_options, 0, 0,
     command_run},
    {"check", "DIR", "Judge the results in DIR again, without running anything.", check_options, 1,
     0, run_check},
    {"report", "DIR", "Judge the results in DIR again and write the report.", check_options, true,
     0, run_report},
    {"calibrate", "CASE|GLOB...",
     "Run cases with many seeds: alarm rates, margins, and what held-out seeds say of them.",
     calibrate_options, 0, 1, command_calibrate},
    {"accept", "DIR", "Make results in DIR the stored references.", accept_options, 1, 0,
     command_accept},
    {"clean", "DIR", "Remove what bedcheck wrote in DIR, and nothing else.", clean_options, 1, 0,
     command_clean},
    {"compare", "[OLD] NEW", "Compare results with others, or with the references.",
     compare_options, 2, 0, command_compare},
    {"history", "[DIR]", "Keep and draw the trends of many commits.", history_options, 0, 0,
     command_history},
};

static void print_usage(FILE *out) {
    fputs("Usage: bedcheck COMMAND [OPTION...]\n\n", out);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        fprintf(out, "  %-9s %-16s %s\n", commands[i].name, commands[i].arguments, commands[i].doc);
    fputs(
        "\nbedcheck COMMAND --help tells the options of a command; bedcheck --version the build.\n"
        "Exit codes: 0 all checks pass, 1 a check failed, 3 inconclusive, 2 bedcheck's own "
        "trouble.\n",
        out);
}

/* -- surroundings -------------------------------------------------------------------- */

/* A path as the user would write it: relative where it lies below this folder. */
static char *shorten(char *path) {
    char here[PATH_MAX];
    size_t length = getcwd(here, sizeof here) == NULL ? 0 : strlen(here);
    if (length < 2 || strncmp(path, here, length) != 0 || path[length] != '/')
        return path;
    memmove(path, path + length + 1, strlen(path + length + 1) + 1);
    return path;
}

/* Path of this program in program[0 .. PATH_MAX-1]. */
static bool find_self(char *program) {
    ssize_t length = readlink("/proc/self/exe", program, PATH_MAX - 1);
    program[length > 0 ? length : 0] = '\0';
    return length > 0;
}

/* FOLDER-OF-THIS-PROGRAM/relative, or NULL where there is no such thing. */
static char *find_beside(const char *relative) {
    char program[PATH_MAX], *path = NULL;
    if (!find_self(program))
        return NULL;
    *strrchr(program, '/') = '\0';
    if (asprintf(&path, "%s/%s", program, relative) < 0)
        return NULL;
    char *real = realpath(path, NULL);
    free(path);
    return real == NULL ? NULL : shorten(real);
}

/* Data of ours: in the repository that this program was built in, or where it was installed. */
static char *find_data(const char *name) {
    static const char *const place[] = {"../..", "../share/bedcheck"};
    char *found = NULL;
    for (size_t i = 0; found == NULL && i < sizeof place / sizeof *place; i++) {
        char *path = NULL;
        if (asprintf(&path, "%s/%s", place[i], name) < 0)
            return NULL;
        found = find_beside(path);
        free(path);
    }
    return found;
}

/* A program needs a '/' in its path, lest it be looked for in PATH. */
static char *find_solver(void) {
    char *path = find_beside("bedsim"), *dotted = NULL;
    if (path == NULL || strchr(path, '/') != NULL)
        return path;
    if (asprintf(&dotted, "./%s", path) < 0)
        dotted = NULL;
    free(path);
    return dotted;
}

static const char *const calibrate_out[] = {
    "bedcheck-out/calibrate-smoke", "bedcheck-out/calibrate-paper", "bedcheck-out/calibrate-large"};
static const char *const standard_out[] = {"bedcheck-out/smoke", "bedcheck-out/paper",
                                           "bedcheck-out/large"};

static int perform(const struct command *command, struct line *l) {
    char self[PATH_MAX];
    struct console console = {
        .out = stdout, .errors = stderr, .live = isatty(2) == 1 && getenv("CI") == NULL};
    char *cases = find_data("validation/cases"), *solver = find_solver();
    char *references = find_data("reference");
    if (find_self(self))
        console.program = self;
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    struct command_options *o = &l->o;
    int code = 2;
    o->pattern = l->pattern;
    o->tag = l->tag;
    o->skip = l->skip;
    o->setting = l->setting;
    o->chosen = l->chosen;
    const char *ci = getenv("CI");
    o->in_ci = ci != NULL && *ci != '\0' && strcmp(ci, "false") != 0 && strcmp(ci, "0") != 0;
    o->path_list = getenv("PATH");
    o->environment = environ;
    if (o->cases_folder == NULL && o->references_folder == NULL && command->folders == 0)
        o->references_folder = references; /* our references are of our cases */
    if (o->cases_folder == NULL && command->folders == 0)
        o->cases_folder = cases;
    if (o->solver == NULL)
        o->solver = solver == NULL ? "bedsim" : solver;
    if (o->jobs == 0)
        o->jobs = processors < 1 ? 1 : (size_t)processors;
    if (o->out == NULL)
        o->out = command->run == command_history     ? "bedcheck-out/history"
                 : command->run == command_calibrate ? calibrate_out[o->tier]
                                                     : standard_out[o->tier];
    if (!(o->level > 0))
        o->level = 1e-3;
    bool reads_cases =
        command->folders == 0 && command->run != run_recipes && command->run != command_history;
    if (o->cases_folder == NULL && reads_cases)
        fprintf(stderr, "bedcheck: no folder of cases beside this program; use --cases DIR\n");
    else
        code = command->run(o, &console);
    free(cases);
    free(references);
    free(solver);
    return code;
}

static int run_command(const struct command *command, int argc, char **argv) {
    struct line *l = calloc(1, sizeof *l);
    char name[64];
    if (l == NULL) {
        fputs("bedcheck: out of memory\n", stderr);
        return 2;
    }
    l->folders = command->folders;
    l->patterns_needed = command->patterns_needed;
    snprintf(name, sizeof name, "bedcheck %s", command->name);
    argv[0] = name;
    const struct argp argp = {.options = command->options,
                              .parser = parse,
                              .args_doc = command->arguments,
                              .doc = command->doc};
    error_t error = argp_parse(&argp, argc, argv, 0, NULL, l);
    int code = error == 0 ? perform(command, l) : 2;
    free(l);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fputs("bedcheck: standard output cannot be written\n", stderr);
        code = 2;
    }
    return code;
}

int main(int argc, char **argv) {
    argp_err_exit_status = 2;
    signal(SIGPIPE, SIG_IGN);
    const char *word = argc < 2 ? "" : argv[1];
    if (strcmp(word, "--version") == 0) {
        char *line = build_line("bedcheck");
        puts(line == NULL ? "bedcheck" : line);
        free(line);
        return 0;
    }
    if (strcmp(word, "--help") == 0 || strcmp(word, "help") == 0) {
        print_usage(stdout);
        return 0;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(word, commands[i].name) == 0)
            return run_command(&commands[i], argc - 1, argv + 1);
    }
    if (argc >= 2)
        fprintf(stderr, "bedcheck: %s: no such command\n", word);
    print_usage(stderr);
    return 2;
}
