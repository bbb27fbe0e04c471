/* json_cover.c -- what a run of the suite does not see, and how well all of it agrees. */
#include "report/json_cover.h"

void json_cover_limits(struct json *j, const struct report *r) {
    json_key(j, "limits");
    json_begin_array(j);
    for (size_t i = 0; i < r->limit_count; i++) {
        json_begin_object(j);
        json_put_text(j, "model", r->limit[i].model);
        json_put_text(j, "what", r->limit[i].what);
        json_put_text(j, "because", r->limit[i].because);
        json_end_object(j);
    }
    json_end_array(j);
    json_key(j, "unselected");
    json_begin_array(j);
    for (size_t i = 0; i < r->unselected_count; i++)
        json_text(j, r->unselected[i]);
    json_end_array(j);
}

static void put_interval(struct json *j, const char *key, double value, const double *interval) {
    json_key(j, key);
    json_begin_object(j);
    json_put_real(j, "value", value);
    json_put_real(j, "low", interval[0]);
    json_put_real(j, "high", interval[1]);
    json_end_object(j);
}

static void put_group(struct json *j, const struct report_group *g) {
    json_begin_object(j);
    json_put_text(j, "group", g->name);
    json_put_count(j, "rows", g->rows);
    json_put_count(j, "cases", g->cases);
    put_interval(j, "bias", g->bias, (const double[]){g->bias_low, g->bias_high});
    put_interval(j, "scatter", g->scatter, (const double[]){g->scatter_low, g->scatter_high});
    json_put_real(j, "noise", g->noise);
    json_end_object(j);
}

void json_cover_agreement(struct json *j, const struct report *r) {
    const struct report_agreement *a = r->agreement;
    json_key(j, "agreement");
    if (!a || a->group_count == 0) {
        json_text(j, NULL);
        return;
    }
    json_begin_object(j);
    json_key(j, "groups");
    json_begin_array(j);
    for (size_t i = 0; i < a->group_count; i++)
        put_group(j, &a->group[i]);
    json_end_array(j);
    json_key(j, "left_out");
    json_begin_object(j);
    json_put_count(j, "round_off", a->round_off);
    json_put_count(j, "one_sided", a->one_sided);
    json_put_count(j, "other", a->other);
    json_end_object(j);
    json_end_object(j);
}
