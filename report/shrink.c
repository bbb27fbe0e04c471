/* shrink.c -- see shrink.h. */
#include "report/shrink.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ATTRIBUTES = 24, MAX_DEPTH = 32, MAX_SYMBOLS = 32 };

struct span {
    const char *at;
    size_t length;
};

struct attribute {
    struct span name, value;
};

struct tag {
    struct span name; /* of a closing tag without its stroke */
    bool closes, is_empty;
    size_t count;
    struct attribute attribute[MAX_ATTRIBUTES];
};

struct group {
    struct tag tag;
    bool is_written;
};

struct run { /* of points of one symbol, size and colour */
    bool is_open;
    struct span href, colour;
    double scale;
    long x, y; /* of the last, hundredths */
};

struct shrinker {
    FILE *out;
    const char *prefix;
    size_t depth;
    struct group group[MAX_DEPTH];
    struct run run;
    struct span used[MAX_SYMBOLS]; /* names of symbols that something refers to */
    size_t used_count;
};

/* -- reading ---------------------------------------------------------------- */

static bool is_word(struct span s, const char *word) {
    return s.length == strlen(word) && strncmp(s.at, word, s.length) == 0;
}

static bool same(struct span a, struct span b) {
    return a.length == b.length && strncmp(a.at, b.at, a.length) == 0;
}

static const char *skip_space(const char *s) {
    while (isspace((unsigned char)*s))
        s++;
    return s;
}

/* s is at '<'; returns what follows the tag. */
static const char *read_tag(const char *s, struct tag *t) {
    *t = (struct tag){.closes = s[1] == '/'};
    s += t->closes ? 2 : 1;
    t->name = (struct span){s, strcspn(s, " \t\n/>")};
    s = skip_space(s + t->name.length);
    while (*s && *s != '>' && *s != '/') {
        struct attribute a = {.name = {s, strcspn(s, "= \t\n>")}};
        const char *equals = skip_space(s + a.name.length); /* gnuplot has `points = '...'` too */
        const char *quote = *equals == '=' ? skip_space(equals + 1) : "";
        const char *end = *quote ? strchr(quote + 1, *quote) : NULL;
        if (!end)
            return s + strlen(s);
        a.value = (struct span){quote + 1, (size_t)(end - quote - 1)};
        if (t->count < MAX_ATTRIBUTES)
            t->attribute[t->count++] = a;
        s = skip_space(end + 1);
    }
    t->is_empty = *s == '/';
    s = strchr(s, '>');
    return s ? s + 1 : "";
}

static struct span value_of(const struct tag *t, const char *name) {
    for (size_t i = 0; i < t->count; i++) {
        if (is_word(t->attribute[i].name, name))
            return t->attribute[i].value;
    }
    return (struct span){NULL, 0};
}

static bool is_used(const struct shrinker *w, struct span name) {
    for (size_t i = 0; i < w->used_count; i++) {
        if (same(w->used[i], name))
            return true;
    }
    return false;
}

static void use(struct shrinker *w, struct span href) {
    struct span name = {href.at + 1, href.length - 1};
    if (href.length > 1 && *href.at == '#' && !is_used(w, name) && w->used_count < MAX_SYMBOLS)
        w->used[w->used_count++] = name;
}

/* What the drawing refers to, and what those symbols are made of: at most two others each. */
static void find_used(struct shrinker *w, const char *body) {
    struct tag t;
    const char *definitions = strstr(body, "<defs>"), *end = strstr(body, "</defs>");
    for (const char *s = end ? end : body; (s = strstr(s, "<use ")) != NULL;) {
        s = read_tag(s, &t);
        use(w, value_of(&t, "xlink:href"));
    }
    for (int pass = 0; definitions && end && pass < 3; pass++) {
        for (const char *s = definitions; (s = strstr(s, "<use ")) != NULL && s < end;) {
            s = read_tag(s, &t);
            if (is_used(w, value_of(&t, "id")))
                use(w, value_of(&t, "xlink:href"));
        }
    }
}

/* -- numbers ---------------------------------------------------------------- */

/* value/unit without a zero in front; a separator only where it is needed. */
static void put_fixed(FILE *out, long value, long unit, bool follows_number) {
    char text[32];
    int digits = unit == 10 ? 1 : 2;
    snprintf(text, sizeof text, "%.*f", digits, (double)labs(value) / (double)unit);
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == '0')
        text[--length] = '\0';
    if (length > 0 && text[length - 1] == '.')
        text[--length] = '\0';
    const char *shown = text[0] == '0' && text[1] == '.' ? text + 1 : text;
    if (value < 0)
        fputc('-', out);
    else if (follows_number)
        fputc(' ', out);
    fputs(*shown ? shown : "0", out);
}

static bool read_pair(const char **s, const char *end, long *x, long *y) {
    char *rest;
    double first = strtod(*s, &rest), second;
    if (rest == *s || rest >= end || *rest != ',')
        return false;
    const char *at = rest + 1;
    second = strtod(at, &rest);
    if (rest == at || rest > end)
        return false;
    *s = rest;
    *x = lround(10 * first);
    *y = lround(10 * second);
    return true;
}

static void put_step(FILE *out, long dx, long dy) {
    if (dy == 0) {
        fputc('h', out);
        put_fixed(out, dx, 10, false);
    } else if (dx == 0) {
        fputc('v', out);
        put_fixed(out, dy, 10, false);
    } else {
        fputc('l', out);
        put_fixed(out, dx, 10, false);
        put_fixed(out, dy, 10, true);
    }
}

/* M and L with pairs, and z, are what gnuplot draws with; anything else stays as it is. */
static bool is_simple_path(struct span d) {
    for (size_t i = 0; i < d.length; i++) {
        if (strchr("MLz0123456789.,- \t\n", d.at[i]) == NULL)
            return false;
    }
    return true;
}

static void put_path(FILE *out, struct span d) {
    const char *s = d.at, *end = d.at + d.length;
    long x = 0, y = 0, to_x, to_y;
    if (!is_simple_path(d)) {
        fwrite(d.at, 1, d.length, out);
        return;
    }
    while ((s = skip_space(s)) < end) {
        char command = *s++;
        if (command == 'z') {
            fputc('z', out);
            continue;
        }
        if (!read_pair(&s, end, &to_x, &to_y))
            return;
        const char *next = skip_space(s);
        if (command == 'M' && next < end && *next != 'M') { /* a move alone draws nothing */
            fputc('M', out);
            put_fixed(out, to_x, 10, false);
            put_fixed(out, to_y, 10, true);
        } else if (command == 'L' && (to_x != x || to_y != y)) {
            put_step(out, to_x - x, to_y - y);
        }
        x = to_x;
        y = to_y;
    }
}

/* Numbers in parts of 1/unit, 10 or 100; all else as it is. */
static void put_rounded(FILE *out, struct span text, long unit) {
    for (size_t i = 0; i < text.length;) {
        size_t digits = strspn(text.at + i, "0123456789.");
        digits = digits < text.length - i ? digits : text.length - i;
        if (digits == 0) {
            fputc(text.at[i++], out);
            continue;
        }
        put_fixed(out, lround((double)unit * strtod(text.at + i, NULL)), unit, false);
        i += digits;
    }
}

/* -- writing ---------------------------------------------------------------- */

static void put_colour(FILE *out, struct span value) {
    unsigned red, green, blue;
    if (sscanf(value.at, "rgb(%u,%u,%u)", &red, &green, &blue) == 3)
        fprintf(out, "#%02x%02x%02x", red & 255, green & 255, blue & 255);
    else
        fwrite(value.at, 1, value.length, out);
}

/* What is the default anyway, what SHRINK_STYLE sets, and names that nothing refers to. */
static bool is_dropped(const struct shrinker *w, bool in_group, struct attribute a) {
    bool is_whole = in_group && ((is_word(a.name, "fill") && is_word(a.value, "none")) ||
                                 (is_word(a.name, "color") && is_word(a.value, "black")) ||
                                 (is_word(a.name, "stroke-width") && is_word(a.value, "1.00")));
    return is_whole || (is_word(a.name, "stroke-linecap") && is_word(a.value, "butt")) ||
           (is_word(a.name, "stroke-linejoin") && is_word(a.value, "miter")) ||
           is_word(a.name, "class") ||
           (is_word(a.name, "font-family") && is_word(a.value, "sans-serif")) ||
           (is_word(a.name, "id") && !is_used(w, a.value));
}

static void put_value(struct shrinker *w, struct attribute a) {
    struct span v = a.value;
    bool refers = is_word(a.name, "xlink:href") && v.length > 0 && *v.at == '#';
    if (is_word(a.name, "d"))
        put_path(w->out, v);
    else if (is_word(a.name, "stroke") || is_word(a.name, "fill") || is_word(a.name, "color"))
        put_colour(w->out, v);
    else if (is_word(a.name, "points"))
        put_rounded(w->out, v, 10);
    else if (is_word(a.name, "transform") || is_word(a.name, "stroke-width") ||
             is_word(a.name, "fill-opacity") || is_word(a.name, "font-size"))
        put_rounded(w->out, v, 100);
    else if (is_word(a.name, "id"))
        fprintf(w->out, "%s%.*s", w->prefix, (int)v.length, v.at);
    else if (refers)
        fprintf(w->out, "#%s%.*s", w->prefix, (int)v.length - 1, v.at + 1);
    else
        fwrite(v.at, 1, v.length, w->out);
}

static void put_tag(struct shrinker *w, const struct tag *t) {
    bool is_group = is_word(t->name, "g");
    fprintf(w->out, "<%.*s", (int)t->name.length, t->name.at);
    for (size_t i = 0; i < t->count; i++) {
        const struct attribute *a = &t->attribute[i];
        if (is_dropped(w, is_group, *a))
            continue;
        char quote = memchr(a->value.at, '\'', a->value.length) ? '"' : '\'';
        fprintf(w->out, " %.*s=%c", (int)a->name.length, a->name.at, quote);
        put_value(w, *a);
        fputc(quote, w->out);
    }
    fputs(t->is_empty ? "/>" : ">", w->out);
}

static void end_run(struct shrinker *w) {
    if (w->run.is_open)
        fputs("</g>\n", w->out);
    w->run.is_open = false;
}

/* Groups become real with the first thing that is drawn in them. */
static void open_groups(struct shrinker *w) {
    for (size_t i = 0; i < w->depth; i++) {
        if (w->group[i].is_written)
            continue;
        put_tag(w, &w->group[i].tag);
        w->group[i].is_written = true;
    }
}

static void close_group(struct shrinker *w) {
    if (w->depth == 0)
        return;
    if (w->group[--w->depth].is_written) {
        end_run(w);
        fputs("</g>\n", w->out);
    }
}

/* A point: `<use href translate scale colour/>`.  Is it one? */
static bool put_point(struct shrinker *w, const struct tag *t) {
    struct span place = value_of(t, "transform"), href = value_of(t, "xlink:href");
    struct span colour = value_of(t, "color");
    struct run *r = &w->run;
    double x, y, scale;
    if (!is_word(t->name, "use") || !place.at || !href.at || !colour.at || t->count != 3 ||
        sscanf(place.at, "translate(%lf,%lf) scale(%lf)", &x, &y, &scale) != 3 || !(scale > 0))
        return false;
    long to_x = lround(100 * x / scale), to_y = lround(100 * y / scale);
    open_groups(w);
    if (!r->is_open || !same(href, r->href) || !same(colour, r->colour) || scale != r->scale) {
        end_run(w);
        fprintf(w->out, "<g transform='scale(%g)' color='", scale);
        put_colour(w->out, colour);
        fputs("'>", w->out);
        *r = (struct run){.is_open = true, .href = href, .colour = colour, .scale = scale};
    } else if (to_x == r->x && to_y == r->y) {
        return true;
    }
    fprintf(w->out, "<use href='#%s%.*s' x='", w->prefix, (int)href.length - 1, href.at + 1);
    put_fixed(w->out, to_x, 100, false);
    fputs("' y='", w->out);
    put_fixed(w->out, to_y, 100, false);
    fputs("'/>", w->out);
    r->x = to_x;
    r->y = to_y;
    return true;
}

static void put_definitions(struct shrinker *w, const char *s, const char *end) {
    struct tag t;
    if (w->used_count == 0)
        return;
    fputs("<defs>", w->out);
    while ((s = strchr(s, '<')) != NULL && s < end) {
        s = read_tag(s, &t);
        if (t.is_empty && is_used(w, value_of(&t, "id")))
            put_tag(w, &t);
    }
    fputs("</defs>\n", w->out);
}

static const char *skip_past(const char *s, const char *mark) {
    const char *found = strstr(s, mark);
    return found ? found + strlen(mark) : s + strlen(s);
}

/* From `<text>` to `</text>`: words and spaces of ours, not to be touched. */
static const char *copy_text(struct shrinker *w, const char *s) {
    const char *end = skip_past(s, "</text>");
    struct tag t;
    while (s < end) {
        if (*s != '<') {
            fputc(*s++, w->out);
            continue;
        }
        s = read_tag(s, &t);
        if (t.closes)
            fprintf(w->out, "</%.*s>", (int)t.name.length, t.name.at);
        else
            put_tag(w, &t);
    }
    return end;
}

static const char *take_element(struct shrinker *w, const char *s) {
    struct tag t;
    const char *next = read_tag(s, &t);
    if (is_word(t.name, "title"))
        return skip_past(s, "</title>");
    if (is_word(t.name, "defs")) {
        const char *end = skip_past(s, "</defs>");
        put_definitions(w, next, end);
        return end;
    }
    if (is_word(t.name, "g") && t.closes) {
        close_group(w);
    } else if (is_word(t.name, "g") && w->depth < MAX_DEPTH) {
        w->group[w->depth++] = (struct group){.tag = t};
    } else if (!put_point(w, &t)) {
        open_groups(w);
        end_run(w);
        if (is_word(t.name, "text"))
            return copy_text(w, s);
        if (t.closes)
            fprintf(w->out, "</%.*s>\n", (int)t.name.length, t.name.at);
        else
            put_tag(w, &t);
    }
    return next;
}

void shrink_svg(FILE *out, const char *body, const char *prefix) {
    struct shrinker w = {.out = out, .prefix = prefix};
    find_used(&w, body);
    while ((body = strchr(body, '<')) != NULL)
        body = take_element(&w, body);
}
