/* command_list.c -- bedcheck list, show and recipes: what there is. */
#include "validation/command.h"

#include "validation/budget.h"
#include "validation/figures.h"
#include "validation/papers.h"
#include "validation/reference.h"
#include "validation/selection.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t count_runs(const struct case_tier *t) {
    size_t runs = 0;
    struct case_parameter p[512];
    for (size_t i = 0; t->room <= 512 && i < t->point_count; i++) {
        size_t count = case_point(t, i, p);
        runs += case_seed_count(&t->seeds, p, count);
    }
    return runs;
}

static void list_case(FILE *out, const struct case_file *c) {
    fprintf(out, "%-42s %s", c->name, c->title);
    for (enum tier t = 0; t < TIER_COUNT; t++) {
        if (c->tier[t].present)
            fprintf(out, "%s%s", t == TIER_SMOKE || !c->tier[TIER_SMOKE].present ? "  [" : ", ",
                    case_tier_name(t));
    }
    fputs("]\n", out);
}

/* -- the references of what is listed -------------------------------------------------- */

/* Lines of no use, and checks whose references cannot show what they say they detect. */
static enum status check_references_of(const struct selection *s, enum tier tier, const char *cases,
                                       const char *folder, struct fault *fault) {
    struct plan *plan = NULL;
    struct budget *budget = NULL;
    struct plan_order *order = calloc(s->count + 1, sizeof *order);
    size_t count = 0;
    if (order == NULL)
        return fault_set(fault, STATUS_NO_MEMORY, "references: out of memory");
    for (size_t i = 0; i < s->count; i++) {
        if (s->order[i].file->tier[tier].present)
            order[count++] = s->order[i];
    }
    enum status status = plan_make(order, count, (const struct case_file *const *)s->all,
                                   s->all_count, tier, 0, &plan, fault);
    if (status == STATUS_OK && count > 0)
        budget_open(cases, folder, tier, plan, &budget, fault);
    budget_close(budget);
    plan_free(plan);
    free(order);
    return fault->status;
}

/* Lines that no check uses, and where all cases are listed tables and curves of none. */
static enum status check_references(const struct command_options *o, const struct selection *s,
                                    struct fault *fault) {
    bool all = o->pattern_count + o->tag_count == 0 && !o->tier_given;
    for (enum tier t = 0; o->references_folder != NULL && t < TIER_COUNT; t++) {
        struct fault found = FAULT_NONE;
        if (check_references_of(s, t, o->cases_folder, o->references_folder, &found) != STATUS_OK)
            fault_add(fault, found.status, "%s", found.text);
    }
    if (!all || o->references_folder == NULL)
        return fault->status;
    const char **name = calloc(s->count + 1, sizeof *name);
    for (size_t i = 0; name != NULL && i < s->count; i++)
        name[i] = s->order[i].file->name;
    if (name != NULL)
        reference_check_folder(o->references_folder, name, s->count, fault);
    free(name);
    return fault->status;
}

/* Claims are about all cases, and stored verdicts about all claims. */
static enum status check_papers(const struct command_options *o, struct fault *fault) {
    struct papers papers;
    struct fault found = FAULT_NONE;
    if (o->pattern_count + o->tag_count > 0 || o->tier_given)
        return STATUS_OK;
    if (papers_open(o->cases_folder, o->references_folder, &papers, &found) != STATUS_OK)
        fault_add(fault, found.status, "%s", found.text);
    papers_close(&papers);
    return found.status;
}

int command_list(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct selection *s = NULL;
    struct selection_request request = {.folder = o->cases_folder,
                                        .pattern_count = o->pattern_count,
                                        .tag_count = o->tag_count,
                                        .pattern = o->pattern,
                                        .tag = o->tag,
                                        .any_tier = !o->tier_given,
                                        .tier = o->tier};
    if (selection_make(&request, &s, &fault) != STATUS_OK) {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
        return 2;
    }
    for (size_t i = 0; i < s->count; i++)
        list_case(c->out, s->order[i].file);
    check_papers(o, &fault);
    if (check_references(o, s, &fault) != STATUS_OK)
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
    selection_free(s);
    return fault.status == STATUS_OK ? 0 : 2;
}

/* -- show ----------------------------------------------------------------------------- */

static void show_node(FILE *out, const struct yaml_node *n) {
    if (n->kind == YAML_SCALAR) {
        fputs(n->text, out);
        return;
    }
    fputc('[', out);
    for (size_t i = 0; i < n->count; i++) {
        fputs(i == 0 ? "" : ", ", out);
        show_node(out, &n->child[i]);
    }
    fputc(']', out);
}

/* "phibar 0.3, phibar_values [0.35]", or what there is to say of none. */
static void show_set(FILE *out, const struct yaml_node *sets) {
    for (size_t i = 0; i < sets->count; i++) {
        fprintf(out, "%s%s ", i == 0 ? "" : ", ", sets->child[i].key);
        show_node(out, &sets->child[i]);
    }
    fputs(sets->count == 0 ? "nothing set\n" : "\n", out);
}

/* What a label, or a reading, stands for. */
static void show_label(FILE *out, const struct case_tier *t, const char *name,
                       const struct yaml_node *labels, const char *label) {
    const struct yaml_node *sets = NULL;
    if (labels != NULL)
        sets = case_label_find(labels, label);
    else if (strcmp(name, "reading") == 0 && t->readings != NULL)
        sets = readings_parameters(t->readings, label);
    if (sets != NULL) {
        fprintf(out, "        %s: ", label);
        show_set(out, sets);
    }
}

static void show_parameters(FILE *out, const struct case_tier *t) {
    for (size_t i = 0; i < t->parameter_count; i++) {
        const struct case_parameter *p = &t->parameter[i];
        fprintf(out, "    %s: ", p->name);
        show_node(out, p->value);
        fputc('\n', out);
        if (p->sets != NULL) {
            fputs("        sets ", out);
            show_set(out, p->sets);
        } else if (p->label) {
            show_label(out, t, p->name, NULL, p->value->text);
        }
    }
    for (size_t i = 0; i < t->axis_count; i++) {
        const struct case_axis *a = &t->axis[i];
        fprintf(out, "    %s: swept over ", a->name);
        show_node(out, a->list);
        fputc('\n', out);
        for (size_t k = 0; k < a->list->count; k++) {
            if (a->list->child[k].kind == YAML_SCALAR)
                show_label(out, t, a->name, a->labels, a->list->child[k].text);
        }
    }
}

static void show_amount(FILE *out, const char *name, const struct case_amount *a) {
    if (a->given)
        fprintf(out, ", %s %g%s", name, a->value, a->percent ? " %" : "");
}

static void show_expect(FILE *out, const struct case_expect *e) {
    if (e->kind == EXPECT_NUMBER) {
        fprintf(out, "%g", e->value);
        if (e->uncertainty > 0)
            fprintf(out, " +- %g", e->uncertainty);
    } else if (e->kind == EXPECT_PREDICTION) {
        fprintf(out, "%s (%s)", e->prediction.prediction->name, e->prediction.prediction->source);
    } else if (e->kind == EXPECT_CURVE) {
        fputs("along", out);
        for (size_t i = 0; i < e->count; i++)
            fprintf(out, "%s %g: %g", i == 0 ? "" : ",", e->x[i], e->y[i]);
    } else if (e->kind == EXPECT_REFERENCE) {
        fprintf(out, "the %s reference", e->reference);
    } else if (e->kind == EXPECT_NONE) {
        fputs("what the reference gave", out);
    } else {
        fprintf(out, "by %s: ", e->by);
        for (size_t i = 0; i < e->count; i++) {
            fprintf(out, "%s%s: ", i == 0 ? "" : ", ", e->entry[i].node->key);
            show_expect(out, &e->entry[i].expect);
        }
    }
}

static void show_check(FILE *out, const struct case_check *k) {
    fprintf(out, "    %s: %s", k->name, k->observable);
    if (k->per.prediction != NULL)
        fprintf(out, " / %s", k->per.prediction->name);
    if (strcmp(k->unit, "1") != 0)
        fprintf(out, " (%s)", k->unit);
    fprintf(out, " %s ", case_comparison_name(k->comparison));
    show_expect(out, &k->expect);
    show_amount(out, "margin", &k->margin);
    show_amount(out, "scatter", &k->scatter);
    show_amount(out, "detects", &k->detects);
    fprintf(out, " [%s%s]\n", case_kind_name(k->kind), k->paired ? ", paired" : "");
    fprintf(out, "        %.*s\n", (int)strcspn(k->because, "\n"), k->because);
    if (k->known_since != NULL)
        fprintf(out, "        known to disagree since %s: %s\n", k->known_since, k->known_because);
}

static void show_tier(FILE *out, const struct case_file *c, enum tier tier) {
    const struct case_tier *t = &c->tier[tier];
    fprintf(out, "\ntier %s: %zu points, %zu runs, %s %g s each (limit %g s)\n",
            case_tier_name(tier), t->point_count, count_runs(t),
            t->expect_s.count > 1 ? "up to" : "about", case_rule_largest(&t->expect_s), t->limit_s);
    show_parameters(out, t);
    if (t->start.case_name != NULL)
        fprintf(out, "    starts from %s\n", t->start.case_name);
    fputs("  checks\n", out);
    for (size_t i = 0; i < t->check_count; i++)
        show_check(out, &t->check[i]);
}

int command_show(const struct command_options *o, const struct console *c) {
    struct fault fault = FAULT_NONE;
    struct selection *s = NULL;
    struct selection_request request = {.folder = o->cases_folder,
                                        .pattern_count = o->pattern_count,
                                        .pattern = o->pattern,
                                        .any_tier = true};
    if (selection_make(&request, &s, &fault) != STATUS_OK) {
        fprintf(c->errors, "bedcheck: %s\n", fault.text);
        return 2;
    }
    for (size_t i = 0; i < s->count; i++) {
        const struct case_file *f = s->order[i].file;
        fprintf(c->out,
                "%s%s: %s\n  file:     %s\n  source:   %s\n  model:    %s\n  question: %s\n",
                i == 0 ? "" : "\n", f->name, f->title, f->path, f->source, f->model, f->question);
        for (enum tier t = 0; t < TIER_COUNT; t++) {
            if (f->tier[t].present && (!o->tier_given || o->tier == t))
                show_tier(c->out, f, t);
        }
    }
    selection_free(s);
    return 0;
}

/* -- recipes -------------------------------------------------------------------------- */

static void list_recipe(FILE *out, const struct recipe *r) {
    fprintf(out, "%s: %s (%s)\n", r->name, r->title, r->source);
    for (size_t i = 0; i < RECIPE_MAX_OUTPUTS && r->output[i].name != NULL; i++)
        fprintf(out, "    gives   %s (%s): %s\n", r->output[i].name, r->output[i].unit,
                r->output[i].doc);
    for (size_t i = 0; i < RECIPE_MAX_SETTINGS && r->setting[i].name != NULL; i++) {
        const struct recipe_setting *s = &r->setting[i];
        fprintf(out, "    setting %s (%s), ", s->name, s->unit);
        if (isnan(s->standard))
            fputs("must be given", out);
        else
            fprintf(out, "default %g", s->standard);
        if (s->min < s->max)
            fprintf(out, ", %g to %g", s->min, s->max);
        fprintf(out, ": %s\n", s->doc);
    }
    for (size_t i = 0; r->curves != NULL && r->curves[i] != NULL; i++)
        fprintf(out, "%s%s", i == 0 ? "    curves  " : ", ", r->curves[i]);
    fputs(r->curves != NULL && r->curves[0] != NULL ? "\n    reads  " : "    reads  ", out);
    for (size_t i = 0; r->datasets != NULL && r->datasets[i] != NULL; i++)
        fprintf(out, " %s", r->datasets[i]);
    fputc('\n', out);
}

static void list_texts(FILE *out, const char *head, const char *const *text, size_t room) {
    fprintf(out, "    %s", head);
    for (size_t i = 0; i < room && text[i] != NULL; i++)
        fprintf(out, " %s", text[i]);
    fputc('\n', out);
}

static void list_ensemble(FILE *out, const struct ensemble *e) {
    fprintf(out, "%s: %s (%s), at least %zu seeds\n", e->name, e->title, e->source, e->min_seeds);
    for (size_t i = 0; i < ENSEMBLE_MAX_OUTPUTS && e->output[i].name != NULL; i++)
        fprintf(out, "    gives   %s (%s): %s\n", e->output[i].name, e->output[i].unit,
                e->output[i].doc);
    fprintf(out, "    reads   %s%s", e->recipe == NULL ? "any recipe with curves" : e->recipe,
            e->curves == NULL ? "" : ":");
    for (size_t i = 0; e->curves != NULL && e->curves[i] != NULL; i++)
        fprintf(out, " %s", e->curves[i]);
    fputc('\n', out);
}

static void list_figure(FILE *out, const struct figure_recipe *f) {
    fprintf(out, "%s: %s, draws %zu observables\n", f->name, f->title, f->observables);
    for (size_t i = 0; i < CASE_FIGURE_SETTINGS && f->setting[i].name != NULL; i++)
        fprintf(out, "    setting %s%s: %s\n", f->setting[i].name,
                f->setting[i].required ? ", must be given" : "", f->setting[i].doc);
}

int command_recipes(const struct console *c) {
    size_t count;
    const struct recipe *const *recipe = recipe_all(&count);
    fputs("Observables\n\n", c->out);
    for (size_t i = 0; i < count; i++)
        list_recipe(c->out, recipe[i]);
    const struct prediction *const *prediction = prediction_all(&count);
    fputs("\nPredictions\n\n", c->out);
    for (size_t i = 0; i < count; i++) {
        fprintf(c->out, "%s (%s): %s (%s)\n", prediction[i]->name, prediction[i]->unit,
                prediction[i]->title, prediction[i]->source);
        list_texts(c->out, "inputs ", prediction[i]->input, PREDICTION_MAX_INPUTS);
    }
    const struct across *const *across = across_all(&count);
    fputs("\nFits over a sweep\n\n", c->out);
    for (size_t i = 0; i < count; i++) {
        fprintf(c->out, "%s: %s (%s), at least %zu points\n", across[i]->name, across[i]->title,
                across[i]->source, across[i]->min_points);
        list_texts(c->out, "gives  ", across[i]->output, ACROSS_MAX_OUTPUTS);
    }
    const struct ensemble *const *ensemble = ensemble_all(&count);
    fputs("\nFits over the seeds of a point\n\n", c->out);
    for (size_t i = 0; i < count; i++)
        list_ensemble(c->out, ensemble[i]);
    const struct figure_recipe *const *figure = figure_all(&count);
    fputs("\nFigures\n\n", c->out);
    for (size_t i = 0; i < count; i++)
        list_figure(c->out, figure[i]);
    return 0;
}
