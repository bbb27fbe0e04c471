/* figure_text.c -- names of parameters and points as a reader wants them; see figures.h. */
#include "validation/figures.h"

#include <string.h>

/* The units that end a parameter's name, longest first. */
static const struct {
    const char *ending, *unit;
} units[] = {{"_m2_per_s2", "m^2/s^2"},
             {"_l_per_tau", "l/tau"},
             {"_m_per_s2", "m/s^2"},
             {"_m_per_s", "m/s"},
             {"_per_s", "1/s"},
             {"_tau", "tau"},
             {"_kg", "kg"},
             {"_l", "l"},
             {"_m", "m"},
             {"_R", "R"},
             {"_s", "s"},
             {"_J", "J"}};

static bool ends_in(const char *name, const char *ending) {
    size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0;
}

/* The name without its unit, '_' made ' '; *unit: NULL where it has none. */
static char *quantity(const char *parameter, const char **unit, struct arena *a) {
    char *text = arena_copy(a, parameter);
    *unit = NULL;
    for (size_t i = 0; text && i < sizeof units / sizeof *units && !*unit; i++)
        if (ends_in(parameter, units[i].ending)) {
            *unit = units[i].unit;
            text[strlen(text) - strlen(units[i].ending)] = '\0';
        }
    for (char *c = text; c && *c; c++)
        *c = *c == '_' ? ' ' : *c;
    return text;
}

const char *figure_axis_text(const char *parameter, struct arena *a) {
    const char *unit, *name = quantity(parameter, &unit, a);
    return name == NULL || unit == NULL ? name : arena_text(a, "%s (%s)", name, unit);
}

const char *figure_value_text(const char *parameter, const char *value, struct arena *a) {
    const char *unit, *name = quantity(parameter, &unit, a);
    if (name == NULL)
        return NULL;
    return arena_text(a, "%s %s%s%s", name, value, unit == NULL ? "" : " ",
                      unit == NULL ? "" : unit);
}

/* Do the points shown have more than one value of a parameter? */
static bool differs(const struct measured_case *data, const char *name) {
    const struct yaml_node *first = NULL;
    for (size_t i = 0; i < data->point_count; i++) {
        const struct plan_point *p = data->point[i].point;
        const struct yaml_node *value = case_parameter_find(p->parameter, p->parameter_count, name);
        if (i > 0 && value != first)
            return true;
        first = value;
    }
    return false;
}

const char *figure_point_text(const struct measured_case *data, const struct measured_point *p,
                              const char *along, struct arena *a) {
    const struct case_tier *t = data->plan->tier;
    size_t but = along == NULL ? t->axis_count : case_axis_of(t, along);
    const char *reading = case_reading(p->point->parameter, p->point->parameter_count);
    bool told = reading == NULL || (along != NULL && strcmp(along, "reading") == 0);
    const char *text = told ? "" : figure_value_text("reading", reading, a);
    for (size_t i = 0; i < t->axis_count && text != NULL; i++) {
        const char *name = t->axis[i].name;
        if (i == but || strcmp(name, "reading") == 0 || !differs(data, name))
            continue;
        const char *value = case_value_text(
            a, case_parameter_find(p->point->parameter, p->point->parameter_count, name));
        const char *part = value == NULL ? NULL : figure_value_text(name, value, a);
        text = part == NULL ? NULL : arena_text(a, "%s%s%s", text, *text ? ", " : "", part);
    }
    return text;
}
