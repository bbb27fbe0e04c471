/* escape.c -- see escape.h. */
#include "report/escape.h"

#include <stddef.h>
#include <string.h>

/* Length of the UTF-8 character at s, 0 if it is none (overlong forms, surrogates and values
 * past U+10FFFF included).  Never looks past the NUL: it is no continuation byte. */
static size_t character_length(const unsigned char *s) {
    static const struct {
        unsigned char first, last, second_low, second_high;
        size_t length;
    } form[] = {
        {0x01, 0x7f, 0, 0, 1},       {0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3},
        {0xe1, 0xec, 0x80, 0xbf, 3}, {0xed, 0xed, 0x80, 0x9f, 3}, {0xee, 0xef, 0x80, 0xbf, 3},
        {0xf0, 0xf0, 0x90, 0xbf, 4}, {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4}};
    for (size_t i = 0; i < sizeof form / sizeof form[0]; i++) {
        if (s[0] < form[i].first || s[0] > form[i].last)
            continue;
        if (form[i].length > 1 && (s[1] < form[i].second_low || s[1] > form[i].second_high))
            return 0;
        for (size_t k = 2; k < form[i].length; k++) {
            if (s[k] < 0x80 || s[k] > 0xbf)
                return 0;
        }
        return form[i].length;
    }
    return 0;
}

/* C0 and C1 controls, DEL, and U+FFFE and U+FFFF, which XML does not allow. */
static bool is_control(const unsigned char *s, size_t length) {
    if (length == 1)
        return s[0] < 0x20 || s[0] == 0x7f;
    if (length == 2)
        return s[0] == 0xc2 && s[1] < 0xa0;
    return length == 3 && s[0] == 0xef && s[1] == 0xbf && s[2] >= 0xbe;
}

bool escape_is_plain(const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    while (*s) {
        size_t length = character_length(s);
        if (length == 0 || is_control(s, length))
            return false;
        s += length;
    }
    return true;
}

/* The character at *s in itself, or U+FFFD for a broken one; moves *s on.  False for a control
 * character, which is passed over: *s then is the byte after it. */
static bool next_character(const unsigned char **s, const char **start, size_t *length) {
    size_t n = character_length(*s);
    *start = n ? (const char *)*s : "\xef\xbf\xbd";
    *length = n ? n : 3;
    bool shown = n == 0 || !is_control(*s, n);
    *s += n ? n : 1;
    return shown;
}

static const char *markup_entity(char c) {
    switch (c) {
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '&':
        return "&amp;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return NULL;
    }
}

void escape_markup(FILE *out, const char *text) {
    const unsigned char *s = (const unsigned char *)(text ? text : "");
    while (*s) {
        const char *start;
        size_t length;
        bool is_space = *s == '\n' || *s == '\t';
        if (!next_character(&s, &start, &length) && !is_space)
            continue;
        const char *entity = markup_entity(*start);
        if (entity)
            fputs(entity, out);
        else
            fwrite(start, 1, length, out);
    }
}

void escape_markdown(FILE *out, const char *text) {
    const unsigned char *s = (const unsigned char *)(text ? text : "");
    while (*s) {
        const char *start;
        size_t length;
        bool is_space = *s == '\n' || *s == '\t';
        if (!next_character(&s, &start, &length)) {
            if (is_space)
                fputc(' ', out);
            continue;
        }
        const char *entity = markup_entity(*start);
        if (entity && *start != '\'' && *start != '"')
            fputs(entity, out);
        else if (strchr("\\`*_[]|~#$@!", *start))
            fprintf(out, "\\%c", *start);
        else
            fwrite(start, 1, length, out);
    }
}

void escape_name(FILE *out, const char *text) {
    static const char kept[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.";
    for (const unsigned char *s = (const unsigned char *)(text ? text : ""); *s; s++) {
        if (strchr(kept, *s))
            fputc(*s, out);
        else if (*s == '/')
            fputc('.', out);
        else
            fprintf(out, "_%02X", *s);
    }
}

void escape_base64(FILE *out, const char *bytes, size_t length) {
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *b = (const unsigned char *)bytes;
    for (size_t i = 0; i < length; i += 3) {
        unsigned have = length - i < 3 ? (unsigned)(length - i) : 3;
        unsigned word = (unsigned)b[i] << 16;
        word |= have > 1 ? (unsigned)b[i + 1] << 8 : 0;
        word |= have > 2 ? (unsigned)b[i + 2] : 0;
        fputc(digit[word >> 18], out);
        fputc(digit[word >> 12 & 63], out);
        fputc(have > 1 ? digit[word >> 6 & 63] : '=', out);
        fputc(have > 2 ? digit[word & 63] : '=', out);
    }
}

void escape_uri(FILE *out, const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c > ' ' && *c < 127 && strchr("\"#%&'<>\\^`{|}", *c) == NULL)
            fputc(*c, out);
        else
            fprintf(out, "%%%02X", *c);
    }
}
