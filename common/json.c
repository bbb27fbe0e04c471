/* json.c -- see json.h. */
#include "common/json.h"

#include <assert.h>
#include <math.h>
#include <string.h>

struct json json_to(FILE *out) {
    return (struct json){.out = out};
}

/* Comma, line break and indentation in front of the next item. */
static void next_item(struct json *j) {
    if (j->after_key) {
        j->after_key = false;
        return;
    }
    if (j->depth == 0)
        return;
    if (j->filled[j->depth])
        fputc(',', j->out);
    j->filled[j->depth] = true;
    fprintf(j->out, "\n%*s", 2 * j->depth, "");
}

static void begin(struct json *j, char bracket) {
    next_item(j);
    fputc(bracket, j->out);
    j->depth++;
    assert(j->depth < (int)(sizeof j->filled / sizeof *j->filled));
    j->filled[j->depth] = false;
}

static void end(struct json *j, char bracket) {
    assert(j->depth > 0 && !j->after_key);
    j->depth--;
    if (j->filled[j->depth + 1])
        fprintf(j->out, "\n%*s", 2 * j->depth, "");
    fputc(bracket, j->out);
    if (j->depth == 0)
        fputc('\n', j->out);
}

void json_begin_object(struct json *j) {
    begin(j, '{');
}

void json_end_object(struct json *j) {
    end(j, '}');
}

void json_begin_array(struct json *j) {
    begin(j, '[');
}

void json_end_array(struct json *j) {
    end(j, ']');
}

/* Length of the UTF-8 sequence at s, 0 if it is none (overlong forms,
 * surrogates and what lies beyond U+10FFFF included). */
static size_t utf8_length(const unsigned char *s) {
    if (s[0] < 0x80)
        return 1;
    size_t length = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    if (s[0] < 0xc2 || s[0] > 0xf4)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80)
            return 0;
    if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) ||
        (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] > 0x8f))
        return 0;
    return length;
}

static void put_escaped(FILE *out, unsigned char c) {
    static const char *const names = "\"\\\b\f\n\r\t", *const letters = "\"\\bfnrt";
    const char *found = strchr(names, c);
    if (found != NULL)
        fprintf(out, "\\%c", letters[found - names]);
    else
        fprintf(out, "\\u%04x", c);
}

static void put_text(FILE *out, const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', out);
    while (*s != '\0') {
        size_t length = utf8_length(s);
        if (length == 0)
            fputs("\\ufffd", out); /* a byte that is no text */
        else if (*s < 0x20 || *s == '"' || *s == '\\' || *s == 0x7f)
            put_escaped(out, *s);
        else
            fwrite(s, 1, length, out);
        s += length == 0 ? 1 : length;
    }
    fputc('"', out);
}

void json_key(struct json *j, const char *key) {
    assert(j->depth > 0 && !j->after_key);
    next_item(j);
    put_text(j->out, key);
    fputs(": ", j->out);
    j->after_key = true;
}

void json_text(struct json *j, const char *text) {
    next_item(j);
    if (text == NULL)
        fputs("null", j->out);
    else
        put_text(j->out, text);
}

void json_real(struct json *j, double value) {
    next_item(j);
    if (isfinite(value))
        fprintf(j->out, "%.17g", value);
    else
        fputs("null", j->out);
}

void json_integer(struct json *j, long long value) {
    next_item(j);
    fprintf(j->out, "%lld", value);
}

void json_boolean(struct json *j, bool value) {
    next_item(j);
    fputs(value ? "true" : "false", j->out);
}

void json_put_text(struct json *j, const char *key, const char *text) {
    json_key(j, key);
    json_text(j, text);
}

void json_put_real(struct json *j, const char *key, double value) {
    json_key(j, key);
    json_real(j, value);
}

void json_put_count(struct json *j, const char *key, size_t count) {
    json_key(j, key);
    json_integer(j, (long long)count);
}
