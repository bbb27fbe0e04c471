#include "validation/plan_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A plain scalar that every YAML reader takes as it stands. */
static bool is_plain(const struct yaml_node *n) {
    static const char safe[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-/";
    return !n->quoted && *n->text != '\0' && strspn(n->text, safe) == strlen(n->text);
}

static void write_value(FILE *out, const struct yaml_node *n) {
    if (n->kind == YAML_LIST) {
        fputc('[', out);
        for (size_t i = 0; i < n->count; i++) {
            fputs(i == 0 ? "" : ", ", out);
            write_value(out, &n->child[i]);
        }
        fputc(']', out);
        return;
    }
    if (is_plain(n)) {
        fputs(n->text, out);
        return;
    }
    fputc('"', out);
    for (const char *p = n->text; *p != '\0'; p++)
        fprintf(out, *p == '"' || *p == '\\' ? "\\%c" : "%c", *p);
    fputc('"', out);
}

static void write_times(FILE *out, const char *key, const struct case_samples *s) {
    if (s->count == 0)
        return;
    fprintf(out, "%s: [", key);
    for (size_t i = 0; i < s->count; i++)
        fprintf(out, "%s%.15g", i == 0 ? "" : ", ", s->time[i]);
    fputs("]\n", out);
}

static void write_parameters(FILE *out, const struct case_parameter *p, size_t count,
                             bool origins) {
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        if (p[i].label)
            continue; /* what it stands for is there in its place */
        fprintf(out, "%s  %s: ", any ? "" : "parameters:\n", p[i].name);
        write_value(out, p[i].value);
        if (origins)
            fprintf(out, "    # %s:%zu", p[i].value->file, p[i].value->line);
        if (origins && p[i].reading != NULL)
            fprintf(out, ", reading %s", p[i].reading);
        fputc('\n', out);
        any = true;
    }
}

static void write_wanted(FILE *out, const struct case_file *c, const struct case_tier *t) {
    write_times(out, "samples", &t->samples);
    write_times(out, "particle_samples", &t->particle_samples);
    fputs("datasets: [", out);
    for (size_t i = 0; i < c->dataset_count; i++)
        fprintf(out, "%s%s", i == 0 ? "" : ", ", c->dataset[i]);
    fputs("]\n", out);
}

/* The stream's text moved into the arena. */
static const char *keep(struct arena *a, FILE *out, char **text) {
    const char *kept = NULL;
    if (out != NULL && fclose(out) == 0)
        kept = arena_copy(a, *text);
    free(*text);
    return kept;
}

const char *plan_text(struct arena *a, const struct plan_text_input *in, bool origins) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out != NULL) {
        if (origins)
            fputs("# One run, written by bedcheck; it is written anew before each use.\n", out);
        const char *quote = strchr(in->point, ' ') != NULL ? "\"" : ""; /* has none itself */
        fprintf(out, "format: bedcheck-run 1\ncase: %s\npoint: %s%s%s\nmodel: %s\n", in->file->name,
                quote, in->point, quote, in->file->model);
        write_wanted(out, in->file, in->tier);
        if (in->start_file != NULL)
            fprintf(out, "start_file: %s\n", in->start_file);
        write_parameters(out, in->parameter, in->count, origins);
    }
    return keep(a, out, &text);
}

const char *plan_text_identity(struct arena *a, const struct case_file *file,
                               const struct case_tier *tier, const struct case_parameter *parameter,
                               size_t count, const char *start_id) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out != NULL) {
        fprintf(out, "%s\n%s\n%s\n", file->name, file->model, start_id == NULL ? "-" : start_id);
        write_wanted(out, file, tier);
        write_parameters(out, parameter, count, false);
    }
    return keep(a, out, &text);
}

static double number_or(const struct plan_text_input *in, const char *name, double standard) {
    const struct yaml_node *n = case_parameter_find(in->parameter, in->count, name);
    double value = n != NULL && n->kind == YAML_SCALAR ? strtod(n->text, NULL) : 0;
    return value > 0 ? value : standard;
}

/* Reals that one sample of a dataset holds. */
static double reals_of(const struct plan_text_input *in, const char *dataset) {
    if (strncmp(dataset, "particles/spheres/", 18) == 0)
        return 3 * number_or(in, "particles", 10000);
    if (strncmp(dataset, "particles/", 10) == 0)
        return 2 * number_or(in, "grains", 18104);
    if (strncmp(dataset, "profiles/", 9) == 0)
        return number_or(in, "height_R", 240) / number_or(in, "profile_bin_R", 1);
    if (strncmp(dataset, "fields/", 7) == 0)
        return (strstr(dataset, "velocity") != NULL ? 2 : 1) * (number_or(in, "width_l", 60) + 1) *
               (number_or(in, "height_l", 92) + 1);
    return 3;
}

double plan_text_bytes(const struct plan_text_input *in) {
    const struct case_tier *t = in->tier;
    double frames = (double)t->samples.count;
    double particle_frames =
        t->particle_samples.count > 0 ? (double)t->particle_samples.count : frames;
    double reals = 8192; /* groups, attributes, chunk tables */
    for (size_t i = 0; i < in->file->dataset_count; i++) {
        const char *name = in->file->dataset[i];
        bool particles = strncmp(name, "particles/", 10) == 0;
        reals += reals_of(in, name) * (particles ? particle_frames : frames);
    }
    return 8 * reals;
}
