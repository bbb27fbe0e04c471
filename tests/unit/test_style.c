/* test_style.c -- the page's colours: contrast of text on its ground, light, dark and printed. */
#include "report/html.h"
#include "tests/unit/unit.h"

#include <math.h>

/* Linear part of one channel, WCAG 2.2 "relative luminance". */
static double channel(long value) {
    double c = (double)value / 255;
    return c <= .04045 ? c / 12.92 : pow((c + .055) / 1.055, 2.4);
}

/* The value of --name in the rule that starts at `rule`; #abc or #aabbcc. */
static double luminance(const char *rule, const char *name) {
    char key[64], digits[7] = "";
    snprintf(key, sizeof key, "--%s:#", name);
    const char *at = strstr(rule, key), *end = strchr(rule, '}');
    ck_assert_msg(at && end && at < end, "no colour --%s", name);
    at += strlen(key);
    size_t length = strspn(at, "0123456789abcdef");
    ck_assert_msg(length == 3 || length == 6, "--%s has %zu digits", name, length);
    for (size_t i = 0; i < 6; i++)
        digits[i] = at[length == 3 ? i / 2 : i];
    long rgb = strtol(digits, NULL, 16);
    return .2126 * channel(rgb >> 16) + .7152 * channel(rgb >> 8 & 255) +
           .0722 * channel(rgb & 255);
}

static double contrast(const char *rule, const char *text, const char *ground) {
    double a = luminance(rule, text), b = luminance(rule, ground);
    return (fmax(a, b) + .05) / (fmin(a, b) + .05);
}

static void check_scheme(const char *rule, const char *scheme) {
    static const char *const text[] = {"text", "soft",         "link",  "pass",
                                       "fail", "inconclusive", "known", "skipped"};
    static const char *const verdict[] = {"pass", "fail", "inconclusive", "known", "skipped"};
    ck_assert_ptr_nonnull(rule);
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        const char *const ground[] = {"ground", "panel"};
        for (size_t k = 0; k < 2; k++) {
            double c = contrast(rule, text[i], ground[k]);
            ck_assert_msg(c >= 4.5, "%s: %s on %s: %.2f", scheme, text[i], ground[k], c);
        }
    }
    for (size_t i = 0; i < sizeof verdict / sizeof *verdict; i++) {
        char ground[40];
        snprintf(ground, sizeof ground, "%s-ground", verdict[i]);
        double own = contrast(rule, verdict[i], ground), plain = contrast(rule, "text", ground);
        ck_assert_msg(own >= 4.5 && plain >= 4.5, "%s: %s: %.2f, text on it %.2f", scheme, ground,
                      own, plain);
    }
}

START_TEST(text_stands_out_in_both_schemes) {
    const char *light = strstr(html_style(), ":root{");
    const char *dark = strstr(html_style(), "@media (prefers-color-scheme:dark){:root{");
    ck_assert(light && dark);
    check_scheme(light, "light");
    check_scheme(strstr(dark, ":root{"), "dark");
}
END_TEST

START_TEST(black_on_white_is_21) {
    const char *rule = ":root{--text:#000;--ground:#ffffff;--soft:#777777}";
    ck_assert_double_eq_tol(contrast(rule, "text", "ground"), 21, 1e-9);
    ck_assert_double_eq_tol(contrast(rule, "soft", "ground"), 4.478, 1e-3); /* just too little */
}
END_TEST

/* On paper the dark scheme's grounds would swallow ink and text. */
START_TEST(print_has_all_colours_of_its_own) {
    const char *print = strstr(html_style(), "@media print{:root{");
    ck_assert_ptr_nonnull(print);
    check_scheme(strstr(print, ":root{"), "print");
    ck_assert_double_gt(luminance(strstr(print, ":root{"), "ground"), .99);
}
END_TEST

/* Every colour of a rule is a variable, so that the schemes cover it. */
START_TEST(rules_have_no_colours_of_their_own) {
    const char *rules = strstr(html_style(), "*{box-sizing");
    ck_assert_ptr_nonnull(rules);
    ck_assert_ptr_null(strstr(rules, ";color:#"));
    ck_assert_ptr_null(strstr(rules, "{color:#"));
}
END_TEST

int main(void) {
    const TTest *const tests[] = {text_stands_out_in_both_schemes, black_on_white_is_21,
                                  print_has_all_colours_of_its_own,
                                  rules_have_no_colours_of_their_own, NULL};
    return unit_run("style", tests);
}
