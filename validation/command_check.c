/* command_check.c -- bedcheck check, report and clean: a folder of results taken up again. */
#include "validation/command.h"

#include "validation/desk.h"
#include "validation/review.h"

static enum status judge(const struct review *r, bool page, const struct console *c, int *code,
                         struct fault *fault) {
    struct desk *desk = NULL;
    struct budget *budget = NULL;
    enum verdict worst = VERDICT_PASS;
    struct folder_record record = r->record; /* claims stand beside the cases that are judged */
    record.cases_folder = r->cases_folder;
    record.references_folder = r->references_folder;
    enum status status =
        budget_open(r->cases_folder, r->references_folder, r->plan->tier, r->plan, &budget, fault);
    if (status == STATUS_OK)
        status = desk_create(r->plan, r->outcome, &r->execute, c, &desk, fault);
    if (status == STATUS_OK) {
        desk_set_budget(desk, budget);
        status = desk_judge(desk, &worst, fault);
    }
    if (status == STATUS_OK)
        status = desk_file(desk, &record, page, code, fault);
    desk_free(desk);
    budget_close(budget);
    return status;
}

int command_check(const struct command_options *o, bool page, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct review *r = NULL;
    int code = 2;
    if (review_open(o->out, o->cases_folder, o->references_folder, &r, &fault) != STATUS_OK ||
        judge(r, page, c, &code, &fault) != STATUS_OK) {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
        code = 2;
    }
    review_close(r);
    return code;
}

int command_clean(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct folder *f = NULL;
    size_t removed = 0, left = 0;
    enum status status = folder_open(o->out, false, &f, &fault);
    if (status == STATUS_OK)
        status = o->stale ? folder_clean_stale(f, &removed, &fault)
                          : folder_clean(f, &removed, &left, &fault);
    if (status == STATUS_OK) {
        fprintf(c->out, "%s: %zu %s removed", o->out, removed, o->stale ? "results" : "files");
        if (left > 0)
            fprintf(c->out, ", %zu that are not bedcheck's left", left);
        fputc('\n', c->out);
    } else {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    }
    folder_close(f);
    return status == STATUS_OK ? 0 : 2;
}
