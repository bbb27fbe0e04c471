/* command_claims.c -- bedcheck claims: what the papers say, and what decides it. */
#include "validation/command.h"

#include "validation/claims.h"

#include <string.h>

static void tell_test(FILE *out, const struct claim_test *t) {
    fprintf(out, "    %s %s, %s", t->wants_pass ? "pass" : "fail", t->case_name, t->check);
    for (size_t i = 0; i < t->points.count; i++) {
        const struct yaml_node *n = &t->points.map->child[i];
        fprintf(out, "%s%s", i == 0 ? " [" : ", ", n->key);
        for (size_t k = 0; k < (n->kind == YAML_LIST ? n->count : 1); k++)
            fprintf(out, " %s", n->kind == YAML_LIST ? n->child[k].text : n->text);
    }
    fputs(t->points.count == 0 ? " (" : "] (", out);
    const char *separate = "";
    for (enum tier k = 0; k < TIER_COUNT; k++) {
        if (!t->in_tier[k])
            continue;
        fprintf(out, "%s%s", separate, case_tier_name(k));
        separate = ", ";
    }
    fputs(")\n", out);
}

/* Texts of YAML end in a newline where they were folded. */
static void tell_text(FILE *out, const char *head, const char *text) {
    if (text == NULL)
        return;
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == '\n')
        length--;
    fprintf(out, "    %s%.*s\n", head, (int)length, text);
}

static void tell_claim(FILE *out, const struct claim *c) {
    fprintf(out, "%s: %s, %s\n", c->id, c->paper, c->where);
    tell_text(out, "", c->says);
    tell_text(out, "reading: ", c->reading);
    fprintf(out, "  %s%s", claim_verdict_name(c->verdict), c->test_count > 0 ? " if these" : "");
    if (c->test_count > 0)
        fprintf(out, " come out so, else %s", claim_verdict_name(c->otherwise));
    fputs("\n", out);
    for (size_t i = 0; i < c->test_count; i++)
        tell_test(out, &c->test[i]);
    tell_text(out, "no test: ", c->untested);
}

int command_claims(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct claims *claims = NULL;
    if (claims_load(o->cases_folder, &claims, &fault) != STATUS_OK) {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
        return 2;
    }
    for (size_t i = 0; i < claims->count; i++)
        tell_claim(c->out, &claims->claim[i]);
    fprintf(c->out, "%zu claims\n", claims->count);
    claims_free(claims);
    return 0;
}
