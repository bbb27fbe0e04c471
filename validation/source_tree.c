#include "validation/source_tree.h"

#include "common/file.h"
#include "validation/key.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ANSWER_SIZE = 4096, WORDS = 16 };

static enum status no_memory(struct fault *fault) {
    return fault_set(fault, STATUS_NO_MEMORY, "git: out of memory");
}

static int spawn(const struct source_tree *t, char *const *argv, int pipe_end, pid_t *pid) {
    posix_spawn_file_actions_t files;
    int error = posix_spawn_file_actions_init(&files);
    if (error != 0)
        return error;
    error = posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    if (error == 0)
        error = posix_spawn_file_actions_adddup2(&files, pipe_end, 1);
    if (error == 0)
        error = posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
    if (error == 0)
        error = posix_spawn(pid, t->git, &files, NULL, argv, t->environment);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

/* The beginning of what it says; the rest is read and dropped. */
static void listen_to(int end, char *answer) {
    char more[512];
    size_t length = 0;
    for (;;) {
        bool room = length < ANSWER_SIZE - 1;
        ssize_t got =
            read(end, room ? answer + length : more, room ? ANSWER_SIZE - 1 - length : sizeof more);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        length += room ? (size_t)got : 0;
    }
    answer[length] = '\0';
}

/* git -C folder WORDS...: its exit code, and the beginning of its answer. */
static enum status ask(struct source_tree *t, const char *folder, const char *const *word,
                       char *answer, int *code, struct fault *fault) {
    char *argv[WORDS] = {(char *)t->git, (char *)"--no-optional-locks", (char *)"-C",
                         (char *)folder};
    int ends[2], how = 0;
    pid_t pid = 0;
    for (size_t i = 0; word[i] != NULL && i + 5 < WORDS; i++)
        argv[i + 4] = (char *)word[i];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return fault_set(fault, STATUS_IO, "git: %s", strerror(errno));
    int error = spawn(t, argv, ends[1], &pid);
    close(ends[1]);
    if (error == 0)
        listen_to(ends[0], answer);
    close(ends[0]);
    if (error != 0)
        return fault_set(fault, STATUS_IO, "%s: cannot be started: %s", t->git, strerror(error));
    while (waitpid(pid, &how, 0) < 0 && errno == EINTR)
        continue;
    *code = WIFEXITED(how) ? WEXITSTATUS(how) : -1;
    return STATUS_OK;
}

/* ":(exclude,top)reference" where the references lie inside the checkout. */
static enum status find_references(struct source_tree *t, const char *references,
                                   struct fault *fault) {
    char *real = references == NULL ? NULL : realpath(references, NULL);
    size_t length = strlen(t->top);
    enum status status = STATUS_OK;
    if (real != NULL && strncmp(real, t->top, length) == 0 && real[length] == '/') {
        t->leave_out = arena_text(&t->arena, ":(exclude,top)%s", real + length + 1);
        if (t->leave_out == NULL)
            status = no_memory(fault);
    }
    free(real);
    return status;
}

static enum status find_top(struct source_tree *t, const char *folder, struct fault *fault) {
    static const char *const words[] = {"rev-parse", "--show-toplevel", "HEAD", NULL};
    char answer[ANSWER_SIZE];
    int code = -1;
    enum status status = ask(t, folder, words, answer, &code, fault);
    if (status != STATUS_OK)
        return status;
    size_t line = strcspn(answer, "\n");
    if (code != 0 || answer[line] == '\0' || strlen(answer + line + 1) < 40)
        return fault_set(fault, STATUS_BAD_INPUT, "%s: is in no git checkout with a commit",
                         folder);
    t->top = arena_text(&t->arena, "%.*s", (int)line, answer);
    t->head = arena_text(&t->arena, "%.40s", answer + line + 1);
    char *own = t->top == NULL ? NULL : file_join(t->top, "validation/bedcheck.c");
    if (own == NULL || t->head == NULL) {
        free(own);
        return no_memory(fault);
    }
    t->is_ours = file_exists(own);
    free(own);
    return STATUS_OK;
}

static enum status find_change(struct source_tree *t, struct fault *fault) {
    const char *words[] = {"status", "--porcelain", "--", ":(top)", t->leave_out, NULL};
    char answer[ANSWER_SIZE];
    int code = -1;
    enum status status = ask(t, t->top, words, answer, &code, fault);
    if (status == STATUS_OK && code != 0)
        status = fault_set(fault, STATUS_IO, "%s: git status fails", t->top);
    if (status != STATUS_OK || answer[0] == '\0')
        return status;
    const char *name = strlen(answer) > 3 ? answer + 3 : answer;
    t->first_change = arena_text(&t->arena, "%.*s", (int)strcspn(name, "\n"), name);
    return t->first_change == NULL ? no_memory(fault) : STATUS_OK;
}

enum status source_tree_look(const char *cases_folder, const char *references_folder,
                             const char *path_list, char *const *environment,
                             struct source_tree *out, struct fault *fault) {
    char *git = NULL;
    *out = (struct source_tree){.environment = environment};
    enum status status = key_find_program("git", path_list, &git, fault);
    if (status == STATUS_OK && (out->git = arena_copy(&out->arena, git)) == NULL)
        status = no_memory(fault);
    if (status == STATUS_OK)
        status = find_top(out, cases_folder, fault);
    if (status == STATUS_OK)
        status = find_references(out, references_folder, fault);
    if (status == STATUS_OK)
        status = find_change(out, fault);
    free(git);
    return status;
}

void source_tree_free(struct source_tree *t) {
    arena_free(&t->arena);
}

enum status source_tree_is_head(struct source_tree *t, const char *commit, bool *is_head,
                                bool *known, struct fault *fault) {
    const char *words[] = {"diff", "--quiet", commit, "HEAD", "--", ":(top)", t->leave_out, NULL};
    char answer[ANSWER_SIZE];
    int code = -1;
    *is_head = *known = false;
    if (strlen(commit) != 40 || strspn(commit, "0123456789abcdef") != 40)
        return STATUS_OK; /* "unknown", or an option */
    enum status status = ask(t, t->top, words, answer, &code, fault);
    *is_head = code == 0;
    *known = code == 0 || code == 1;
    return status;
}
