/* reference_key.c -- see reference.h: what a row is kept under, and which lines nobody needs. */
#include "validation/reference.h"

#include "common/digest.h"
#include "common/schema.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -- which rows ------------------------------------------------------------------------ */

static const struct case_across *across_of(const struct plan_case *c,
                                           const struct case_check *check) {
    return check->number.across ? &c->file->across[check->number.index] : NULL;
}

static bool takes(const struct case_filter *f, const struct plan_point *p) {
    return case_filter_takes(f, p->parameter, p->parameter_count);
}

static bool in_group(const struct plan_case *c, const struct case_across *a, size_t p, size_t q) {
    return takes(&a->points, &c->point[p]) && takes(&a->points, &c->point[q]) &&
           case_points_agree(c->tier, c->point[p].parameter, c->point[q].parameter,
                             case_axis_of(c->tier, a->along));
}

bool reference_has_row(const struct plan_case *c, size_t check, size_t point) {
    const struct case_check *k = &c->tier->check[check];
    const struct case_across *a = across_of(c, k);
    if (!takes(&k->points, &c->point[point]))
        return false;
    for (size_t q = 0; a != NULL && q < point; q++) {
        if (in_group(c, a, q, point))
            return false;
    }
    return a == NULL || takes(&a->points, &c->point[point]);
}

/* -- names ----------------------------------------------------------------------------- */

static const char *number_name(const struct plan_case *c, const struct case_number *n,
                               struct arena *a) {
    const struct case_observable *o = &c->file->observable[n->index];
    return arena_text(a, "%s.%s", o->name, o->recipe->output[n->output].name);
}

/* "law", or "law(speed=column.speed,factor=1.05)": inputs that are not the parameters of
 * their names. */
static const char *prediction_name(const struct plan_case *c, const struct case_prediction *p,
                                   struct arena *a) {
    const char *text = p->prediction->name, *mark = "(";
    for (size_t i = 0; i < PREDICTION_MAX_INPUTS && p->prediction->input[i] != NULL; i++) {
        const struct case_binding *b = &p->input[i];
        const char *name = p->prediction->input[i], *value = NULL;
        if (b->kind == BINDING_PARAMETER && strcmp(b->parameter, name) == 0)
            continue;
        if (b->kind == BINDING_PARAMETER)
            value = b->parameter;
        else
            value = b->kind == BINDING_NUMBER ? arena_text(a, "%.15g", b->number)
                                              : number_name(c, &b->observable, a);
        text = value == NULL || text == NULL ? NULL
                                             : arena_text(a, "%s%s%s=%s", text, mark, name, value);
        mark = ",";
    }
    return text != NULL && *mark == ',' ? arena_text(a, "%s)", text) : text;
}

/* The expectation where it differs from run to run, else "". */
static const char *varying_name(const struct plan_case *c, const struct case_expect *e,
                                struct arena *a) {
    if (e != NULL && e->kind == EXPECT_CURVE) {
        struct digest d;
        char *text = arena_copy(a, "");
        for (size_t i = 0; i < e->count && text != NULL; i++)
            text = arena_text(a, "%s %.17g:%.17g", text, e->x[i], e->y[i]);
        const char *along = number_name(c, &e->along, a);
        if (text == NULL || along == NULL)
            return NULL;
        digest_bytes(text, strlen(text), &d);
        return arena_text(a, " - curve(%s,%.8s)", along, d.hex);
    }
    bool varies = false;
    for (size_t i = 0; e != NULL && e->kind == EXPECT_PREDICTION && i < PREDICTION_MAX_INPUTS; i++)
        varies |= e->prediction.prediction->input[i] != NULL &&
                  e->prediction.input[i].kind == BINDING_OBSERVABLE;
    const char *law = varies ? prediction_name(c, &e->prediction, a) : "";
    return law == NULL || *law == '\0' ? law : arena_text(a, " - %s", law);
}

static const char *observable_name(const struct plan_case *c, const struct case_check *k,
                                   const struct plan_point *p, struct arena *a) {
    if (k->number.across)
        return k->observable;
    const char *per = k->per.prediction == NULL ? "" : prediction_name(c, &k->per, a);
    const char *varying =
        varying_name(c, case_expect_find(&k->expect, p->parameter, p->parameter_count), a);
    if (per == NULL || varying == NULL)
        return NULL;
    return arena_text(a, "%s%s%s%s", k->observable, *per == '\0' ? "" : " / ", per, varying);
}

/* -- meaning --------------------------------------------------------------------------- */

static void write_observable(FILE *out, const struct plan_case *c, const struct case_number *n) {
    const struct case_observable *o = &c->file->observable[n->index];
    fprintf(out, "%s.%s:", o->recipe->name, o->recipe->output[n->output].name);
    for (size_t i = 0; i < RECIPE_MAX_SETTINGS && o->recipe->setting[i].name != NULL; i++)
        fprintf(out, " %s=%.17g", o->recipe->setting[i].name, o->setting[i]);
    fputc('\n', out);
}

/* A fit over a sweep or over seeds, down to the observable that it reads. */
static void write_across(FILE *out, const struct plan_case *c, const struct case_across *a) {
    while (a != NULL) {
        fprintf(out, "%s along %s%s\n", a->ensemble != NULL ? a->ensemble->name : a->fit->name,
                a->along, a->exact ? " exact" : "");
        if (!a->of.across)
            write_observable(out, c, &a->of);
        a = a->of.across ? &c->file->across[a->of.index] : NULL;
    }
}

static void write_inputs(FILE *out, const struct plan_case *c, const struct case_prediction *p) {
    for (size_t i = 0; p->prediction != NULL && i < PREDICTION_MAX_INPUTS; i++) {
        if (p->prediction->input[i] != NULL && p->input[i].kind == BINDING_OBSERVABLE)
            write_observable(out, c, &p->input[i].observable);
    }
}

/* Everything in the case's text that the numbers of this row come from. */
static void write_meaning(FILE *out, const struct plan_case *c, const struct case_check *k,
                          size_t point) {
    const struct plan_point *p = &c->point[point];
    const struct case_across *a = across_of(c, k);
    for (size_t q = point; q < c->point_count; q++) {
        if ((a == NULL ? q == point : in_group(c, a, point, q)) && c->point[q].run_count > 0)
            fprintf(out, "%s\n", c->point[q].run[0]->id);
    }
    write_across(out, c, a);
    if (a == NULL)
        write_observable(out, c, &k->number);
    write_inputs(out, c, &k->per);
    const struct case_expect *e = case_expect_find(&k->expect, p->parameter, p->parameter_count);
    if (a == NULL && e != NULL && e->kind == EXPECT_PREDICTION)
        write_inputs(out, c, &e->prediction);
    if (a == NULL && e != NULL && e->kind == EXPECT_CURVE)
        write_observable(out, c, &e->along);
}

static const char *make_meaning(const struct plan_case *c, const struct case_check *k, size_t point,
                                struct arena *a) {
    char *text = NULL;
    size_t length = 0;
    struct digest d;
    FILE *out = open_memstream(&text, &length);
    if (out == NULL)
        return NULL;
    write_meaning(out, c, k, point);
    bool whole = fclose(out) == 0;
    if (whole)
        digest_bytes(text, length, &d);
    free(text);
    return whole ? arena_text(a, "%.8s", d.hex) : NULL;
}

/* -- keys ------------------------------------------------------------------------------ */

static const char *point_name(const char *name) {
    return name != NULL && strcmp(name, "single") == 0 ? "-" : name;
}

enum status reference_key_make(const struct plan_case *c, size_t check, size_t point,
                               struct arena *a, struct reference_key *out, struct fault *fault) {
    const struct case_check *k = &c->tier->check[check];
    const struct case_across *across = across_of(c, k);
    const struct plan_point *p = &c->point[point];
    const char *name = across == NULL
                           ? p->name
                           : case_point_text(a, c->tier, p->parameter, p->parameter_count,
                                             case_axis_of(c->tier, across->along));
    *out = (struct reference_key){.tier = (enum tier)(c->tier - c->file->tier),
                                  .point = point_name(name),
                                  .observable = observable_name(c, k, p, a),
                                  .meaning = make_meaning(c, k, point, a)};
    const char *varying =
        across != NULL
            ? ""
            : varying_name(c, case_expect_find(&k->expect, p->parameter, p->parameter_count), a);
    out->difference = varying != NULL && *varying != '\0';
    return out->point == NULL || out->observable == NULL || out->meaning == NULL
               ? fault_set(fault, STATUS_NO_MEMORY, "references: out of memory")
               : STATUS_OK;
}

const char *reference_run_meaning(const struct plan_run *run) {
    return run->id + strlen(run->id) - 8;
}

bool reference_is_meant(const struct reference *line, const char *meaning) {
    return strcmp(line->meaning, "-") == 0 || strcmp(line->meaning, meaning) == 0;
}

/* -- finding --------------------------------------------------------------------------- */

const struct reference *reference_find(const struct references *r, const struct reference_key *key,
                                       enum reference_origin origin) {
    for (size_t i = 0; r != NULL && i < r->count; i++) {
        const struct reference *line = &r->item[i];
        if (line->tier == key->tier && line->origin == origin &&
            strcmp(line->point, key->point) == 0 && strcmp(line->observable, key->observable) == 0)
            return line;
    }
    return NULL;
}

/* Is text STEM@SEED? */
static bool is_seed_of(const char *text, const char *stem, long long seed) {
    size_t length = strlen(stem);
    return strncmp(text, stem, length) == 0 && text[length] == '@' &&
           strtoll(text + length + 1, NULL, 10) == seed;
}

const struct reference *reference_find_seed(const struct references *r,
                                            const struct reference_key *key, long long seed) {
    for (size_t i = 0; r != NULL && i < r->count; i++) {
        const struct reference *line = &r->item[i];
        if (line->tier == key->tier && line->origin == ORIGIN_SEED &&
            strcmp(line->point, key->point) == 0 &&
            is_seed_of(line->observable, key->observable, seed))
            return line;
    }
    return NULL;
}

const struct reference *reference_find_bits(const struct references *r, enum tier tier,
                                            const struct plan_point *point,
                                            const struct plan_run *run, const char *build) {
    for (size_t i = 0; r != NULL && i < r->count; i++) {
        const struct reference *line = &r->item[i];
        if (line->tier == tier && line->origin == ORIGIN_BITS &&
            strcmp(line->point, point_name(point->name)) == 0 &&
            is_seed_of(line->observable, "bits", run->seed) && strcmp(line->build, build) == 0)
            return line;
    }
    return NULL;
}
